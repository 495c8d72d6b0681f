// Frames::read(i), and read_spheres() of a file, against the readers that have the whole file in memory: everything of
// the answer, bit for bit, and every error with its line.
// ctest: threads
#include "bihive/io/frames.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "support/films.h"
#include "support/gzip.h"

namespace bihive {
namespace {

using test::Film;
using test::make_films;
using test::outcome;
using FramesPointer = std::shared_ptr<const Frames>;

const std::string kData = std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/";

// Inputs of a fuzz target: those with names and those that are unpacked (tests/fuzz/corpora.cmake).
std::vector<std::filesystem::path> fuzz_inputs(const std::string& target) {
  std::vector<std::filesystem::path> files;
  for (const std::string folder : {BIHIVE_SOURCE_DIR "/tests/fuzz/corpus/", BIHIVE_UNPACKED_CORPORA "/"})
    if (std::filesystem::exists(folder + target))
      for (const auto& entry : std::filesystem::directory_iterator(folder + target)) files.push_back(entry.path());
  return files;
}

class FramesTest : public ::testing::Test {
 protected:
  FramesTest() : folder_(::testing::TempDir() + "bihive_frames_test." + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~FramesTest() override { std::filesystem::remove_all(folder_); }

  std::string write(const Film& film) const {
    const std::string path = folder_ + "/" + film.name;
    EXPECT_TRUE(write_file(path, film.bytes).ok());
    return path;
  }

  std::string folder_;
};

// As the readers of whole files say it.
std::string expected(const std::string& bytes, const std::string& path, std::int64_t frame, ReadOptions options = {}) {
  options.frame = frame;
  return outcome(read_spheres_from_memory(bytes, path, options));
}

std::string read_alone(const std::string& path, std::int64_t frame, ReadOptions options = {}) {
  options.frame = frame;
  return outcome(read_spheres(path, options));
}

// The places 0 to count - 1 in an order that has no order.
std::vector<std::int64_t> shuffled(std::int64_t count, std::uint64_t seed) {
  std::vector<std::int64_t> order;
  for (std::int64_t i = 0; i < count; ++i) order.push_back(i);
  SplitMix64 rng(seed);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(rng.next_double() * static_cast<double>(i))]);
  return order;
}

void expect_same_frames(const std::string& path, std::int64_t count, const ReadOptions& options = {}) {
  SCOPED_TRACE(path);
  const std::string bytes = read_file(path).value();
  const Result<FramesPointer> frames = open_frames(path, options);
  ASSERT_TRUE(frames.ok()) << frames.error().to_string();
  EXPECT_EQ((*frames)->count(), count);
  for (const std::int64_t frame : shuffled(count, 7)) {
    const std::string whole = expected(bytes, path, frame, options);
    EXPECT_EQ(whole.find("error: "), std::string::npos) << whole;
    EXPECT_TRUE(outcome((*frames)->read(frame)) == whole) << frame;
    EXPECT_TRUE(read_alone(path, frame, options) == whole) << frame;
  }
  // Reading counts from the end too; frames that are open do not.
  EXPECT_TRUE(expected(bytes, path, -1, options) == expected(bytes, path, count - 1, options));
  EXPECT_TRUE(read_alone(path, -count, options) == expected(bytes, path, 0, options));
  EXPECT_EQ(outcome((*frames)->read(-1)).rfind("error: ", 0), 0u);
  for (const std::int64_t none : {-count - 1, count, count + 5}) {
    const std::string error = expected(bytes, path, none, options);
    EXPECT_EQ(error.rfind("error: ", 0), 0u);
    EXPECT_EQ(outcome((*frames)->read(none)), error);
    EXPECT_EQ(read_alone(path, none, options), error);
  }
}

TEST_F(FramesTest, are_those_of_the_whole_file) {
  for (const Film& film : make_films(12, 30)) expect_same_frames(write(film), 12);
}

// Windows of a quarter of a megabyte end within frames, within lines, and between CR and LF.
TEST_F(FramesTest, are_the_same_beyond_one_window) {
  for (const Film& film : make_films(3, 12000, 5)) expect_same_frames(write(film), 3);
}

TEST_F(FramesTest, of_packed_files_are_the_same) {
  for (const Film& film : make_films(5, 200, 21)) {
    const std::string path = write({film.name + ".gz", test::gzip(film.bytes.substr(0, film.bytes.size() / 3)) +
                                                           test::gzip(film.bytes.substr(film.bytes.size() / 3))});
    SCOPED_TRACE(path);
    const Result<FramesPointer> frames = open_frames(path, {});
    ASSERT_TRUE(frames.ok()) << frames.error().to_string();
    for (const std::int64_t frame : shuffled((*frames)->count(), 5))
      EXPECT_TRUE(outcome((*frames)->read(frame)) == expected(film.bytes, path, frame)) << frame;
  }
}

// They go to the disk, and leave nothing there.
TEST_F(FramesTest, of_large_packed_files_are_the_same) {
  Film film{"a.xyz", ""};
  for (const char* const line : {"C 1.000000 2.000000 3.000000\n", "O 1.500000 2.500000 3.500000\n"}) {
    film.bytes += "700000\n\n";
    for (int i = 0; i < 700000; ++i) film.bytes += line;
  }
  ASSERT_GT(film.bytes.size(), std::size_t{36} << 20);
  const std::string path = write({film.name + ".gz", test::gzip(film.bytes, 1)});
  const std::string disk = folder_ + "/disk";
  std::filesystem::create_directory(disk);
  ASSERT_EQ(setenv("TMPDIR", disk.c_str(), 1), 0);
  const Result<FramesPointer> frames = open_frames(path, {});
  ASSERT_TRUE(frames.ok()) << frames.error().to_string();
  EXPECT_TRUE(std::filesystem::is_empty(disk));
  EXPECT_TRUE(outcome((*frames)->read(1)) == expected(film.bytes, path, 1));
  std::filesystem::remove(disk);
  const Result<FramesPointer> none = open_frames(path, {});
  ASSERT_EQ(unsetenv("TMPDIR"), 0);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().to_string().find("no room to unpack it in " + disk), std::string::npos)
      << none.error().to_string();
}

