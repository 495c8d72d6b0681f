// Blocks of neighbouring rays get the reference traversal's answers, bit for bit, on every target.
// ctest: kernel
// ctest: share 4
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/rng.h"
#include "bihive/simd/target.h"
#include "bihive/wide/optical_depths.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"
#include "support/block_rays.h"
#include "support/effort.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

const std::int64_t kBlocks = std::max<std::int64_t>(3, 40 / test::ray_share());

// Every step-th sphere `copies` more times, at ids far from its own.
test::World with_copies(test::World world, std::size_t step, int copies) {
  const std::size_t count = world.x.size();
  for (int copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < count; i += step)
      for (std::vector<float>* numbers : {&world.x, &world.y, &world.z, &world.r}) numbers->push_back(numbers->at(i));
  world.name += ", every " + std::to_string(step) + ". " + std::to_string(copies + 1) + " times";
  return world;
}

std::vector<test::World> worlds() {
  std::vector<test::World> all = test::degenerate_worlds();
  for (test::World& world : test::hostile_worlds(2000, 2000)) all.push_back(std::move(world));
  all.push_back(test::random_world("dense", 51, 3000, 5, 0.2, 1.0));
  all.push_back(test::random_world("one radius", 52, 4000, 20, 1, 1));
  // Rays that exit a sphere exit those that coincide with it.
  const test::World some = test::random_world("some radii", 55, 700, 5, 0.2, 1.0);
  for (const auto& [step, copies] : {std::pair<std::size_t, int>{699, 1}, {10, 1}, {2, 2}, {1, 1}, {50, 20}})
    all.push_back(with_copies(some, step, copies));
  return all;
}

struct Expected {
  std::vector<double> t;
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> hidden;
  std::vector<RayHit> all;  // hits, by ray, t and id
};

// Sphere by sphere.
void add_all_hits(const SphereSet& spheres, const Ray& ray, std::int64_t number, std::vector<RayHit>& all) {
  if (!is_valid(ray)) return;
  const ScaledRay scaled(ray, spheres);
  const auto first = static_cast<std::ptrdiff_t>(all.size());
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double t = sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id));
    if (t < std::numeric_limits<double>::infinity()) all.push_back({number, t, id});
  }
  std::stable_sort(all.begin() + first, all.end(), [](const RayHit& a, const RayHit& b) { return a.t < b.t; });
}

Expected by_reference(const SphereSet& spheres, const RaySpan& rays) {
  const Tree tree = build_reference_tree(spheres, {8, kUnlimited});
  Expected expected;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Hit hit = closest_hit(tree, spheres, rays.at(i));
    expected.t.push_back(hit.t);
    expected.id.push_back(hit.sphere_id);
    expected.hidden.push_back(occluded(tree, spheres, rays.at(i)) ? 1 : 0);
    add_all_hits(spheres, rays.at(i), i, expected.all);
  }
  return expected;
}

// Clear, faint and nearly opaque spheres, whose rows stand in another order than their ids.
struct Depths {
  std::vector<OpticalDepth> rows;
  std::vector<std::int64_t> number_of;
  SphereDepths view;

  Depths(std::int64_t spheres, int columns) {
    SplitMix64 rng(static_cast<std::uint64_t>(columns));
    for (std::int64_t i = 0; i < spheres * columns; ++i)
      rows.push_back(static_cast<OpticalDepth>(rng.next_below(kDeepestLayer + 1) >> 2 * rng.next_below(14)));
    for (std::int64_t id = 0; id < spheres; ++id) number_of.push_back(spheres - 1 - id);
    view = {rows.data(), columns, columns == 2 ? number_of.data() : nullptr};
  }
};

// The sums of the hits, which take any order.
void check_depths(const std::string& what, std::int64_t spheres, const WideTree& tree, const RaySpan& rays,
                  const std::vector<RayHit>& hits) {
  static int calls = 0;
  const int columns = 1 + calls++ % 3;
  const Depths depths(spheres, columns);
  const auto n = static_cast<std::size_t>(rays.count);
  std::vector<std::uint64_t> expected(3 * n);
  for (const RayHit& hit : hits)
    for (std::size_t c = 0; c < static_cast<std::size_t>(columns); ++c)
      expected[c * n + static_cast<std::size_t>(hit.ray)] += depths.view.row(hit.sphere_id)[c];
  std::vector<OpticalDepth> found(3 * n, 7);
  optical_depths(tree, rays, depths.view, {{found.data(), found.data() + n, found.data() + 2 * n}});
  for (std::size_t i = 0; i < static_cast<std::size_t>(columns) * n; ++i)
    ASSERT_EQ(found[i], std::min<std::uint64_t>(expected[i], kDeepest))
        << what << ", ray " << i % n << ", column " << i / n << " of " << columns << ": "
        << test::text_of(rays.at(static_cast<std::int64_t>(i % n)));
}

