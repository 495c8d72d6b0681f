// Names of files as they are typed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bihive/viewer/file_names.h"

namespace bihive {
namespace {

class FileNames : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "file_names_test";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "Runs");
    for (const char* name : {"b.pdb", "Beta.xyz", "beta2.xyz", ".hidden", "größe1.csv", "größe2.csv", "größé.csv"})
      std::ofstream(folder_ / name) << "x";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_.string() + "/" + name; }
  std::vector<std::string> names(const std::string& typed) const {
    std::vector<std::string> found;
    for (const FileName& one : matching_files(path(typed))) found.push_back(one.name + (one.is_folder ? "/" : ""));
    return found;
  }

  std::filesystem::path folder_;
};

using Names = std::vector<std::string>;

TEST_F(FileNames, folders_come_first_and_hidden_ones_when_they_are_asked_for) {
  EXPECT_EQ(names(""), (Names{"Runs/", "Beta.xyz", "b.pdb", "beta2.xyz", "größe1.csv", "größe2.csv", "größé.csv"}));
  EXPECT_EQ(names("."), (Names{".hidden"}));
  EXPECT_EQ(names("none"), Names{});
  EXPECT_EQ(matching_files(path("no/such/folder")).size(), 0u);
  EXPECT_EQ(matching_files(path(""), 2).size(), 2u);
}

TEST_F(FileNames, the_case_of_letters_does_not_matter) {
  EXPECT_EQ(names("BE"), (Names{"Beta.xyz", "beta2.xyz"}));
  EXPECT_EQ(names("r"), (Names{"Runs/"}));
}

TEST_F(FileNames, completion_goes_as_far_as_all_agree) {
  const auto done = [&](const std::string& typed) { return completed(path(typed), matching_files(path(typed))); };
  EXPECT_EQ(done("r"), path("Runs/"));
  EXPECT_EQ(done("b.p"), path("b.pdb"));
  EXPECT_EQ(done("nothing"), path("nothing"));
  EXPECT_EQ(done("be"), path("be")) << "they agree in nothing";
  // ß and é are two bytes each, of which e and é share none, and 1 and 2 neither.
  EXPECT_EQ(done("g"), path("größ"));
  EXPECT_EQ(done("größe"), path("größe"));
}

TEST_F(FileNames, a_tilde_is_the_own_folder) {
  const char* const before = std::getenv("HOME");
  const std::string home = before == nullptr ? "" : before;
  setenv("HOME", folder_.c_str(), 1);
  EXPECT_EQ(with_home("~"), folder_.string());
  EXPECT_EQ(with_home("~/b.pdb"), path("b.pdb"));
  EXPECT_EQ(with_home("~other/b.pdb"), "~other/b.pdb");
  EXPECT_EQ(with_home("a~"), "a~");
  EXPECT_EQ(completed("~", matching_files("~")), "~/");
  EXPECT_EQ(completed("~/b.", matching_files("~/b.")), "~/b.pdb");
  unsetenv("HOME");
  EXPECT_EQ(with_home("~/b.pdb"), "~/b.pdb");
  if (before != nullptr) setenv("HOME", home.c_str(), 1);
}

TEST_F(FileNames, another_last_name) {
  EXPECT_EQ(with_last_name("a/b", {"c", false}), "a/c");
  EXPECT_EQ(with_last_name("a/", {"c", true}), "a/c/");
  EXPECT_EQ(with_last_name("", {"c", false}), "c");
}

}  // namespace
}  // namespace bihive
