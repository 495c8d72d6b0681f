// Rays that are sorted first get the reference traversal's answers on every target, each at its own place; and the
// engine recognises scattered rays.
// ctest: kernel
#include "bihive/wide/schedule/cell_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bihive/simd/target.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/schedule/reordered_batch.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/trace/lists.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/query_rays.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

using test::World;

// Sorted, and answered so many at a time. Nothing is written beyond the last.
void check_sorted(const std::string& what, const test::WideUnderTest& tested, const RaySpan& rays,
                  std::int64_t at_a_time, const std::vector<Hit>& truths) {
  const auto n = static_cast<std::size_t>(rays.count);
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    HitBatch hits;
    hits.t.assign(n + 1, -12345.5);
    hits.sphere_id.assign(n + 1, -77);
    std::vector<std::uint8_t> hidden(n + 1, 77);
    wide::CellOrder by_cell;
    wide::ReorderedBatch batch;
    by_cell.find(tested.tree(), rays, batch.order());
    batch.gather(rays);
    for (std::int64_t first = 0; first < rays.count; first += at_a_time) {
      const RaySpan some = batch.rays().part(first, std::min(at_a_time, rays.count - first));
      wide::closest_hits_by_lists(tested.tree(), some, batch.hits(some.count));
      wide::occluded_by_lists(tested.tree(), some, batch.hidden(some.count));
      batch.put_back(first, some.count, hits.span());
      batch.put_back(first, some.count, hidden.data());
    }
    ASSERT_TRUE(hits.t[n] == -12345.5 && hits.sphere_id[n] == -77 && hidden[n] == 77) << what << ", " << target;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = static_cast<std::int64_t>(i);
      const auto where = [&] {
        return what + ", " + target + ", ray " + std::to_string(i) + ": " + test::text_of(rays.at(number));
      };
      ASSERT_TRUE(test::same_bits(hits.at(number), truths[i])) << where();
      ASSERT_EQ(int{hidden[i]}, truths[i].found() ? 1 : 0) << where();
    }
  }
  ASSERT_TRUE(use_target("").ok());
}

std::vector<Hit> truths_of(const test::WideUnderTest& tested, const RaySpan& rays) {
  std::vector<Hit> truths;
  for (std::int64_t i = 0; i < rays.count; ++i) truths.push_back(tested.truth(rays.at(i)));
  return truths;
}

