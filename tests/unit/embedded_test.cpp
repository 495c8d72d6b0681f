// The data that the build puts into the library: the bundled molecule byte for byte, the version.
// ctest: asan-long
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "bihive/base/version.h"
#include "bihive/io/bundled.h"

namespace bihive {
namespace {

TEST(Embedded, MoleculeIsTheFileByteForByte) {
  std::ifstream file(std::string(BIHIVE_SOURCE_DIR) + "/data/1hpv.pdb", std::ios::binary);
  const std::string expected{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  ASSERT_EQ(expected.size(), 150174u);
  EXPECT_TRUE(bundled_molecule() == expected);
}

TEST(Embedded, VersionIsThreeNumbers) {
  const std::string text(version());
  EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2) << text;
  EXPECT_EQ(text.find_first_not_of("0123456789."), std::string::npos) << text;
}

TEST(Embedded, CommitIsAnAbbreviatedHashOrUnknown) {
  std::string text(commit());
  if (text.empty()) return;
  const std::string dirty = "-dirty";
  if (text.size() > dirty.size() && text.ends_with(dirty)) text.resize(text.size() - dirty.size());
  EXPECT_GE(text.size(), 7u);
  EXPECT_EQ(text.find_first_not_of("0123456789abcdef"), std::string::npos) << text;
}

}  // namespace
}  // namespace bihive
