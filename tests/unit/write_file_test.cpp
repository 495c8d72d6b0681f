// Files are written whole or not at all.
#include "bihive/base/write_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

namespace {

std::atomic<int> g_mask_calls{0};

}  // namespace

// Goes before the C library's. Between the two calls that read the mask by it, files of other threads would be
// everybody's.
extern "C" mode_t umask(mode_t mask) noexcept {
  ++g_mask_calls;
  return static_cast<mode_t>(syscall(SYS_umask, mask));
}

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

TEST_F(WriteFile, a_new_file_obeys_the_mask_and_nobody_touches_it) {
  const auto mode_of = [this](const std::string& name) {
    struct stat info {};
    EXPECT_EQ(stat(in(name).c_str(), &info), 0);
    return info.st_mode & 07777u;
  };
  const mode_t before = umask(0);
  const int calls = g_mask_calls;
  for (const unsigned mask : {0u, 022u, 027u, 077u, 0177u}) {
    syscall(SYS_umask, mask);
    const std::string name = "of_" + std::to_string(mask);
    ASSERT_TRUE(write_file(in(name), "x"));
    EXPECT_EQ(mode_of(name), 0666u & ~mask);
    ASSERT_EQ(chmod(in(name).c_str(), 0604), 0);
    ASSERT_TRUE(write_file(in(name), "y"));
    EXPECT_EQ(mode_of(name), 0604u) << "a file that is replaced keeps its permissions";
  }
  syscall(SYS_umask, before);
  EXPECT_EQ(g_mask_calls, calls);
}

// What SIGKILL leaves between two calls goes away with the next file in that folder, and nothing else does.
TEST_F(WriteFile, parts_that_a_killed_program_left_are_removed) {
  const auto make = [this](const std::string& name) {
    const int file = open(in(name).c_str(), O_CREAT | O_RDWR | O_EXCL, 0400);
    EXPECT_GE(file, 0);
    return file;
  };
  const std::string left = ".bihive-0123456789abcdef.part", alive = ".bihive-fedcba9876543210.part";
  close(make(left));
  const int held = make(alive);
  ASSERT_EQ(flock(held, LOCK_SH), 0);
  std::set<std::string> stay{alive, "target"};
  for (const char* const name : {".bihive-0123456789abcdeg.part", ".bihive-0123456789ABCDEF.part", ".bihive-0123.part",
                                 ".bihive-0123456789abcdef.kept", "bihive-0123456789abcdef.part"}) {
    close(make(name));
    stay.insert(name);
  }
  const std::string link = ".bihive-1111111111111111.part", folder = ".bihive-2222222222222222.part",
                    fifo = ".bihive-3333333333333333.part", foreign = ".bihive-4444444444444444.part";
  close(make("target"));
  fs::create_symlink("target", in(link));
  fs::create_directory(in(folder));
  ASSERT_EQ(mkfifo(in(fifo).c_str(), 0600), 0);
  stay.insert({link, folder, fifo});
  if (geteuid() == 0) {
    close(make(foreign));
    ASSERT_EQ(chown(in(foreign).c_str(), 65534, 65534), 0);
    stay.insert(foreign);
  }
  ASSERT_TRUE(write_file(in("a"), "a"));
  stay.insert("a");
  EXPECT_EQ(names(), stay);
  close(held);
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
  EXPECT_LE(names().size(), 2u) << "the new file has a name only where the system has none without";
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
    EXPECT_LE(names().size(), 1u);
  }
  EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_F(WriteFile, a_link_to_nothing_is_followed) {
  fs::create_directory(in("folder"));
  fs::create_symlink("folder/new", in("link"));
  ASSERT_TRUE(write_file(in("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(read_file(in("folder/new")).value(), "new");
  fs::create_symlink("missing/new", in("nowhere"));
  const Status nowhere = write_file(in("nowhere"), "x");
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().to_string().find("missing"), std::string::npos);
  fs::create_symlink("circle", in("circle"));
  EXPECT_FALSE(check_writable(in("circle")));
}

TEST_F(WriteFile, two_files_take_their_places_together_or_not_at_all) {
  ASSERT_TRUE(write_file(in("a"), "old a"));
  const auto begin = [this](const std::string& name) {
    GrowingFile file = std::move(*GrowingFile::begin(in(name)));
    EXPECT_TRUE(file.append("new " + name));
    return file;
  };
  {
    std::vector<GrowingFile> files;
    for (const char* const name : {"a", "b", "c"}) files.push_back(begin(name));
    // A folder that takes the place of the last one cannot be replaced.
    fs::create_directory(in("c"));
    EXPECT_FALSE(GrowingFile::finish_together(files));
  }
  EXPECT_EQ(read_file(in("a")).value(), "old a");
  EXPECT_EQ(names(), (std::set<std::string>{"a", "c"}));
  fs::remove(in("c"));
  {
    std::vector<GrowingFile> files;
    for (const char* const name : {"a", "b", "c"}) files.push_back(begin(name));
    EXPECT_TRUE(GrowingFile::finish_together(files));
  }
  for (const char* const name : {"a", "b", "c"}) EXPECT_EQ(read_file(in(name)).value(), "new " + std::string(name));
  EXPECT_EQ(names(), (std::set<std::string>{"a", "b", "c"}));
}

TEST_F(WriteFile, an_open_file_goes_on_where_it_stands) {
  ASSERT_TRUE(write_file(in("log"), "before "));
  const int log = open(in("log").c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(log, 0);
  const std::string path = "/dev/fd/" + std::to_string(log);
  EXPECT_TRUE(is_stream(path));
  EXPECT_TRUE(write_file(path, "behind"));
  EXPECT_TRUE(write_file("/proc/self/fd/" + std::to_string(log), " it"));
  close(log);
  EXPECT_EQ(read_file(in("log")).value(), "before behind it");
  EXPECT_FALSE(write_file(path, "closed"));
}

TEST_F(WriteFile, one_file_under_two_names) {
  ASSERT_TRUE(write_file(in("a"), "a"));
  fs::create_symlink("a", in("soft"));
  fs::create_hard_link(in("a"), in("hard"));
  for (const char* const name : {"a", "soft", "hard", "./a"}) EXPECT_TRUE(is_same_file(in(name), in("a"))) << name;
  EXPECT_FALSE(is_same_file(in("b"), in("a")));
  EXPECT_TRUE(is_same_file(in("b"), folder_ + "/./b")) << "a file that is not there yet";
  EXPECT_FALSE(is_same_file("/dev/null", "/dev/null")) << "a device takes two outputs";
}

// The end of such a file would never come: the writer is as quick as the reader.
TEST_F(WriteFile, what_a_growing_file_held_at_its_opening_is_read) {
  ASSERT_TRUE(write_file(in("a"), std::string(1 << 20, 'x')));
  std::atomic<bool> done{false};
  std::thread writer([&] {
    const int file = open(in("a").c_str(), O_WRONLY | O_APPEND);
    const std::string more(1 << 16, 'y');
    // In a hurry first, then slowly until somebody has seen it grow, so that the file stays small.
    for (int i = 0; !done; ++i) {
      EXPECT_GT(::write(file, more.data(), more.size()), 0);
      if (i > 4000) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    close(file);
  });
  bool grew = false;
  for (int attempt = 0; attempt < 50 && !grew; ++attempt) {
    const std::uintmax_t before = fs::file_size(in("a"));
    const std::string bytes = read_file(in("a"), &grew).value();
    EXPECT_LE(bytes.size(), fs::file_size(in("a")));
    EXPECT_GE(bytes.size(), before);
  }
  done = true;
  writer.join();
  EXPECT_TRUE(grew);
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
