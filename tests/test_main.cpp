// The main function of the test programs.
//
//   unit_tests                      every test of the program
//   unit_tests --file unit/tree     the tests of tests/unit/tree_test.cpp alone, which is how ctest calls it
// and GoogleTest's own options: --gtest_filter=-PATTERN leaves some of the file's tests out, and a filter that names
// tests chooses by itself, as GoogleTest does when it starts a program again for a test that ends it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace {

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

// The names of all tests of a file, as a filter. Empty: there are none.
std::string tests_of_file(const std::string& file) {
  const std::string end = "/" + file + "_test.cpp";
  const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
  std::string names;
  for (int i = 0; i < tests.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *tests.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      if (ends_with(test.file(), end)) names += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  if (argc == 1) return RUN_ALL_TESTS();
  if (argc != 3 || std::string_view(argv[1]) != "--file") {
    std::fprintf(stderr, "usage: %s [--file KIND/SUBJECT]\n", argv[0]);
    return 2;
  }
  const std::string names = tests_of_file(argv[2]);
  if (names.empty()) {
    std::fprintf(stderr, "%s: no test is in tests/%s_test.cpp\n", argv[0], argv[2]);
    return 2;
  }
  const std::string filter = GTEST_FLAG_GET(filter);
  if (filter == "*") GTEST_FLAG_SET(filter, names);
  if (filter[0] == '-') GTEST_FLAG_SET(filter, names + filter);
  return RUN_ALL_TESTS();
}
