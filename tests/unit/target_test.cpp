// Targets of the wide engine: each target of the machine can be forced, and then its code runs.
// ctest: kernel
#include "bihive/simd/target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace bihive {
namespace {

struct Expected {
  const char *name, *highway_name;
  int float_lanes;
};
constexpr Expected kExpected[] = {{"avx512", "AVX3", 16}, {"avx2", "AVX2", 8}, {"sse4", "SSE4", 4},
                                  {"neon", "NEON", 4},    {"wasm", "WASM", 4}, {"scalar", "EMU128", 4},
                                  {"scalar", "SCALAR", 1}};  // the last if Highway distrusts the compiler (GCC)

TEST(Target, EachRunsItsOwnCode) {
  const std::vector<std::string> names = available_targets();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    const Status status = use_target(name);
    ASSERT_TRUE(status.ok()) << name;
    EXPECT_EQ(active_target(), name);
    const CompiledTarget here = compiled_target();
    EXPECT_TRUE(std::any_of(std::begin(kExpected), std::end(kExpected),
                            [&](const Expected& target) {
                              return name == target.name && here.name == target.highway_name &&
                                     here.float_lanes == target.float_lanes;
                            }))
        << name << " runs the code of " << here.name << " with " << here.float_lanes << " lanes";
  }
  ASSERT_TRUE(use_target("").ok());
  EXPECT_EQ(active_target(), names.front());
}

TEST(Target, AskingChangesNothing) {
  for (const std::string& name : available_targets()) {
    ASSERT_TRUE(use_target(name).ok());
    const std::string code = compiled_target().name;
    EXPECT_EQ(available_targets().size(), available_targets().size());
    EXPECT_FALSE(use_target("avx9").ok());
    EXPECT_EQ(compiled_target().name, code) << name;
    EXPECT_EQ(active_target(), name);
  }
  ASSERT_TRUE(use_target("").ok());
}

TEST(Target, AnUnknownOneIsRefusedAndChangesNothing) {
  const std::string before = active_target();
  for (const char* name : {"avx9", "AVX2", "avx2 ", "Scalar"}) {
    const Status status = use_target(name);
    ASSERT_FALSE(status.ok()) << name;
    for (const std::string& known : available_targets())
      EXPECT_NE(status.error().hint.find(known), std::string::npos) << status.error().hint;
    EXPECT_EQ(active_target(), before);
  }
}

TEST(Target, TheEnvironmentIsChecked) {
  const std::string before = active_target();
  setenv("BIHIVE_TARGET", "abacus", 1);
  const Status bad = check_target_environment();
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().message.find("BIHIVE_TARGET"), std::string::npos);
  EXPECT_NE(bad.error().message.find("abacus"), std::string::npos);
  EXPECT_FALSE(bad.error().hint.empty());
  EXPECT_EQ(active_target(), before);
  const std::string last = available_targets().back();
  setenv("BIHIVE_TARGET", last.c_str(), 1);
  EXPECT_TRUE(check_target_environment().ok());
  EXPECT_EQ(active_target(), last);
  unsetenv("BIHIVE_TARGET");
  EXPECT_TRUE(check_target_environment().ok());
  ASSERT_TRUE(use_target("").ok());
}

}  // namespace
}  // namespace bihive
