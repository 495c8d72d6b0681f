// Means of coordinates over frames (ReadOptions::smooth).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::read_text;

ReadOptions smoothed(std::int64_t frame, std::int64_t over) {
  ReadOptions options = test::at_frame(frame);
  options.smooth = over;
  return options;
}

// A sphere at each x of a frame, in a cell that is `side` long; 0: none.
std::string xyz(const std::vector<std::vector<double>>& frames, double side = 0) {
  const std::string length = std::to_string(side);
  const std::string cell = "Lattice=\"" + length + " 0 0 0 " + length + " 0 0 0 " + length + "\"";
  std::string text;
  for (const std::vector<double>& frame : frames) {
    text += std::to_string(frame.size()) + "\n" + (side > 0 ? cell : "") + "\n";
    for (const double x : frame) text += "C " + std::to_string(x) + " 1 2\n";
  }
  return text;
}

std::vector<double> x_of(const SphereFile& file) {
  std::vector<double> x;
  for (std::int64_t id = 0; id < file.spheres.size(); ++id) x.push_back(file.spheres.centre(id).x);
  return x;
}

using Numbers = std::vector<double>;

TEST(FrameMeans, HaveTheFrameInTheMiddle) {
  const std::string film = xyz({{0, 8}, {1, 8}, {5, 2}, {9, 2}, {1, 8}});
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(2, 1))), (Numbers{5, 2}));
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(2, 3))), (Numbers{5, 4}));
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(3, 3))), (Numbers{5, 4}));
  const SphereFile wide = read_text(film, "a.xyz", smoothed(2, 5));
  EXPECT_NEAR(x_of(wide)[0], 16 / 5.0, 1e-6);
  EXPECT_NEAR(x_of(wide)[1], 28 / 5.0, 1e-6);
  EXPECT_NE(std::find(wide.rules.begin(), wide.rules.end(), "coordinates: means over frames 0 to 4"), wide.rules.end());
}

TEST(FrameMeans, AreOverFewerFramesNearTheEnds) {
  const std::string film = xyz({{0}, {4}, {5}, {6}, {20}});
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(0, 5))), Numbers{0});
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(1, 5))), Numbers{3});
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(-2, 101))), Numbers{31 / 3.0f});
  EXPECT_EQ(x_of(read_text(film, "a.xyz", smoothed(-1, 5))), Numbers{20});
}

TEST(FrameMeans, TakeTheShortestWayThroughACell) {
  // It leaves the cell at 10, comes in at 0, and goes on: 8.5, 9.5, 10.5, 11.5 and 13.
  const std::string film = xyz({{8.5}, {9.5}, {0.5}, {1.5}, {3}}, 10);
  EXPECT_NEAR(x_of(read_text(film, "a.xyz", smoothed(2, 3)))[0], 0.5, 1e-6);
  EXPECT_NEAR(x_of(read_text(film, "a.xyz", smoothed(2, 5)))[0], 0.6, 1e-6);
  EXPECT_NEAR(x_of(read_text(film, "a.xyz", smoothed(1, 3)))[0], 9.5, 1e-6);
  ReadOptions alone = smoothed(1, 3);
  alone.periodic = false;
  EXPECT_NEAR(x_of(read_text(film, "a.xyz", alone))[0], 18.5 / 3, 1e-6);
  // Wrapped after it.
  ReadOptions wrapped = smoothed(2, 3);
  wrapped.wrapping = Wrapping::wrap;
  const std::string back = xyz({{8}, {9.5}, {0.2}, {9.6}, {8.9}}, 10);
  EXPECT_NEAR(x_of(read_text(back, "a.xyz", wrapped))[0], 10.2 - 1.3 / 3, 1e-5);
}

TEST(FrameMeans, AreTheSameWhateverFrameIsReadBefore) {
  std::vector<Numbers> frames;
  for (int k = 0; k < 40; ++k) frames.push_back({std::fmod(k * 3.7, 11), std::fmod(k * 0.9, 11)});
  const std::string text = xyz(frames, 11), path = ::testing::TempDir() + "bihive_means." + std::to_string(getpid());
  ASSERT_TRUE(write_file(path, text).ok());
  for (const std::int64_t step : {1, 7, 39}) {
    const Result<std::shared_ptr<const Frames>> opened = open_frames(path, smoothed(0, 9));
    ASSERT_TRUE(opened.ok());
    for (std::int64_t k = 0; k < 40; ++k) {
      const std::int64_t frame = k * step % 40;
      const Result<SphereFile> read = (*opened)->read(frame);
      ASSERT_TRUE(read.ok()) << read.error().to_string();
      EXPECT_EQ(x_of(*read), x_of(read_text(text, "a.xyz", smoothed(frame, 9)))) << frame;
    }
  }
  std::remove(path.c_str());
}

TEST(FrameMeans, NeedTheSameSpheres) {
  const std::string number = error_of(xyz({{0}, {1}, {2, 3}}), "a.xyz", smoothed(1, 3));
  EXPECT_NE(number.find("frames 1 and 2 have 1 and 2 spheres"), std::string::npos) << number;
  const std::string elements = error_of("1\n\nC 0 0 0\n1\n\nO 0 0 0\n1\n\nC 0 0 0\n", "a.xyz", smoothed(1, 3));
  EXPECT_NE(elements.find("other elements"), std::string::npos) << elements;
  // Rows come in any order: the spheres go by their ids.
  const auto frame = [](const std::string& rows) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 100\n0 100\n0 100\n"
           "ITEM: ATOMS id x y z\n" +
           rows;
  };
  const std::string dump = frame("1 0 0 0\n2 10 0 0\n") + frame("2 13 0 0\n1 3 0 0\n") + frame("1 9 0 0\n2 10 0 0\n");
  EXPECT_EQ(x_of(read_text(dump, "a.dump", smoothed(1, 3))), (Numbers{4, 11}));
  const std::string other = frame("1 0 0 0\n2 10 0 0\n") + frame("2 13 0 0\n1 3 0 0\n") + frame("1 9 0 0\n3 10 0 0\n");
  const std::string ids = error_of(other, "a.dump", smoothed(1, 3));
  EXPECT_NE(ids.find("other ids"), std::string::npos) << ids;
}

TEST(FrameMeans, OfOneFrameChangeNothingAndSaySo) {
  const SphereFile file = read_text(xyz({{3}}), "a.xyz", smoothed(0, 5));
  EXPECT_EQ(x_of(file), Numbers{3});
  ASSERT_FALSE(file.warnings.empty());
  EXPECT_NE(file.warnings.front().find("smooth changes nothing"), std::string::npos);
}

TEST(FrameMeans, OfATrajectory) {
  const std::string folder = std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/trajectories/";
  ReadOptions options;
  options.trajectory = folder + "water.xtc";
  options.periodic = false;
  std::vector<Numbers> frames;
  for (options.frame = 0; options.frame < 3; ++options.frame)
    frames.push_back(x_of(read_spheres(folder + "water.gro", options).value()));
  options.frame = 1;
  options.smooth = 3;
  const Numbers means = x_of(read_spheres(folder + "water.gro", options).value());
  ASSERT_EQ(means.size(), frames[0].size());
  for (std::size_t i = 0; i < means.size(); ++i)
    EXPECT_NEAR(means[i], (frames[0][i] + frames[1][i] + frames[2][i]) / 3, 1e-4);
}

}  // namespace
}  // namespace bihive