TEST_F(FramesTest, are_the_same_with_options) {
  ReadOptions options;
  options.recenter = true;
  options.radius_scale = 0.5;
  options.cell_vectors = {{Vec3d{40, 0, 0}, Vec3d{0, 41, 0}, Vec3d{0, 0, 42}}};
  options.replicate = {2, 1, 1};
  options.wrapping = Wrapping::wrap;
  for (const Film& film : make_films(4, 20, 3)) expect_same_frames(write(film), 4, options);
  options.assembly = "1";
  options.radius = 0.25;
  expect_same_frames(write(make_films(4, 20, 4).front()), 4, options);
}

TEST_F(FramesTest, of_every_file_of_the_tests) {
  expect_same_frames(kData + "trajectories/water.gro", 1);
  expect_same_frames(kData + "trajectories/water.gsd", 2);
  for (const auto& entry : std::filesystem::directory_iterator(kData))
    if (entry.path().extension() == ".npy") expect_same_frames(entry.path(), 1);
  for (const char* name : {"water.dcd", "water.xtc", "water.trr"}) {
    ReadOptions options;
    options.trajectory = kData + "trajectories/" + name;
    expect_same_frames(kData + "trajectories/water.gro", 3, options);
  }
}

// Inputs that the fuzzers found, with every fault that a file may have.
TEST_F(FramesTest, have_the_errors_of_the_whole_file) {
  const char* const kinds[][2] = {{"pdb", "a.pdb"},   {"pqr", "a.pqr"}, {"xyz", "a.xyz"},   {"lammps_dump", "a.dump"},
                                  {"mmcif", "a.cif"}, {"csv", "a.csv"}, {"any_format", "a"}};
  int files = 0;
  for (const auto& [folder, name] : kinds)
    for (const auto& entry : fuzz_inputs(folder)) {
      // The first byte chooses options there.
      const std::string bytes = read_file(entry).value();
      const std::string path = write({name, bytes.substr(std::min<std::size_t>(1, bytes.size()))});
      SCOPED_TRACE(entry.string());
      for (std::int64_t frame = -1; frame < 4; ++frame)
        EXPECT_TRUE(read_alone(path, frame) == expected(read_file(path).value(), path, frame)) << frame;
      ++files;
    }
  EXPECT_GT(files, 1000);
}

