// A set that ranks read in chunks: its spheres, and what is true of the whole set, are those of one process.
#include "bihive/spread/read_chunk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

#include "bihive/io/read_spheres.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/load_scene.h"
#include "bihive/spread/ranks_in_process.h"
#include "support/npy_file.h"

namespace bihive {
namespace {

// `columns` 3: x, y, z; 4: with the radius.
std::vector<double> spiral(int count, int columns) {
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.37 * i;
    const std::vector<double> row{100 + i * std::cos(angle), 0.1 * i * i, -i * std::sin(angle), 0.25 + 0.01 * i};
    numbers.insert(numbers.end(), row.begin(), row.begin() + columns);
  }
  return numbers;
}

class ReadChunkTest : public ::testing::Test {
 protected:
  ~ReadChunkTest() override { std::remove(path_.c_str()); }
  std::string write_rows(const std::vector<double>& numbers, int columns) {
    EXPECT_TRUE(test::write_npy(path_, "<f8", numbers, static_cast<std::size_t>(columns)));
    return path_;
  }
  std::string write_spiral(int count, int columns) { return write_rows(spiral(count, columns), columns); }

 private:
  std::string path_ = ::testing::TempDir() + "read_chunk_test_" + std::to_string(getpid()) + ".npy";
};

void expect_equal(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.look_at, b.look_at);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.shorter_side, b.shorter_side);
}

TEST_F(ReadChunkTest, ChunksTogetherAreTheWholeSet) {
  for (const int columns : {3, 4})
    for (const bool recenter : {false, true}) {
      const std::string path = write_spiral(50, columns);
      ReadOptions options;
      options.recenter = recenter;
      const SphereFile expected = read_spheres(path, options).value();
      const SphereSet::Bounds bounds = expected.spheres.bounds();
      for (const int count : {1, 3, 7, 60}) {
        std::vector<ReadChunk> chunks(static_cast<std::size_t>(count));
        on_ranks_in_process(count, [&](Communicator& ranks) {
          chunks[static_cast<std::size_t>(ranks.rank())] = read_chunk(path, options, ranks).value();
        });
        std::vector<float> x, r;
        for (const ReadChunk& chunk : chunks) {
          const SphereSet& spheres = chunk.file.spheres;
          x.insert(x.end(), spheres.x().begin(), spheres.x().end());
          r.insert(r.end(), spheres.r().begin(), spheres.r().end());
          EXPECT_EQ(spheres.scale_exponent(), expected.spheres.scale_exponent());
          EXPECT_EQ(chunk.whole_count, 50);
          EXPECT_EQ(chunk.whole_bounds.lo, bounds.lo);
          EXPECT_EQ(chunk.whole_bounds.hi, bounds.hi);
          EXPECT_EQ(chunk.file.rules, expected.rules);
          EXPECT_EQ(chunk.file.warnings, expected.warnings);
        }
        EXPECT_EQ(x, expected.spheres.x());
        EXPECT_EQ(r, expected.spheres.r());
      }
    }
}

// Far from 0 the chunks have the origin of the whole set, which may lie in none of them.
TEST_F(ReadChunkTest, ChunksHaveTheOriginOfTheWholeSet) {
  std::vector<double> rows = spiral(50, 4);
  for (std::size_t i = 0; i < rows.size(); i += 4) rows[i + 1] += 5400000;
  const std::string path = write_rows(rows, 4);
  const SphereFile expected = read_spheres(path, {}).value();
  ASSERT_TRUE(expected.spheres.has_origin());
  for (const int count : {1, 3, 60}) {
    std::vector<ReadChunk> chunks(static_cast<std::size_t>(count));
    on_ranks_in_process(count, [&](Communicator& ranks) {
      chunks[static_cast<std::size_t>(ranks.rank())] = read_chunk(path, {}, ranks).value();
    });
    std::vector<float> y;
    for (const ReadChunk& chunk : chunks) {
      const SphereSet& spheres = chunk.file.spheres;
      y.insert(y.end(), spheres.y().begin(), spheres.y().end());
      EXPECT_EQ(spheres.origin(), expected.spheres.origin());
      EXPECT_EQ(spheres.scale_exponent(), expected.spheres.scale_exponent());
      EXPECT_EQ(chunk.whole_bounds.lo, expected.spheres.bounds().lo);
    }
    EXPECT_EQ(y, expected.spheres.y());
  }
}

// A rank may ask its set alone, at any time.
TEST_F(ReadChunkTest, GettersOfAChunkAskNobody) {
  const std::string path = write_spiral(50, 4);
  SphereSet::Bounds own{}, whole{};
  on_ranks_in_process(3, [&](Communicator& ranks) {
    const ReadChunk chunk = read_chunk(path, {}, ranks).value();
    if (ranks.rank() != 1) return;
    own = chunk.file.spheres.bounds();
    whole = chunk.whole_bounds;
  });
  EXPECT_LT(whole.lo.x, own.lo.x);
  EXPECT_GT(whole.hi.y, own.hi.y);
}

TEST_F(ReadChunkTest, CameraAndColoursAreThoseOfTheWholeSet) {
  const std::string path = write_spiral(200, 4);
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const ViewFrom from : {ViewFrom::front, ViewFrom::iso}) {
      RenderSettings settings;
      settings.width_px = 300;
      settings.height_px = 200;
      settings.labels.axes = true;
      settings.labels.title = "a title";
      const Scene whole = scene_of_spheres(read_spheres(path, {}).value(), path).scene;
      const Camera expected = frame_picture(whole, side_of(from), {30, projection}, settings);
      ColourBy how;
      how.attribute = "x";
      const auto range = number_range(whole.spheres, how);
      on_ranks_in_process(5, [&](Communicator& ranks) {
        ReadChunk chunk = read_chunk(path, {}, ranks).value();
        ColourBy taken = how;
        take_whole_range(chunk.file.spheres, taken, ranks);
        const Scene scene = scene_of_spheres(std::move(chunk.file), path).scene;
        const Camera camera =
            frame_whole_picture(scene, chunk.whole_bounds, side_of(from), {30, projection}, settings, ranks);
        static std::mutex one_at_a_time;
        const std::lock_guard lock(one_at_a_time);
        expect_equal(camera, expected);
        EXPECT_EQ(taken.range, range);
      });
    }
}

}  // namespace
}  // namespace bihive
