// Limits of control groups, in folders that stand in for those of the system.
#include "bihive/base/memory_groups.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace bihive {
namespace {

namespace fs = std::filesystem;

class MemoryGroups : public testing::Test {
 protected:
  fs::path top = fs::temp_directory_path() / ("bihive_groups_" + std::to_string(::getpid()));

  void SetUp() override { fs::create_directories(top / "root"); }
  void TearDown() override { fs::remove_all(top); }

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((top / path).parent_path());
    std::ofstream(top / path) << text;
  }
  MemoryLimit left() const {
    return memory_left_by_groups(limited_groups((top / "cgroup").string(), (top / "root").string()));
  }
  double bytes() const { return left().bytes; }
};

TEST_F(MemoryGroups, Version2TakesTheLowestOnTheWayUp) {
  write("cgroup", "0::/user.slice/box\n");
  write("root/user.slice/box/memory.max", "max\n");
  EXPECT_EQ(bytes(), HUGE_VAL) << "the word max is no limit";
  write("root/user.slice/memory.max", "300000000\n");
  EXPECT_EQ(bytes(), 300000000);
  write("root/user.slice/box/memory.max", "500000000\n");
  EXPECT_EQ(bytes(), 300000000) << "a group has no more than the one above";
  write("root/user.slice/box/memory.max", "200000000\n");
  EXPECT_EQ(bytes(), 200000000);
  EXPECT_EQ(left().whose, "this control group, which allows 200 MB, leaves");
}

TEST_F(MemoryGroups, WhatIsInUseIsNotLeft) {
  write("cgroup", "0::/user.slice/box\n");
  write("root/user.slice/box/memory.max", "200000000\n");
  write("root/user.slice/box/memory.current", "150000000\n");
  EXPECT_EQ(bytes(), 50000000);
  write("root/user.slice/box/memory.stat",
        "anon 90000000\nfile 60000000\ninactive_file 30000000\nactive_file 10000000\n");
  EXPECT_EQ(bytes(), 90000000) << "pages of files can be dropped";
  write("root/user.slice/memory.max", "400000000\n");
  write("root/user.slice/memory.current", "390000000\n");
  EXPECT_EQ(bytes(), 10000000) << "other groups below the one above use it up";
  write("root/user.slice/box/memory.current", "300000000\n");
  EXPECT_EQ(bytes(), 0);
}

TEST_F(MemoryGroups, Version1CountsTheGroupsBelow) {
  write("cgroup", "4:memory:/box\n");
  write("root/memory/box/memory.limit_in_bytes", "100000000\n");
  write("root/memory/box/memory.usage_in_bytes", "70000000\n");
  write(
      "root/memory/box/memory.stat",
      "cache 5\ninactive_file 1000000\nactive_file 2000000\ntotal_inactive_file 3000000\ntotal_active_file 4000000\n");
  EXPECT_EQ(bytes(), 37000000);
}

TEST_F(MemoryGroups, Version1HasAFolderOfItsOwn) {
  write("cgroup", "5:devices:/docker/abc\n4:hugetlb,memory:/docker/abc\n0::/\n");
  write("root/memory/docker/abc/memory.limit_in_bytes", "123456789\n");
  write("root/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("root/docker/abc/memory.max", "1\n");
  EXPECT_EQ(bytes(), 123456789) << "the group of version 2 is the root here";
}

TEST_F(MemoryGroups, InAContainerTheRootIsItsOwn) {
  // The group is named as it is seen from outside, where the container cannot look.
  write("cgroup", "0::/system.slice/docker-abc.scope\n");
  write("root/memory.max", "70000000\n");
  EXPECT_EQ(bytes(), 70000000);
}

TEST_F(MemoryGroups, NothingOfWhatIsDamagedIsALimit) {
  EXPECT_EQ(bytes(), HUGE_VAL) << "no file at all";
  for (const char* const lines : {"", "\n", ":", "::", "0::", "0::relative\n", "memory", "4:memory:\n", "\0:/\n"}) {
    write("cgroup", lines);
    write("root/memory.max", "5\n");
    write("root/memory/memory.limit_in_bytes", "6\n");
    EXPECT_EQ(bytes(), HUGE_VAL) << lines;
  }
  write("cgroup", "0::/");
  for (const char* const text : {"", "0\n", "-5\n", "many\n"}) {
    write("root/memory.max", text);
    EXPECT_EQ(bytes(), HUGE_VAL) << text;
  }
}

}  // namespace
}  // namespace bihive