void check(const test::World& world, const std::string& kind, const SphereSet& spheres, const WideTree& tree,
           const RaySpan& rays) {
  const Expected expected = by_reference(spheres, rays);
  const auto n = static_cast<std::size_t>(rays.count);
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    HitBatch hits;
    hits.resize(rays.count);
    std::vector<std::uint8_t> hidden(n, 2);
    closest_hits(tree, rays, RayOrder::blocks, hits.span());
    occluded(tree, rays, RayOrder::blocks, hidden.data());
    for (std::size_t i = 0; i < n; ++i) {
      const Ray ray = rays.at(static_cast<std::int64_t>(i));
      ASSERT_EQ(hits.sphere_id[i], expected.id[i])
          << world.name << ", " << kind << ", " << target << ", ray " << i << ", t " << hits.t[i] << ", not "
          << expected.t[i] << ": " << test::text_of(ray);
      ASSERT_EQ(std::memcmp(&hits.t[i], &expected.t[i], sizeof(double)), 0)
          << world.name << ", " << kind << ", " << target << ", ray " << i << ": " << test::text_of(ray);
      ASSERT_EQ(hidden[i], expected.hidden[i])
          << world.name << ", " << kind << ", " << target << ", ray " << i << ": " << test::text_of(ray);
    }
    std::vector<RayHit> all{{1, 2, 3}};
    all_hits(tree, rays, all);
    ASSERT_EQ(all.size(), expected.all.size()) << world.name << ", " << kind << ", " << target;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Ray ray = rays.at(expected.all[i].ray);
      ASSERT_EQ(all[i].ray, expected.all[i].ray) << world.name << ", " << kind << ", " << target;
      ASSERT_EQ(all[i].sphere_id, expected.all[i].sphere_id)
          << world.name << ", " << kind << ", " << target << ": " << test::text_of(ray);
      ASSERT_EQ(std::memcmp(&all[i].t, &expected.all[i].t, sizeof(double)), 0)
          << world.name << ", " << kind << ", " << target << ": " << test::text_of(ray);
    }
    check_depths(world.name + ", " + kind + ", " + target, spheres.size(), tree, rays, expected.all);
    if (testing::Test::HasFatalFailure()) return;
  }
  ASSERT_TRUE(use_target("").ok());
}

// Rays with origin and direction only, as primary rays are.
void keep_lines_only(RayBatch& rays) {
  rays.t_min.clear();
  rays.t_max.clear();
  rays.leaves.clear();
  rays.inside.clear();
}

// Rays said to exit the spheres that they meet first: they miss those, and all that coincide with them, wherever they
// start.
RayBatch exiting_what_they_meet(const SphereSet& spheres, const RayBatch& lines) {
  const Tree tree = build_reference_tree(spheres, {8, kUnlimited});
  RayBatch rays = lines;
  rays.leaves.clear();
  for (std::int64_t i = 0; i < rays.span().count; ++i)
    rays.leaves.push_back(closest_hit(tree, spheres, lines.span().at(i)).sphere_id);
  return rays;
}