// A file may be cut anywhere, and a letter in place of a digit may stand anywhere.
TEST_F(FramesTest, of_cut_and_damaged_files_have_the_errors_of_the_whole_file) {
  SplitMix64 rng(11);
  for (const Film& film : make_films(4, 6, 9))
    for (int round = 0; round < 60; ++round) {
      Film broken = film;
      const auto at = static_cast<std::size_t>(rng.next_double() * static_cast<double>(film.bytes.size()));
      if (round % 2 == 0)
        broken.bytes.resize(at);
      else
        broken.bytes[at] = 'q';
      const std::string path = write(broken);
      SCOPED_TRACE(film.name + (round % 2 == 0 ? " cut at " : " damaged at ") + std::to_string(at));
      for (std::int64_t frame = 0; frame < 5; ++frame)
        ASSERT_EQ(read_alone(path, frame), expected(broken.bytes, path, frame)) << frame;
      const Result<FramesPointer> frames = open_frames(path, {});
      const std::string first = expected(broken.bytes, path, 0);
      ASSERT_EQ(frames.ok(), first.rfind("error: ", 0) != 0);
      if (!frames) {
        ASSERT_EQ("error: " + frames.error().to_string(), first);
        continue;
      }
      for (std::int64_t frame = 0; frame <= (*frames)->count(); ++frame)
        ASSERT_TRUE(outcome((*frames)->read(frame)) == expected(broken.bytes, path, frame)) << frame;
    }
}

TEST_F(FramesTest, name_the_line_of_the_file) {
  std::string text;
  for (int frame = 0; frame < 5; ++frame)
    text += "2\n\nC 0 0 0\n" + std::string(frame == 3 ? "C 1 one 1\n" : "C 1 1 1\n");
  const std::string path = write({"a.xyz", text});
  const Result<FramesPointer> frames = open_frames(path, {});
  ASSERT_TRUE(frames.ok()) << frames.error().to_string();
  EXPECT_TRUE((*frames)->read(4).ok());
  const Result<SphereFile> bad = (*frames)->read(3);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().line, 16);
  EXPECT_EQ(bad.error().column, 5);
  EXPECT_EQ(bad.error().file, path);
}

TEST_F(FramesTest, are_read_by_any_number_of_threads) {
  for (const Film& film : make_films(40, 30, 13)) {
    const std::string path = write(film);
    const Result<FramesPointer> frames = open_frames(path, {});
    ASSERT_TRUE(frames.ok());
    std::vector<std::string> answers(40);
    const std::vector<std::int64_t> order = shuffled(40, 3);
    parallel_for(8, 40, [&](std::int64_t i) {
      const std::int64_t frame = order[static_cast<std::size_t>(i)];
      answers[static_cast<std::size_t>(frame)] = outcome((*frames)->read(frame));
    });
    for (std::int64_t frame = 0; frame < 40; ++frame)
      EXPECT_TRUE(answers[static_cast<std::size_t>(frame)] == expected(film.bytes, path, frame)) << film.name << frame;
  }
}

// A simulation goes on and writes behind; another program writes a new file in place of the old one.
TEST_F(FramesTest, of_a_file_that_changes) {
  const Film film = make_films(6, 20, 17)[6];
  ASSERT_EQ(film.name, "labels.xyz");
  const std::string path = write(film);
  const Result<FramesPointer> frames = open_frames(path, {});
  ASSERT_TRUE(frames.ok());
  std::ofstream(path, std::ios::app) << "1\n\nC 0 0 0\n";
  EXPECT_TRUE(outcome((*frames)->read(4)) == expected(film.bytes, path, 4));
  std::filesystem::resize_file(path, film.bytes.size() / 2);
  for (std::int64_t frame = 0; frame < 6; ++frame)
    EXPECT_EQ(outcome((*frames)->read(frame)), "error: " + path +
                                                   ": the file changed while it was read; begin again when it is "
                                                   "complete");
}

