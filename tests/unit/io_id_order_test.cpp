// Rows that say by an id which sphere they are: an unsorted file is the sorted one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/chunk_of_file.h"
#include "bihive/io/frames.h"
#include "bihive/io/trajectory.h"
#include "bihive/spread/ranks_in_process.h"
#include "bihive/spread/read_chunk.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::numbers_of;
using test::read_text;

const std::string kByIdRule = "order: by id, as the rows of the file are in another order";

std::string dump(const std::string& columns, const std::vector<std::string>& rows) {
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(rows.size()) +
                     "\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10\nITEM: ATOMS " + columns + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

std::string data_file(const std::vector<std::string>& rows, const std::string& labels = "") {
  std::string text = "x\n\n" + std::to_string(rows.size()) +
                     " atoms\n3 atom types\n\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\n" + labels +
                     "Atoms # atomic\n\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

// All that is known of the spheres, but for the rule that tells of the order.
void expect_same(const SphereFile& read, const SphereFile& sorted) {
  ASSERT_EQ(read.spheres.size(), sorted.spheres.size());
  EXPECT_EQ(read.spheres.x(), sorted.spheres.x());
  EXPECT_EQ(read.spheres.y(), sorted.spheres.y());
  EXPECT_EQ(read.spheres.z(), sorted.spheres.z());
  EXPECT_EQ(read.spheres.r(), sorted.spheres.r());
  const SphereAttributes &a = read.spheres.attributes(), &b = sorted.spheres.attributes();
  EXPECT_EQ(a.element, b.element);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.colour, b.colour);
  EXPECT_EQ(a.opacity, b.opacity);
  ASSERT_EQ(a.numbers.size(), b.numbers.size());
  for (std::size_t i = 0; i < a.numbers.size(); ++i) EXPECT_EQ(a.numbers[i].values, b.numbers[i].values);
  ASSERT_EQ(a.texts.size(), b.texts.size());
  for (std::size_t i = 0; i < a.texts.size(); ++i) {
    EXPECT_EQ(a.texts[i].texts, b.texts[i].texts);
    EXPECT_EQ(a.texts[i].text_of_sphere, b.texts[i].text_of_sphere);
  }
  EXPECT_EQ(read.warnings, sorted.warnings);
  std::vector<std::string> rules = read.rules;
  EXPECT_EQ(std::erase(rules, kByIdRule), 1u);
  EXPECT_EQ(rules, sorted.rules);
}

class Scratch {
 public:
  Scratch(const std::string& bytes, const std::string& ending)
      : path_(::testing::TempDir() + "bihive_id_order_test." + std::to_string(getpid()) + ending) {
    EXPECT_TRUE(write_file(path_, bytes).ok());
  }
  ~Scratch() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(IdOrder, AnUnsortedDumpIsTheSortedOne) {
  const std::vector<std::string> rows = {"1 Cat 1 2 3 0.5 1 0 0 0.5 a -1", "2 dog 2 3 4 0.6 0 1 0 1.0 b -2",
                                         "4 Cat 3 4 5 0.7 0 0 1 0.5 a -3", "9 ant 4 5 6 0.8 1 1 0 0.25 c -4",
                                         "11 dog 5 6 7 0.9 0 1 1 0.5 b -5"};
  const std::string columns = "id type x y z radius red green blue opacity name q";
  const SphereFile sorted = read_text(dump(columns, rows), "d.dump");
  EXPECT_EQ(std::count(sorted.rules.begin(), sorted.rules.end(), kByIdRule), 0);
  EXPECT_EQ(numbers_of(sorted, "id"), (std::vector<double>{1, 2, 4, 9, 11}));
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{4, 3, 2, 1, 0}, {1, 0, 2, 3, 4}, {3, 4, 0, 2, 1}}) {
    std::vector<std::string> shuffled;
    for (const std::size_t row : order) shuffled.push_back(rows[row]);
    expect_same(read_text(dump(columns, shuffled), "d.dump"), sorted);
  }
}

TEST(IdOrder, ScaledCoordinatesAndElementsFollow) {
  const std::string columns = "element xs ys zs ID";
  const std::vector<std::string> rows = {"Xx 0.1 0.2 0.3 5", "O 0.4 0.5 0.6 7", "H 0.7 0.8 0.9 8"};
  expect_same(read_text(dump(columns, {rows[2], rows[0], rows[1]}), "d"), read_text(dump(columns, rows), "d"));
}

