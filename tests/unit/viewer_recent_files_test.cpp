// Files that were opened before.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/viewer/recent_files.h"

namespace bihive {
namespace {

class Recent : public testing::Test {
 protected:
  Recent() { std::filesystem::remove_all(folder); }
  ~Recent() override { std::filesystem::remove_all(folder); }

  std::string file(const std::string& name) const {
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    EXPECT_TRUE(write_file(path, "1\n\nC 0 0 0\n"));
    return path;
  }

  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "bihive_recent_files";
  const std::string list = (folder / "state" / "bihive" / "recent").string();
};

TEST_F(Recent, the_newest_comes_first_and_is_there_the_next_time) {
  RecentFiles recent(list);
  EXPECT_TRUE(recent.paths().empty());
  const std::string a = file("a.xyz"), b = file("b with space.xyz");
  for (const std::string& path : {a, b, a}) recent.add(path);
  EXPECT_EQ(recent.paths(), (std::vector<std::string>{a, b}));
  EXPECT_EQ(RecentFiles(list).paths(), recent.paths());
  recent.add(file("sub.xyz") + "/../none.xyz");
  EXPECT_EQ(RecentFiles(list).paths(), (std::vector<std::string>{a, b})) << "it is no file";
}

TEST_F(Recent, files_that_have_gone_are_left_out) {
  RecentFiles recent(list);
  const std::string a = file("a.xyz"), b = file("b.xyz");
  recent.add(a);
  recent.add(b);
  std::filesystem::remove(b);
  EXPECT_EQ(RecentFiles(list).paths(), std::vector<std::string>{a});
}

TEST_F(Recent, there_are_eight_at_most_and_they_can_be_forgotten) {
  RecentFiles recent(list);
  for (int i = 0; i < 12; ++i) recent.add(file(std::to_string(i) + ".xyz"));
  EXPECT_EQ(recent.paths().size(), RecentFiles::kMost);
  EXPECT_EQ(recent.paths().front(), (folder / "11.xyz").string());
  recent.forget();
  EXPECT_TRUE(recent.paths().empty());
  EXPECT_FALSE(std::filesystem::exists(list));
}

TEST_F(Recent, two_windows_share_the_list) {
  RecentFiles one(list), other(list);
  const std::string a = file("a.xyz"), b = file("b.xyz");
  one.add(a);
  other.add(b);
  EXPECT_EQ(RecentFiles(list).paths(), (std::vector<std::string>{b, a}));
}

TEST_F(Recent, nothing_is_kept_where_the_list_cannot_be) {
  const std::string a = file("a.xyz");
  RecentFiles recent(a + "/list");
  recent.add(a);
  RecentFiles none("");
  none.add(a);
  EXPECT_TRUE(none.paths().empty());
}

}  // namespace
}  // namespace bihive
