// Structures over boxes find the boxes of brute force: for rays along edges and faces, points on them, and boxes
// without volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/compare/box_queries.h"
#include "bihive/math/rng.h"
#include "support/effort.h"
#include "support/query_rays.h"

namespace bihive {
namespace {

using workbench::Box;
using workbench::BoxStructureRow;

struct BoxWorld {
  std::string name;
  std::vector<Box> boxes;
};

// Log-uniform sizes; a third of the coordinates lies on a grid, so that faces coincide.
BoxWorld random_boxes(const std::string& name, std::uint64_t seed, int count, double half, double away) {
  SplitMix64 rng(seed);
  BoxWorld world{name, {}};
  for (int i = 0; i < count; ++i) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      double lo = half * test::uniform(rng, -1, 1), size = half * test::log_uniform(rng, 1e-6, 1);
      if (rng.next_below(3) == 0) lo = half * std::round(4 * lo / half) / 4, size = half / 4;
      if (rng.next_below(6) == 0) size = 0;
      box.lo[axis] = away + lo;
      box.hi[axis] = away + (lo + size);
    }
    world.boxes.push_back(box);
  }
  return world;
}

std::vector<BoxWorld> hostile_boxes() {
  std::vector<BoxWorld> worlds;
  worlds.push_back({"one", {{{1, 2, 3}, {2, 4, 6}}}});
  worlds.push_back({"a point at 0", {{{0, 0, 0}, {0, 0, 0}}}});
  worlds.push_back({"equal ones", std::vector<Box>(300, Box{{-1, 0, 1}, {0, 2, 3}})});
  worlds.push_back(random_boxes("random", 1, 900, 1, 0));
  worlds.push_back(random_boxes("far away", 2, 500, 1, 1e7));
  worlds.push_back(random_boxes("tiny", 3, 500, 1e-20, 0));
  worlds.push_back(random_boxes("huge", 4, 500, 1e30, 0));
  BoxWorld nested{"nested", {}};
  for (int i = 0; i < 120; ++i) {
    const double size = std::ldexp(1.0, -i / 2);
    nested.boxes.push_back({{-size, -size, -size}, {size, size, size}});
  }
  worlds.push_back(nested);
  BoxWorld grid{"cells that touch", {}};
  for (int i = 0; i < 512; ++i) {
    const Vec3d lo{double(i % 8), double(i / 8 % 8), double(i / 64)};
    grid.boxes.push_back({lo, lo + Vec3d{1, 1, 1}});
  }
  worlds.push_back(grid);
  return worlds;
}

// A coordinate of a box or between its faces, or one anywhere.
double coordinate(SplitMix64& rng, const std::vector<Box>& boxes, int axis) {
  const Box& box = boxes[static_cast<std::size_t>(rng.next_below(boxes.size()))];
  const std::uint64_t kind = rng.next_below(4);
  if (kind == 0) return box.lo[axis];
  if (kind == 1) return box.hi[axis];
  const Box& other = boxes[static_cast<std::size_t>(rng.next_below(boxes.size()))];
  const double t = rng.next_double();
  return kind == 2 ? box.lo[axis] + t * (box.hi[axis] - box.lo[axis])
                   : box.lo[axis] + t * (other.hi[axis] - box.lo[axis]);
}

TEST(BoxStructures, EqualBruteForce) {
  std::int64_t met = 0, inside = 0;
  for (const BoxWorld& world : hostile_boxes()) {
    SCOPED_TRACE(world.name);
    for (const BoxStructureRow& row : workbench::box_structures()) {
      SCOPED_TRACE(row.name);
      const auto structure = std::move(*row.build(world.boxes));
      SplitMix64 rng(7);
      std::vector<std::int64_t> found, expected;
      workbench::Work work;
      for (std::int64_t i = 0; i < 1500 / test::ray_share(); ++i) {
        Vec3d from, to;
        for (int axis = 0; axis < 3; ++axis) {
          from[axis] = coordinate(rng, world.boxes, axis);
          // A third of the directions has a component of 0: along faces.
          to[axis] = rng.next_below(3) == 0 ? from[axis] : coordinate(rng, world.boxes, axis);
        }
        Ray ray;
        ray.origin = to_float(from);
        ray.direction = to_float(to - from);
        ray.t_min = rng.next_below(2) == 0 ? 0 : -2;
        if (rng.next_below(3) == 0) ray.t_max = 1;
        if (!is_valid(ray)) ray.direction = {0, 0, 1};
        expected.clear();
        for (std::size_t k = 0; k < world.boxes.size(); ++k)
          if (meets(world.boxes[k], ray)) expected.push_back(static_cast<std::int64_t>(k));
        structure->boxes_of_ray(ray, found, work);
        ASSERT_EQ(found, expected) << "ray " << i;
        met += std::ssize(found);
        expected.clear();
        for (std::size_t k = 0; k < world.boxes.size(); ++k)
          if (contains(world.boxes[k], from)) expected.push_back(static_cast<std::int64_t>(k));
        structure->boxes_of_point(from, found, work);
        ASSERT_EQ(found, expected) << "point " << i;
        inside += std::ssize(found);
      }
      EXPECT_GT(work.sphere_tests, 0);
    }
  }
  EXPECT_GT(met, 10000);
  EXPECT_GT(inside, 1000);
}

TEST(BoxStructures, MeetClosedBoxes) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  const auto meets_from = [&](Vec3f origin, Vec3f direction, double t_min, double t_max) {
    Ray ray;
    ray.origin = origin, ray.direction = direction, ray.t_min = t_min, ray.t_max = t_max;
    return meets(box, ray);
  };
  EXPECT_TRUE(meets_from({-1, 1, 1}, {1, 0, 0}, 0, 1));       // ends on the face
  EXPECT_FALSE(meets_from({-1, 1, 1}, {1, 0, 0}, 0, 0.999));  // before it
  EXPECT_TRUE(meets_from({-1, 2, 3}, {1, 0, 0}, 0, 9));       // along an edge
  EXPECT_FALSE(meets_from({-1, 2.0001F, 3}, {1, 0, 0}, 0, 9));
  EXPECT_TRUE(meets_from({0.5F, 1, 1}, {0, 1, 0}, 0, 0));  // starts inside
  EXPECT_FALSE(meets_from({2, 1, 1}, {1, 0, 0}, 0, 9));    // behind the origin
  EXPECT_TRUE(contains(box, {1, 2, 3}));
  EXPECT_FALSE(contains(box, {1, 2, 3.0000001}));
}

TEST(BoxStructures, VisitFewNodes) {
  const BoxWorld world = random_boxes("random", 5, 4000, 1, 0);
  const auto results = std::move(*workbench::compare_box_structures(world.boxes, 500));
  ASSERT_EQ(results.size(), 3u);
  for (const workbench::BoxStructureResult& one : results) {
    SCOPED_TRACE(one.row.name);
    EXPECT_EQ(one.rays.different + one.points.different, 0);
    EXPECT_EQ(one.rays.queries, 500);
    const bool brute = std::string(one.row.name) == "brute";
    EXPECT_EQ(one.points.item_tests == 4000, brute);
    EXPECT_EQ(one.points.item_tests < 1000, !brute);
    EXPECT_EQ(one.rays.found, results.back().rays.found);
  }
}

}  // namespace
}  // namespace bihive
