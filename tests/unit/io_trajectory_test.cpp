// Trajectories (DCD, XTC, TRR) that other programs wrote (tests/data/io/trajectories/make_water), cut and damaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/read_spheres.h"
#include "bihive/io/trajectory.h"
#include "support/read_text.h"

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
class ScratchTrajectory {
 public:
  explicit ScratchTrajectory(const std::string& bytes, const std::string& ending = "")
      : path_(::testing::TempDir() + "bihive_trajectory_test." + std::to_string(getpid()) + ending) {
    // Not write_file(): it waits for the disk, and thousands of files are made.
    std::ofstream file(path_, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
    EXPECT_TRUE(file.good());
  }
  ~ScratchTrajectory() { std::remove(path_.c_str()); }
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
      const ScratchTrajectory cut(whole.substr(0, length));
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
        const ScratchTrajectory damaged(bytes);
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
  const ScratchTrajectory file(bytes);
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
  const ScratchTrajectory file(bytes);
  const TrajectoryPointer trajectory = opened(file.path());
  ASSERT_NE(trajectory, nullptr);
  ASSERT_EQ(trajectory->frame_count(), 2);
  EXPECT_EQ(trajectory->read(0)->x, (std::vector<double>{1, 10}));
  EXPECT_EQ(trajectory->read(1)->x, (std::vector<double>{1, 400}));
  EXPECT_EQ(trajectory->read(1)->z, (std::vector<double>{3, 600}));
  EXPECT_EQ(*trajectory->read(1)->step, 110);
}

// Numbers as Fortran and XDR store them.
class Bytes {
 public:
  explicit Bytes(bool big_endian = false) : big_endian_(big_endian) {}

  template <class T>
  Bytes& put(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_endian_) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
    return *this;
  }
  template <class T>
  Bytes& put_all(const std::vector<T>& values) {
    for (const T& value : values) put(value);
    return *this;
  }

  std::string text;

 private:
  bool big_endian_;
};

// DCD files of CHARMM with a cell in some frames.
struct DcdWriter {
  std::int32_t version = 24;
  bool wide_marks = false, big_endian = false;

  std::string record(const std::string& content) const {
    Bytes mark(big_endian);
    wide_marks ? mark.put(static_cast<std::int64_t>(content.size()))
               : mark.put(static_cast<std::int32_t>(content.size()));
    return mark.text + content + mark.text;
  }
  std::string head(std::int32_t atoms) const {
    Bytes control(big_endian);
    control.text = "CORD";
    for (int i = 0; i < 20; ++i) control.put(i == 2 || i == 10 ? 1 : i == 19 ? version : 0);
    return record(control.text) + record(Bytes(big_endian).put(0).text) + record(Bytes(big_endian).put(atoms).text);
  }
  std::string frame(const std::vector<double>& cell, float first, std::size_t atoms = 3) const {
    std::string made = cell.empty() ? "" : record(Bytes(big_endian).put_all(cell).text);
    for (int axis = 0; axis < 3; ++axis) {
      Bytes numbers(big_endian);
      for (std::size_t i = 0; i < atoms; ++i)
        numbers.put(first + static_cast<float>(10 * axis) + static_cast<float>(i));
      made += record(numbers.text);
    }
    return made;
  }
};

std::array<Vec3d, 3> dcd_cell(std::int32_t version, const std::vector<double>& record) {
  const DcdWriter writer{version};
  const ScratchTrajectory file(writer.head(3) + writer.frame(record, 1));
  const TrajectoryPointer trajectory = opened(file.path());
  const Result<TrajectoryFrame> frame = trajectory->read(0);
  EXPECT_TRUE(frame.ok() && frame->cell) << version;
  return frame.ok() && frame->cell ? frame->cell->vectors : std::array<Vec3d, 3>{};
}

// The matrix of a monoclinic cell of 91 degrees: beside its diagonal all numbers look like cosines.
TEST(Trajectory, dcd_cells_are_read_by_the_version_of_charmm) {
  const std::vector<double> record{39.9978, 0, 50, -0.41887, 0, 59.99854};
  EXPECT_EQ(dcd_cell(35, record),
            (std::array<Vec3d, 3>{Vec3d{39.9978, 0, -0.41887}, Vec3d{0, 50, 0}, Vec3d{-0.41887, 0, 59.99854}}));
  EXPECT_NEAR(dcd_cell(24, record)[2].x, -0.41887 * 59.99854, 1e-9);
  // Some programs state a late version and write lengths and angles.
  for (const std::int32_t version : {24, 35}) {
    const std::array<Vec3d, 3> cell = dcd_cell(version, {10, 60, 20, 90, 90, 30});
    EXPECT_NEAR(cell[1].x, 10, 1e-9) << version;
    EXPECT_NEAR(cell[2].z, 30, 1e-9) << version;
    EXPECT_EQ(dcd_cell(version, {300, 90, 300, 90, 90, 300})[1], (Vec3d{0, 300, 0})) << version;
  }
}