// Ids differ from frame to frame where atoms are lost and added.
TEST(IdOrder, EachFrameOfAFileOnTheDiskIsInOrder) {
  const std::string text = dump("id x y z", {"3 3 0 0", "1 1 0 0", "2 2 0 0"}) +
                           dump("id x y z", {"2 2 0 0", "1 1 0 0", "3 3 0 0"}) +
                           dump("id x y z", {"8 8 0 0", "2 2 0 0"}) + dump("id x y z", {"4 4 0 0", "4 5 0 0"});
  const Scratch file(text, ".dump");
  const Result<std::shared_ptr<const Frames>> frames = open_frames(file.path(), {});
  ASSERT_TRUE(frames.ok());
  const std::vector<double> ids[] = {{1, 2, 3}, {1, 2, 3}, {2, 8}, {4, 4}};
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    const Result<SphereFile> read = (*frames)->read(frame);
    ASSERT_TRUE(read.ok()) << read.error().to_string();
    EXPECT_EQ(numbers_of(*read, "id"), ids[frame]);
    for (std::int64_t id = 0; frame < 3 && id < read->spheres.size(); ++id)
      EXPECT_EQ(read->spheres.centre(id).x, ids[frame][static_cast<std::size_t>(id)]);
  }
  // The lines are those of the file, also where a frame is read by its place.
  EXPECT_EQ((*frames)->read(3)->warnings.front(),
            file.path() +
                ":46: the id 4 stands in line 45 too, so ids do not say which sphere is which, and the order "
                "of the file is kept");
}

TEST(IdOrder, RepeatedIdsAreToldAndKeepTheOrder) {
  const SphereFile file =
      read_text(dump("id x y z radius", {"7 1 0 0 1", "5 2 0 0 1", "6 3 0 0 1", "5 4 0 0 1", "7 5 0 0 1"}), "d");
  EXPECT_EQ(numbers_of(file, "id"), (std::vector<double>{7, 5, 6, 5, 7}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0],
            "d:13: the id 5 stands in line 11 too, so ids do not say which sphere is which, and the order of the file "
            "is kept");
  // Of LAMMPS data, rows: there may be lines without an atom between.
  EXPECT_EQ(
      read_text(data_file({"2 1 0 0 0", "", "1 1 3 0 0", "2 1 6 0 0"}).replace(3, 1, "3"), "a").warnings.front(),
      "a: row 2 (from 0): the id 2 stands in row 0 (from 0) too, so ids do not say which sphere is which, and the "
      "order of the file is kept");
}

TEST(IdOrder, IdsThatAreNoNumbersSayNothing) {
  for (const char* const id : {"nan", "inf", "b"}) {
    const SphereFile file =
        read_text(dump("x y z radius id", {"1 0 0 1 " + std::string(id), "2 0 0 1 9", "3 0 0 1 4"}), "d");
    EXPECT_EQ(file.spheres.centre(2).x, 3) << id;
    EXPECT_TRUE(file.warnings.empty()) << id;
    EXPECT_EQ(std::count(file.rules.begin(), file.rules.end(), kByIdRule), 0) << id;
  }
  EXPECT_EQ(read_text(dump("x y z radius id", {}) + dump("x y z radius", {"1 0 0 1"}), "d", at_frame(1)).spheres.size(),
            1);
}

TEST(IdOrder, ExtendedXyzAndLammpsDataFollowIds) {
  const auto xyz = [](const std::string& rows) { return "3\nProperties=species:S:1:pos:R:3:id:I:1\n" + rows; };
  expect_same(read_text(xyz("H 3 0 0 3\nO 1 0 0 1\nC 2 0 0 2\n"), "a.xyz"),
              read_text(xyz("O 1 0 0 1\nC 2 0 0 2\nH 3 0 0 3\n"), "a.xyz"));
  const std::string labels = "Atom Type Labels\n\n1 A\n2 B\n3 C\n\n";
  for (const std::string& with : {std::string(), labels}) {
    const bool labelled = !with.empty();
    const std::string first = labelled ? "1 B 1 0 0" : "1 2 1 0 0", second = labelled ? "2 A 2 0 0" : "2 1 2 0 0",
                      third = labelled ? "3 B 3 0 0" : "3 2 3 0 0";
    const SphereFile sorted = read_text(data_file({first, second, third}, with), "a");
    EXPECT_EQ(sorted.spheres.attributes().type, (std::vector<std::int32_t>{2, 1, 2}));
    expect_same(read_text(data_file({third, second, first}, with), "a"), sorted);
  }
}

// Beads of a chain follow each other by id, not as the processors of a simulation held them.
TEST(IdOrder, ChainsAreUnwrappedById) {
  std::vector<std::string> rows;
  for (const int id : {4, 18, 1, 10, 13, 6, 20, 2, 9, 15, 7, 3, 12, 17, 5, 11, 19, 8, 14, 16})
    rows.push_back(std::to_string(id) + " 1 " + std::to_string((id - 1) % 10) + ".5 5 5 0.5");
  ReadOptions options;
  options.wrapping = Wrapping::unwrap;
  const SphereFile file = read_text(dump("id mol x y z radius", rows), "d", options);
  ASSERT_EQ(file.spheres.size(), 20);
  for (std::int64_t id = 1; id < 20; ++id)
    EXPECT_EQ(file.spheres.centre(id).x - file.spheres.centre(id - 1).x, 1) << id;
}