TEST(CellOrder, AreAnsweredAsByTheReference) {
  std::vector<World> worlds = test::degenerate_worlds();
  for (World& world : test::hostile_worlds(2000, 1000)) worlds.push_back(std::move(world));
  const World base = test::random_world("base", 71, 700, 10, 0.1, 1.5);
  for (const double factor : {1e-30, 1e-20, 1e20, 1e30})
    worlds.push_back(base.scaled(factor, "scaled by " + std::to_string(std::log10(factor))));
  int number = 0;
  for (const World& world : worlds) {
    if (world.size() == 0 || !test::takes_set(number++)) continue;
    const test::WideUnderTest tested(world);
    test::QueryRays maker(world, 72, [&](const Ray& ray) { return tested.truth(ray); });
    RayBatch rays;
    const int count = test::ray_share() > 1 ? 401 : 1501;
    for (int i = 0; i < count; ++i) rays.push_back(maker.next());
    const std::vector<Hit> truths = truths_of(tested, rays.span());
    for (const std::int64_t at_a_time : {rays.size() / 3, rays.size()})
      check_sorted(world.name, tested, rays.span(), at_a_time, truths);
    // Only origins and directions; then some of the other arrays.
    for (const bool segments : {false, true}) {
      RaySpan some = rays.span();
      some.leaves = nullptr;
      some.inside = nullptr;
      if (!segments) some.t_min = some.t_max = nullptr;
      check_sorted(world.name + ", fewer arrays", tested, some, rays.size(), truths_of(tested, some));
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Enough rays for several cells in each octant. Flat, tiny and huge sets: the cells have no size along an axis, or
// places on the grid leave the range of binary32.
TEST(CellOrder, AreSortedIntoCells) {
  const int count = test::ray_share() > 1 ? 5003 : 20011;  // two cells along each axis, or four
  const World base = test::random_world("base", 81, 700, 10, 0.1, 1.5);
  World flat = base;
  flat.name = "flat";
  for (std::size_t i = 0; i < flat.size(); ++i) flat.y[i] = 3;
  World points = base;
  points.name = "flat points";
  for (std::size_t i = 0; i < points.size(); ++i) points.z[i] = points.r[i] = 0;
  World one;
  one.name = "one point";
  one.add(1, 2, 3, 0);
  std::vector<World> worlds{base, flat, points, one, points.scaled(1e-25, "tiny flat points")};
  for (const double factor : {1e-30, 1e-20, 1e20, 1e30})
    worlds.push_back(base.scaled(factor, "scaled by " + std::to_string(std::log10(factor))));
  int number = 0;
  for (const World& world : worlds) {
    if (!test::takes_set(number++)) continue;
    const test::WideUnderTest tested(world);
    test::QueryRays maker(world, 82, [&](const Ray& ray) { return tested.truth(ray); });
    RayBatch rays;
    for (int i = 0; i < count; ++i) rays.push_back(maker.next());
    check_sorted(world.name, tested, rays.span(), rays.size(), truths_of(tested, rays.span()));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(CellOrder, OfAnEmptySetHitNothing) {
  const test::WideUnderTest tested(World{});
  const World somewhere = test::random_world("somewhere", 73, 10, 1, 1, 1);
  test::QueryRays maker(somewhere, 74, [](const Ray&) { return Hit{}; });
  RayBatch rays;
  for (int i = 0; i < 100; ++i) rays.push_back(maker.next());
  check_sorted("empty", tested, rays.span(), 40, std::vector<Hit>(100));
}

// `count` rays in any directions: from anywhere among the spheres, or each from close to the start of the ray before.
RayBatch rays_in_a_cube(double half, std::int64_t count, bool close, std::uint64_t seed) {
  SplitMix64 rng(seed);
  RayBatch rays;
  rays.resize(count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double at = close ? std::sin(double(i) * 1e-3 * (axis + 1)) : test::uniform(rng, -1, 1);
      rays.origin[axis][i] = static_cast<float>(half * at);
      rays.direction[axis][i] = static_cast<float>(test::uniform(rng, -1, 1));
    }
  return rays;
}

TEST(CellOrder, AreKnownAsSuch) {
  const test::WideUnderTest large(test::random_world("large", 75, 70000, 50, 0.3, 0.3));
  const test::WideUnderTest small(test::random_world("small", 76, 4000, 50, 1, 1));
  RayBatch rays = rays_in_a_cube(50, 70000, false, 77);
  EXPECT_TRUE(wide::scattered(large.tree(), rays.span()));
  EXPECT_FALSE(wide::scattered(small.tree(), rays.span()));                // the whole tree is in the cache anyway
  EXPECT_FALSE(wide::scattered(large.tree(), rays.span().part(0, 5000)));  // too few
  EXPECT_FALSE(wide::scattered(large.tree(), {}));
  EXPECT_FALSE(wide::scattered(large.tree(), rays_in_a_cube(50, 70000, true, 78).span()));

  // Origins that are not numbers are not far from anything.
  std::fill(rays.origin[1].begin(), rays.origin[1].end(), std::numeric_limits<float>::quiet_NaN());
  std::fill(rays.origin[0].begin(), rays.origin[0].end(), 0.0F);
  std::fill(rays.origin[2].begin(), rays.origin[2].end(), 0.0F);
  EXPECT_FALSE(wide::scattered(large.tree(), rays.span()));
}

// As a caller asks: more rays than a list holds. The engine must sort them by itself.
TEST(CellOrder, AreSortedForTheCaller) {
  const test::WideUnderTest tested(test::random_world("large", 79, 70000, 50, 0.3, 0.3));
  // More than are sorted at a time; where programs are slow, one go must do.
  const std::int64_t count = test::ray_share() > 1 ? 70003 : wide::kScatteredAtATime + 70003;
  const RayBatch batch = rays_in_a_cube(50, count, false, 80);
  const RaySpan rays = batch.span();
  ASSERT_TRUE(wide::scattered(tested.tree(), rays));
  HitBatch plain, sorted;
  plain.resize(rays.count);
  sorted.resize(rays.count);
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.count), 77);
  wide::closest_hits_by_lists(tested.tree(), rays, plain.span());
  closest_hits(tested.tree(), rays, RayOrder::any, sorted.span());
  occluded(tested.tree(), rays, RayOrder::any, hidden.data());
  std::int64_t found = 0;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    ASSERT_TRUE(test::same_bits(sorted.at(i), plain.at(i))) << i;
    ASSERT_EQ(int{hidden[static_cast<std::size_t>(i)]}, plain.at(i).found() ? 1 : 0) << i;
    found += plain.at(i).found() ? 1 : 0;
  }
  EXPECT_GT(found, rays.count / 10);
  EXPECT_LT(found, rays.count);
}

}  // namespace
}  // namespace bihive