TEST_F(FramesTest, are_the_same_with_a_kept_index) {
  const FramesOptions keep{true};
  for (const Film& film : make_films(9, 20, 29)) {
    SCOPED_TRACE(film.name);
    const std::string path = write(film), kept = path + ".bihive-index";
    const bool is_indexed = film.name != "a.cif";
    const auto expect_frames = [&](const std::string& warning) {
      const Result<FramesPointer> frames = open_frames(path, {}, keep);
      ASSERT_TRUE(frames.ok()) << frames.error().to_string();
      EXPECT_EQ((*frames)->warnings(), warning.empty() ? std::vector<std::string>{} : std::vector{warning});
      for (const std::int64_t frame : shuffled(9, 2))
        EXPECT_TRUE(outcome((*frames)->read(frame)) == expected(film.bytes, path, frame)) << frame;
      EXPECT_EQ(outcome((*frames)->read(9)), expected(film.bytes, path, 9));
    };
    expect_frames("");
    EXPECT_EQ(std::filesystem::exists(kept), is_indexed);
    if (!is_indexed) continue;
    const std::string index = read_file(kept).value();
    expect_frames("");

    // Damaged in any byte after the words of its mark, cut, of another file: it is made anew.
    const std::size_t words = std::string_view("bihive frames ").size();
    const std::string of_no_use = kept + ": is damaged, or belongs to another version of the file; it is made anew";
    for (std::size_t at = words; at < index.size(); at += 61) {
      std::string damaged = index;
      damaged[at] = static_cast<char>(damaged[at] ^ 4);
      ASSERT_TRUE(write_file(kept, damaged).ok());
      const Result<FramesPointer> frames = open_frames(path, {}, keep);
      ASSERT_TRUE(frames.ok());
      EXPECT_EQ((*frames)->warnings(), std::vector{of_no_use}) << at;
      EXPECT_EQ(read_file(kept).value(), index);
    }
    ASSERT_TRUE(write_file(kept, index.substr(0, index.size() / 2)).ok());
    expect_frames(of_no_use);
    std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(5));
    expect_frames(of_no_use);
    expect_frames("");
  }
}

TEST_F(FramesTest, know_bonds_that_follow_the_last_one) {
  const std::string model =
      "HETATM    1  C   LIG A   1       9.500   5.000   5.000  1.00  0.00           C\n"
      "HETATM    2  O   LIG A   2       0.500   5.000   5.000  1.00  0.00           O\n"
      "ENDMDL\n";
  const std::string cell = "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1\n";
  const std::string path = write({"bonds.pdb", cell + model + model + "CONECT    1    2\n"});
  ReadOptions options;
  options.wrapping = Wrapping::unwrap;
  for (int time = 0; time < 2; ++time) {
    const Result<FramesPointer> frames = open_frames(path, options, FramesOptions{true});
    ASSERT_TRUE(frames.ok()) << frames.error().to_string();
    for (const std::int64_t frame : {1, 0}) EXPECT_EQ((*frames)->read(frame)->spheres.centre(1).x, 10.5);
  }
}

TEST_F(FramesTest, need_a_file) {
  for (const std::string& path : {folder_, folder_ + "/none.xyz", write({"empty.xyz", ""})}) {
    const Result<FramesPointer> frames = open_frames(path, {});
    ASSERT_FALSE(frames.ok());
    const Result<std::string> bytes = read_file(path);
    EXPECT_EQ(frames.error().to_string(), bytes ? path + ": the file is empty" : bytes.error().to_string());
  }
}

}  // namespace
}  // namespace bihive