TEST(Beam, EveryBlockIsAnsweredAsByTheReference) {
  std::uint64_t seed = 500;
  int number = 0;
  for (const test::World& world : worlds()) {
    if (world.size() == 0 || !test::takes_set(number++)) continue;
    const SphereSet spheres = test::sphere_set(world);
    WideBuilder builder;
    const auto tree = builder.build(spheres);
    ASSERT_TRUE(tree.ok());
    test::BlockRays maker(world, ++seed);
    RayBatch camera, lines, shadow, parallel, any;
    for (std::int64_t block = 0; block < kBlocks; ++block) {
      maker.add_camera(camera);
      maker.add_camera(lines);
      maker.add_shadow(shadow);
      maker.add_parallel(parallel);
      maker.add_any(any);
    }
    keep_lines_only(lines);
    check(world, "camera", spheres, **tree, camera.span());
    check(world, "lines", spheres, **tree, lines.span());
    check(world, "shadow", spheres, **tree, shadow.span());
    check(world, "parallel", spheres, **tree, parallel.span());
    check(world, "any", spheres, **tree, any.span());
    check(world, "exits", spheres, **tree, exiting_what_they_meet(spheres, lines).span());
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Gives some of the rays segments that end where they begin, lie behind the origin, reach as far as numbers do, or are
// none at all. Most begin or end at a root of the ray's own line.
class HostileSegments {
 public:
  HostileSegments(const SphereSet& spheres, std::uint64_t seed) : spheres_(spheres), rng_(seed) {}

  void give(RayBatch& rays) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rays.t_min.size(); ++i) {
      // Of a block none, some or nearly all.
      if (rng_.next_below(8) >= i / 64 % 4 * 3) continue;
      const double t = some_root(rays.span().at(static_cast<std::int64_t>(i)));
      const double beyond = std::nextafter(t, rng_.next_below(2) == 0 ? kInf : -kInf);
      const double largest = std::numeric_limits<double>::max();
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const double segments[][2] = {{t, t},      {beyond, beyond}, {t, beyond},   {beyond, t},    {-kInf, t},
                                    {t, kInf},   {-kInf, kInf},    {-kInf, -0.0}, {-0.0, t},      {0, -0.0},
                                    {nan, t},    {t, nan},         {kInf, kInf},  {-kInf, -kInf}, {-largest, largest},
                                    {5e-324, t}, {-525.7, -525.7}, {0, beyond}};
      const double* const segment = segments[rng_.next_below(std::size(segments))];
      rays.t_min[i] = segment[0];
      rays.t_max[i] = segment[1];
      if (rng_.next_below(8) == 0) rays.inside[i] ^= 1;
    }
  }

 private:
  const SphereSet& spheres_;
  SplitMix64 rng_;

  double some_root(Ray ray) {
    ray.t_min = -std::numeric_limits<double>::infinity();
    ray.t_max = std::numeric_limits<double>::infinity();
    std::vector<RayHit> all;
    add_all_hits(spheres_, ray, 0, all);
    if (all.empty()) return test::uniform(rng_, -1000, 1000);
    const RayHit hit = all[static_cast<std::size_t>(rng_.next_below(all.size()))];
    const SphereRoots roots = sphere_roots(ScaledRay(ray, spheres_), spheres_.stored_centre(hit.sphere_id),
                                           spheres_.stored_radius(hit.sphere_id));
    return rng_.next_below(2) == 0 ? roots.t_near : roots.t_far;
  }
};

TEST(Beam, SegmentsOfEveryKindAreAnsweredAsByTheReference) {
  std::uint64_t seed = 900;
  int number = 0;
  for (const test::World& world : worlds()) {
    if (world.size() == 0 || !test::takes_set(number++)) continue;
    const SphereSet spheres = test::sphere_set(world);
    WideBuilder builder;
    const auto tree = builder.build(spheres);
    ASSERT_TRUE(tree.ok());
    test::BlockRays maker(world, ++seed);
    HostileSegments segments(spheres, seed);
    RayBatch camera, shadow, parallel, any;
    for (std::int64_t block = 0; block < kBlocks; ++block) {
      maker.add_camera(camera);
      maker.add_shadow(shadow);
      maker.add_parallel(parallel);
      maker.add_any(any);
    }
    for (RayBatch* rays : {&camera, &shadow, &parallel, &any}) segments.give(*rays);
    check(world, "camera", spheres, **tree, camera.span());
    check(world, "shadow", spheres, **tree, shadow.span());
    check(world, "parallel", spheres, **tree, parallel.span());
    check(world, "any", spheres, **tree, any.span());
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Beam, TheLastBlockMayBeShort) {
  const test::World world = test::random_world("one radius", 53, 2000, 10, 1, 1);
  const SphereSet spheres = test::sphere_set(world);
  WideBuilder builder;
  const auto tree = builder.build(spheres);
  ASSERT_TRUE(tree.ok());
  test::BlockRays maker(world, 54);
  RayBatch camera, shadow;
  for (int block = 0; block < 3; ++block) {
    maker.add_camera(camera);
    maker.add_shadow(shadow);
  }
  for (std::int64_t count = 0; count <= 130; ++count) {
    check(world, "camera", spheres, **tree, camera.span().part(3, count));
    check(world, "shadow", spheres, **tree, shadow.span().part(5, count));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Beam, AnEmptySetIsMissed) {
  const SphereSet spheres;
  WideBuilder builder;
  const auto tree = builder.build(spheres);
  ASSERT_TRUE(tree.ok());
  RayBatch rays;
  for (int i = 0; i < 100; ++i) rays.push_back({{0, 0, 0}, {1, 0, 0}});
  check({}, "empty", spheres, **tree, rays.span());
}

}  // namespace
}  // namespace bihive
