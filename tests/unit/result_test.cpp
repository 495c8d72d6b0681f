// Results: a value, or an error that the program says before it ends.
#include "bihive/base/result.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "bihive/base/write_file.h"

namespace bihive {
namespace {

TEST(ResultValue, of_an_error_says_the_error) {
#if GTEST_HAS_DEATH_TEST
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const Result<int> none(Error{"expected a number", "a.xyz", 3, 0, "write one"});
  const char* const text = "a.xyz:3: expected a number; write one";
  EXPECT_DEATH((void)none.value(), text);
  EXPECT_DEATH((void)*none, text);
  EXPECT_DEATH((void)Status(Error{"the disk is full", "", 0, 0, ""}).value(), "the disk is full");
#else
  GTEST_SKIP() << "this platform starts no process";
#endif
}

TEST(ErrorOfTheSystem, has_its_number) {
  const Result<std::string> missing = read_file("/no such folder/no such file");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().system_code, ENOENT);
  EXPECT_EQ(Error{}.system_code, 0);
}

}  // namespace
}  // namespace bihive
