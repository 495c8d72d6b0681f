// Trajectories (DCD, XTC, TRR) that other programs wrote (tests/data/io/trajectories/make_water), cut and damaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/read_spheres.h"
#include "bihive/io/trajectory.h"

namespace bihive {
namespace {

using TrajectoryPointer = std::shared_ptr<const Trajectory>;

std::string data(const std::string& name) {
  return std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/trajectories/" + name;
}

TrajectoryPointer opened(const std::string& path) {
  Result<TrajectoryPointer> trajectory = open_trajectory(path);
  EXPECT_TRUE(trajectory.ok()) << trajectory.error().to_string();
  return trajectory.ok() ? *trajectory : nullptr;
}

// A file in the test's folder with these bytes.
class Scratch {
 public:
  explicit Scratch(const std::string& bytes)
      : path_(::testing::TempDir() + "bihive_trajectory_test." + std::to_string(getpid())) {
    // Not write_file(): it waits for the disk, and thousands of files are made.
    std::ofstream file(path_, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
    EXPECT_TRUE(file.good());
  }
  ~Scratch() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(Trajectory, the_three_formats_have_the_same_frames) {
  const TrajectoryPointer exact = opened(data("water.trr"));
  ASSERT_NE(exact, nullptr);
  EXPECT_EQ(exact->format(), "TRR");
  for (const char* name : {"water.trr", "water.xtc", "water.dcd"}) {
    const TrajectoryPointer trajectory = opened(data(name));
    ASSERT_NE(trajectory, nullptr);
    EXPECT_EQ(trajectory->frame_count(), 3) << name;
    EXPECT_EQ(trajectory->sphere_count(), 30) << name;
    EXPECT_TRUE(trajectory->warnings().empty()) << name;
    // XTC keeps a hundredth of an Angstrom.
    const double accuracy = trajectory->format() == "XTC" ? 0.00501 : 2e-6;
    for (std::int64_t i = 0; i < 3; ++i) {
      const Result<TrajectoryFrame> frame = trajectory->read(i);
      const Result<TrajectoryFrame> expected = exact->read(i);
      ASSERT_TRUE(frame.ok() && expected.ok()) << name;
      ASSERT_EQ(frame->x.size(), 30u);
      for (std::size_t k = 0; k < 30; ++k) {
        EXPECT_NEAR(frame->x[k], expected->x[k], accuracy) << name;
        EXPECT_NEAR(frame->y[k], expected->y[k], accuracy) << name;
        EXPECT_NEAR(frame->z[k], expected->z[k], accuracy) << name;
      }
      ASSERT_TRUE(frame->cell.has_value()) << name;
      const std::array<Vec3d, 3>& v = frame->cell->vectors;
      EXPECT_NEAR(v[0].x, 12, 1e-5) << name;
      EXPECT_NEAR(v[1].x, 6.5, 1e-5) << name;
      EXPECT_NEAR(v[1].y, 13 * std::sqrt(0.75), 1e-5) << name;
      EXPECT_NEAR(v[2].z, 14, 1e-5) << name;
      EXPECT_TRUE(frame->time_ps.has_value()) << name;
    }
    for (const std::int64_t none : {std::int64_t{-1}, std::int64_t{3}}) {
      const Result<TrajectoryFrame> frame = trajectory->read(none);
      ASSERT_FALSE(frame.ok());
      EXPECT_NE(frame.error().to_string().find("3 frames"), std::string::npos) << frame.error().to_string();
    }
  }
  EXPECT_EQ(*exact->read(2)->time_ps, 4);
  EXPECT_NEAR(exact->read(0)->x[0], 7.0421046, 1e-6);
}

// Every length: the frames before the end, or an error that names the file. Never a crash, never another place.
TEST(Trajectory, cut_files_have_the_frames_before_the_cut) {
  for (const char* name : {"water.trr", "water.xtc", "water.dcd"}) {
    const std::string whole = *read_file(data(name));
    const TrajectoryPointer all = opened(data(name));
    ASSERT_NE(all, nullptr);
    std::int64_t compared = 0;
    for (std::size_t length = 0; length < whole.size(); length += length < 200 ? 1 : 7) {
      const Scratch cut(whole.substr(0, length));
      const Result<TrajectoryPointer> trajectory = open_trajectory(cut.path());
      if (!trajectory) {
        EXPECT_NE(trajectory.error().to_string().find(cut.path()), std::string::npos);
        continue;
      }
      EXPECT_LT((*trajectory)->frame_count(), 3) << name << " " << length;
      for (std::int64_t i = 0; i < (*trajectory)->frame_count(); ++i, ++compared)
        EXPECT_EQ((*trajectory)->read(i)->y, all->read(i)->y) << name << " " << length;
    }
    EXPECT_GT(compared, 0) << name;
  }
}

TEST(Trajectory, damaged_bytes_do_no_harm) {
  for (const char* name : {"water.trr", "water.xtc", "water.dcd"}) {
    const std::string whole = *read_file(data(name));
    for (std::size_t place = 0; place < whole.size(); place += place < 300 ? 1 : 11)
      for (const unsigned char value : {0x00, 0x7f, 0xff}) {
        std::string bytes = whole;
        bytes[place] = static_cast<char>(value);
        const Scratch damaged(bytes);
        const Result<TrajectoryPointer> trajectory = open_trajectory(damaged.path());
        if (!trajectory) continue;
        for (std::int64_t i = 0; i < std::min<std::int64_t>(4, (*trajectory)->frame_count()); ++i) {
          const Result<TrajectoryFrame> frame = (*trajectory)->read(i);
          if (frame.ok()) {
            EXPECT_EQ(frame->x.size(), static_cast<std::size_t>((*trajectory)->sphere_count()));
          }
        }
      }
  }
}

TEST(Trajectory, few_atoms_are_not_packed) {
  // One frame of XTC with two atoms.
  std::string bytes;
  const auto word = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  };
  const auto number = [&](float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    word(bits);
  };
  word(1995);
  word(2);
  word(77);
  number(1.5F);
  for (int i = 0; i < 9; ++i) number(0);
  word(2);
  for (const float value : {0.5F, 1.0F, -2.0F, 3.0F, 0.25F, 8.0F}) number(value);
  const Scratch file(bytes);
  const TrajectoryPointer trajectory = opened(file.path());
  ASSERT_NE(trajectory, nullptr);
  const Result<TrajectoryFrame> frame = trajectory->read(0);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->x, (std::vector<double>{5, 30}));
  EXPECT_EQ(frame->y, (std::vector<double>{10, 2.5}));
  EXPECT_EQ(frame->z, (std::vector<double>{-20, 80}));
  EXPECT_FALSE(frame->cell.has_value());
  EXPECT_EQ(*frame->step, 77);
}

// DCD with fixed atoms, in the other byte order: later frames hold the free ones alone.
TEST(Trajectory, fixed_atoms_of_dcd_stay) {
  std::string bytes;
  const auto word = [&](std::int32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>(static_cast<std::uint32_t>(value) >> shift & 0xFF);
  };
  const auto record = [&](const std::vector<float>& values) {
    word(static_cast<std::int32_t>(4 * values.size()));
    for (const float value : values) {
      std::int32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      word(bits);
    }
    word(static_cast<std::int32_t>(4 * values.size()));
  };
  word(84);
  bytes += "CORD";
  for (int i = 0; i < 20; ++i) word(i == 0 ? 2 : i == 1 ? 100 : i == 2 ? 10 : i == 8 ? 1 : i == 19 ? 24 : 0);
  word(84);
  word(4);
  word(0);
  word(4);
  word(4);
  word(2);
  word(4);
  word(4);
  word(2);  // atom 2 is free
  word(4);
  for (const float axis : {1.0F, 2.0F, 3.0F}) record({axis, 10 * axis});
  for (const float axis : {4.0F, 5.0F, 6.0F}) record({100 * axis});
  const Scratch file(bytes);
  const TrajectoryPointer trajectory = opened(file.path());
  ASSERT_NE(trajectory, nullptr);
  ASSERT_EQ(trajectory->frame_count(), 2);
  EXPECT_EQ(trajectory->read(0)->x, (std::vector<double>{1, 10}));
  EXPECT_EQ(trajectory->read(1)->x, (std::vector<double>{1, 400}));
  EXPECT_EQ(trajectory->read(1)->z, (std::vector<double>{3, 600}));
  EXPECT_EQ(*trajectory->read(1)->step, 110);
}

TEST(Trajectory, places_of_a_frame_replace_those_of_the_file) {
  ReadOptions options;
  options.trajectory = data("water.xtc");
  options.frame = 2;
  const Result<SphereFile> file = read_spheres(data("water.gro"), options);
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->frames, 3);
  EXPECT_EQ(file->format, "GRO");
  EXPECT_NEAR(file->spheres.centre(0).x, 7.70, 1e-4);
  EXPECT_EQ(file->spheres.attributes().element[0], 8);
  EXPECT_EQ(*file->time_ps, 4);
  ASSERT_TRUE(file->spheres.cell().has_value());

  options.frame = 3;
  EXPECT_NE(read_spheres(data("water.gro"), options).error().to_string().find("water.xtc"), std::string::npos);
  options.frame = 0;
  const Result<SphereFile> other = read_spheres(data("water.gsd"), options);
  ASSERT_FALSE(other.ok());
  EXPECT_NE(other.error().message.find("30 atoms"), std::string::npos) << other.error().message;
  options.trajectory = data("water.gro");
  EXPECT_NE(read_spheres(data("water.gro"), options).error().to_string().find("no trajectory"), std::string::npos);
  options.trajectory = data("none.xtc");
  EXPECT_NE(read_spheres(data("water.gro"), options).error().to_string().find("none.xtc"), std::string::npos);

  // A trajectory alone has no names and sizes.
  const Result<SphereFile> alone = read_spheres(data("water.xtc"), {});
  ASSERT_FALSE(alone.ok());
  EXPECT_NE(alone.error().message.find("only together with a file of its atoms"), std::string::npos)
      << alone.error().to_string();
  EXPECT_NE(alone.error().hint.find("give that file first"), std::string::npos) << alone.error().to_string();
}

}  // namespace
}  // namespace bihive