TEST(Trajectory, frames_of_dcd_may_lack_the_cell) {
  const DcdWriter writer;
  const std::vector<double> cell{10, 90, 20, 90, 90, 30};
  const ScratchTrajectory file(writer.head(3) + writer.frame(cell, 1) + writer.frame({}, 2) + writer.frame(cell, 3));
  const TrajectoryPointer trajectory = opened(file.path());
  ASSERT_EQ(trajectory->frame_count(), 3);
  EXPECT_TRUE(trajectory->warnings().empty());
  EXPECT_FALSE(trajectory->read(1)->cell.has_value());
  EXPECT_EQ(trajectory->read(1)->y, (std::vector<double>{12, 13, 14}));
  EXPECT_TRUE(trajectory->read(2)->cell.has_value());
  EXPECT_EQ(trajectory->read(2)->z, (std::vector<double>{23, 24, 25}));
  // As many bytes more than whole frames as two cells: the length alone does not tell.
  const ScratchTrajectory none(writer.head(3) + writer.frame({}, 1) + writer.frame({}, 2));
  EXPECT_EQ(opened(none.path())->frame_count(), 2);
  EXPECT_EQ(opened(none.path())->read(1)->x, (std::vector<double>{2, 3, 4}));
}

TEST(Trajectory, lengths_of_dcd_records_may_have_64_bits) {
  for (const bool big_endian : {false, true}) {
    const DcdWriter writer{24, true, big_endian};
    const std::vector<double> cell{10, 90, 20, 90, 90, 30};
    const ScratchTrajectory file(writer.head(3) + writer.frame(cell, 1) + writer.frame(cell, 2));
    const TrajectoryPointer trajectory = opened(file.path());
    ASSERT_NE(trajectory, nullptr);
    ASSERT_EQ(trajectory->frame_count(), 2);
    EXPECT_EQ(trajectory->read(1)->x, (std::vector<double>{2, 3, 4}));
    EXPECT_EQ(trajectory->read(1)->cell->vectors[1], (Vec3d{0, 20, 0}));
  }
}

// No cell is written as zeros; other numbers that make none are told.
TEST(Trajectory, cells_that_cannot_be_read_are_told) {
  const DcdWriter writer;
  const ScratchTrajectory file(writer.head(3) + writer.frame({0, 90, 0, 90, 90, 0}, 1) +
                               writer.frame({10, 90, 20, 90, 90, 0}, 2));
  const TrajectoryPointer trajectory = opened(file.path());
  EXPECT_FALSE(trajectory->read(0)->cell.has_value());
  EXPECT_TRUE(trajectory->read(0)->warnings.empty());
  EXPECT_FALSE(trajectory->read(1)->cell.has_value());
  EXPECT_EQ(trajectory->read(1)->warnings,
            (std::vector<std::string>{"frame 1: the numbers of its cell make none, so it is left out"}));
}

// A machine that stops leaves zeros where frames should be.
TEST(Trajectory, whole_frames_before_a_damaged_tail_stay) {
  for (const char* name : {"water.trr", "water.xtc", "water.dcd"})
    for (const char byte : {'\0', 'x'}) {
      const std::string whole = *read_file(data(name));
      const ScratchTrajectory file(whole + std::string(600, byte));
      const TrajectoryPointer trajectory = opened(file.path());
      ASSERT_NE(trajectory, nullptr) << name;
      EXPECT_EQ(trajectory->frame_count(), 3) << name;
      ASSERT_EQ(trajectory->warnings().size(), 1u) << name;
      EXPECT_EQ(trajectory->warnings()[0], "frame 3 does not begin as a frame at byte " + std::to_string(whole.size()) +
                                               ": the last 600 bytes are left out; the file may be damaged");
      EXPECT_EQ(trajectory->read(2)->y, opened(data(name))->read(2)->y) << name;
    }
  // Without a whole frame before it is an error.
  const ScratchTrajectory file(DcdWriter{}.head(3) + std::string(600, '\0'));
  const Result<TrajectoryPointer> none = open_trajectory(file.path());
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("another number of atoms than its head says"), std::string::npos);
}

