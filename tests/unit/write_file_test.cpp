// Files are written whole or not at all.
#include "bihive/base/write_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <set>

namespace bihive {
namespace {

namespace fs = std::filesystem;

class WriteFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = ::testing::TempDir() + "bihive_write_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string in(const std::string& name) const { return folder_ + "/" + name; }
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.insert(entry.path().filename());
    return found;
  }
  std::string folder_;
};

TEST_F(WriteFile, writes_and_replaces) {
  ASSERT_TRUE(write_file(in("a"), "first"));
  ASSERT_TRUE(write_file(in("a"), "second"));
  EXPECT_EQ(read_file(in("a")).value(), "second");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(WriteFile, follows_a_link_and_keeps_the_mode) {
  ASSERT_TRUE(write_file(in("real"), "old"));
  ASSERT_EQ(chmod(in("real").c_str(), 0640), 0);
  fs::create_symlink("real", in("link"));
  ASSERT_TRUE(write_file(in("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(read_file(in("real")).value(), "new");
  struct stat info {};
  ASSERT_EQ(stat(in("real").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST_F(WriteFile, says_what_is_wrong_and_leaves_nothing) {
  fs::create_directory(in("folder"));
  const Status folder = write_file(in("folder"), "x");
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().to_string().find("is a folder"), std::string::npos);
  const Status missing = write_file(in("no/such"), "x");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().to_string().find(in("no")), std::string::npos);
  EXPECT_FALSE(check_writable(in("no/such")));
  EXPECT_FALSE(write_file("", "x"));
  EXPECT_EQ(names(), std::set<std::string>{"folder"});
}

TEST_F(WriteFile, a_full_disk_is_an_error) {
  const Status full = write_file("/dev/full", "x");
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().to_string().find("No space left"), std::string::npos);
  EXPECT_TRUE(write_file("/dev/null", "x")) << "a device is written to, not replaced";
  EXPECT_FALSE(fs::is_regular_file("/dev/null"));
}

TEST_F(WriteFile, reading_says_what_is_wrong) {
  EXPECT_FALSE(read_file(in("none")));
  const Result<std::string> folder = read_file(folder_);
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().to_string().find("is a folder"), std::string::npos);
}

TEST_F(WriteFile, a_growing_file_is_seen_when_it_is_whole) {
  ASSERT_TRUE(write_file(in("a"), "old"));
  Result<GrowingFile> file = GrowingFile::begin(in("a"));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(names().size(), 2u);
  EXPECT_TRUE(file->append("0123456"));
  EXPECT_TRUE(file->write_at(2, "xy"));
  EXPECT_TRUE(file->append("789"));
  EXPECT_TRUE(file->write_at(9, "end"));
  EXPECT_EQ(read_file(in("a")).value(), "old");
  ASSERT_TRUE(file->finish());
  EXPECT_EQ(read_file(in("a")).value(), "01xy45678end");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(WriteFile, a_growing_file_that_is_left_is_removed) {
  {
    Result<GrowingFile> file = GrowingFile::begin(in("a"));
    ASSERT_TRUE(file.ok());
    EXPECT_TRUE(file->append("half"));
    const GrowingFile moved = std::move(*file);
    EXPECT_EQ(names().size(), 1u);
  }
  EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_F(WriteFile, a_device_cannot_go_back) {
  Result<GrowingFile> file = GrowingFile::begin("/dev/null");
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->path_aside(), "");
  EXPECT_TRUE(file->append("bytes"));
  EXPECT_FALSE(file->write_at(0, "b"));
  EXPECT_TRUE(file->finish());
}

}  // namespace
}  // namespace bihive