// A table is what its rows are: nothing moves from frame to frame, and other programs count its rows.
TEST(IdOrder, TablesKeepTheirRows) {
  EXPECT_EQ(read_text("id,x,y,z,r\n3,3,0,0,1\n1,1,0,0,1\n", "a.csv").spheres.centre(0).x, 3);
}

// LAMMPS writes trajectories without ids in the order of ids.
TEST(IdOrder, ATrajectoryLiesOverAtomsInOrder) {
  const std::string folder = std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/trajectories/";
  const Result<std::shared_ptr<const Trajectory>> trajectory = open_trajectory(folder + "water.dcd");
  ASSERT_TRUE(trajectory.ok());
  const std::int64_t count = (*trajectory)->sphere_count();
  std::vector<std::string> rows;
  for (std::int64_t i = 0; i < count; ++i)
    rows.push_back(std::to_string(i + 1) + " " + std::to_string(i % 3 + 1) + " 0 " + std::to_string(i) + " 0");
  ReadOptions options;
  options.trajectory = folder + "water.dcd";
  options.radius = 1;
  const SphereFile sorted = read_text(data_file(rows), "a", options);
  std::reverse(rows.begin(), rows.end());
  expect_same(read_text(data_file(rows), "a", options), sorted);
}

// NetCDF of LAMMPS, whose ids stand beside the places: those of a trajectory too.
TEST(IdOrder, NetcdfFollowsIds) {
  std::ifstream file(std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/lammps.nc", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_EQ(from.size(), to.size());
    std::size_t found = 0;
    for (std::size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + from.size()), ++found)
      bytes.replace(at, from.size(), to);
    EXPECT_GT(found, 0u);
  };
  // The variable `type` becomes `id`, and its numbers 1, 2, 2 become 3, 1, 2.
  using namespace std::string_literals;
  replace("\0\0\0\4type"s, "\0\0\0\2id\0\0"s);
  replace("\0\0\0\1\0\0\0\2\0\0\0\2"s, "\0\0\0\3\0\0\0\1\0\0\0\2"s);
  const SphereFile read = read_text(bytes, "a.nc", at_frame(1));
  EXPECT_EQ(numbers_of(read, "id"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(read.spheres.centre(0), (Vec3d{4, 5.5, 6}));
  EXPECT_EQ(read.spheres.centre(2), (Vec3d{1.5, 2, 3}));
  EXPECT_EQ(numbers_of(read, "c_stress_2"), (std::vector<double>{55, 80, 20}));
  const Scratch scratch(bytes, ".nc");
  const Result<std::shared_ptr<const Trajectory>> trajectory = open_trajectory(scratch.path());
  ASSERT_TRUE(trajectory.ok()) << trajectory.error().to_string();
  EXPECT_EQ((*trajectory)->read(1)->y, (std::vector<double>{5.5, 8, 2}));
}

// Chunks of rows are not chunks of a set in the order of its ids.
TEST(IdOrder, ChunksOfAnUnsortedDumpAreRefused) {
  std::vector<std::string> rows;
  for (int i = 0; i < 66000; ++i)
    rows.push_back(std::to_string(i) + " " + std::to_string(i % 40) + " " + std::to_string(i / 40) + " 0 1");
  const auto outcome = [&] {
    const Scratch file(dump("id x y z radius", rows), ".dump");
    if (!can_read_chunks(file.path())) return std::string("read as a whole");
    std::string message;
    on_ranks_in_process(3, [&](Communicator& ranks) {
      const Result<ReadChunk> chunk = read_chunk(file.path(), {}, ranks);
      if (ranks.rank() == 0 && !chunk) message = chunk.error().message;
    });
    return message;
  };
  const std::string refused = "chunks of this file can be read only if its rows are in the order of their ids";
  EXPECT_EQ(outcome(), "");
  // Within a chunk, behind the first rows; then between chunks.
  std::swap(rows[30000], rows[30001]);
  EXPECT_EQ(outcome(), refused);
  std::swap(rows[30000], rows[30001]);
  std::swap_ranges(rows.begin() + 22000, rows.begin() + 44000, rows.begin() + 44000);
  EXPECT_EQ(outcome(), refused);
  // The first rows show it.
  std::swap(rows[0], rows[1]);
  EXPECT_EQ(outcome(), "read as a whole");
}

}  // namespace
}  // namespace bihive