// Where neighbours lie farther apart than the last size of XTC's table, its length is stated as the size's position.
TEST(Trajectory, xtc_states_the_length_of_its_table_of_sizes) {
  constexpr int kAtoms = 10, kBits = 26;
  for (const bool has_run : {false, true}) {
    Bytes file(true);
    file.put(1995).put(kAtoms).put(5).put(1.0F);
    for (int i = 0; i < 9; ++i) file.put(0.0F);
    file.put(kAtoms).put(1000.0F);
    for (const std::int32_t end : {0, 1 << 25})
      for (int axis = 0; axis < 3; ++axis) file.put(end);
    file.put(73);
    std::string bits;
    for (int i = 0; i < kAtoms; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        for (int bit = kBits - 1; bit >= 0; --bit)
          bits += (i % 2 == 0 ? 0 : (1 << 25) - 1000 * axis) >> bit & 1 ? '1' : '0';
      bits += has_run ? "100100" : "0";
    }
    while (bits.size() % 32 != 0) bits += '0';
    file.put(static_cast<std::int32_t>(bits.size() / 8));
    for (std::size_t i = 0; i < bits.size(); i += 8)
      file.text += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
    const ScratchTrajectory scratch(file.text);
    const TrajectoryPointer trajectory = opened(scratch.path());
    ASSERT_NE(trajectory, nullptr);
    const Result<TrajectoryFrame> frame = trajectory->read(0);
    EXPECT_EQ(frame.ok(), !has_run);
    if (!frame.ok()) continue;
    EXPECT_NEAR(frame->x[1], 335544.32, 0.1);
    EXPECT_NEAR(frame->z[9], 335544.32 - 20, 0.1);
    EXPECT_EQ(frame->y[8], 0);
  }
}

// One frame of TRR with velocities and forces of two atoms.
std::string trr_with_velocities() {
  Bytes file(true);
  file.put(1993).put(13).put(12);
  file.text += "GMX_trn_file";
  for (const std::int32_t bytes : {0, 0, 36, 0, 0, 0, 0, 24, 24, 24}) file.put(bytes);
  file.put(2).put(7).put(0).put(1.5F).put(0.0F);
  for (int i = 0; i < 9; ++i) file.put(i % 4 == 0 ? 2.0F : 0.0F);
  for (int i = 0; i < 18; ++i) file.put(static_cast<float>(i));
  return file.text;
}

TEST(Trajectory, trr_has_velocities_and_forces) {
  const ScratchTrajectory file(trr_with_velocities());
  const Result<TrajectoryFrame> frame = opened(file.path())->read(0);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->x, (std::vector<double>{0, 30}));
  ASSERT_EQ(frame->numbers.size(), 6u);
  EXPECT_EQ(frame->numbers[1].name, "vy");
  EXPECT_EQ(frame->numbers[1].values, (std::vector<double>{7, 10}));
  EXPECT_EQ(frame->numbers[5].name, "fz");
  EXPECT_EQ(frame->numbers[5].values, (std::vector<double>{14, 17}));
}

// Velocities of the atoms' file belong to its own time.
TEST(Trajectory, velocities_are_those_of_the_frame) {
  const ScratchTrajectory atoms(
      "two\n2\n"
      "    1SOL     OW    1   1.000   2.000   3.000  0.1000  0.2000  0.3000\n"
      "    1SOL    HW1    2   1.500   2.500   3.500  0.4000  0.5000  0.6000\n"
      "   5.00000   5.00000   5.00000\n",
      ".gro");
  const auto has_rule = [](const SphereFile& file, const std::string& rule) {
    return std::find(file.rules.begin(), file.rules.end(), rule) != file.rules.end();
  };
  ReadOptions options;
  EXPECT_NEAR(test::numbers_of(*read_spheres(atoms.path(), options), "vx")[0], 0.1, 1e-12);
  {
    const ScratchTrajectory trr(trr_with_velocities());
    options.trajectory = trr.path();
    const Result<SphereFile> file = read_spheres(atoms.path(), options);
    ASSERT_TRUE(file.ok()) << file.error().to_string();
    EXPECT_EQ(test::numbers_of(*file, "vx"), (std::vector<double>{6, 9}));
    EXPECT_EQ(test::numbers_of(*file, "fx"), (std::vector<double>{12, 15}));
    EXPECT_TRUE(has_rule(*file, "numbers of the trajectory's frame: vx vy vz fx fy fz"));
  }
  // The same frame without velocities: XTC keeps so few atoms as they are.
  Bytes xtc(true);
  xtc.put(1995).put(2).put(7).put(1.5F);
  for (int i = 0; i < 9; ++i) xtc.put(0.0F);
  xtc.put(2).put_all(std::vector<float>{1, 2, 3, 4, 5, 6});
  const ScratchTrajectory moved(xtc.text);
  options.trajectory = moved.path();
  const Result<SphereFile> file = read_spheres(atoms.path(), options);
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_TRUE(test::numbers_of(*file, "vx").empty());
  EXPECT_FALSE(test::numbers_of(*file, "resid").empty());
  EXPECT_TRUE(has_rule(*file, "numbers of the atoms' file that change with time are left out: vx vy vz"));
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

  options.frame = -1;
  EXPECT_EQ(*read_spheres(data("water.gro"), options)->time_ps, 4);
  options.frame = -4;
  EXPECT_NE(read_spheres(data("water.gro"), options).error().to_string().find("there is no frame -4"),
            std::string::npos);
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
