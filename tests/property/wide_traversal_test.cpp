// The wide engine gives the scalar reference's bits: every form of query, on every target, for any spheres and any ray.
//
// BIHIVE_LONG=N in the environment repeats everything with N seeds (scripts/verify); support/effort.h does less on slow
// machines.
// ctest: kernel *LargeSets
// ctest: COST 700
// ctest: share 4
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/query_rays.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

using test::QueryRays;
using test::WideUnderTest;
using test::World;

// Of the rays; of all work, where that goes by rays alone.
const std::int64_t kShare = test::ray_share(), kShareOfAll = test::test_share();

std::uint64_t seeds() {
  const char* const number = std::getenv("BIHIVE_LONG");
  return number == nullptr ? 1 : std::strtoull(number, nullptr, 10);
}

// Runs a body for each seed until something fails.
template <class Body>
void for_each_seed(const Body& body) {
  for (std::uint64_t seed = 1; seed <= seeds() && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    body(seed * 1000003);
  }
}

std::vector<Ray> query_rays(const World& world, const WideUnderTest& wide, std::uint64_t seed, std::int64_t count) {
  QueryRays rays(world, seed, [&](const Ray& ray) { return wide.truth(ray); });
  std::vector<Ray> list;
  for (std::int64_t i = 0; i < count; ++i) list.push_back(rays.next());
  return list;
}

struct Tally {
  std::int64_t sets = 0, hits = 0;
};

void check_world(const World& world, std::uint64_t seed, std::int64_t count, const std::vector<WideParameters>& shapes,
                 Tally& tally) {
  if (world.size() == 0 || !test::takes_set(tally.sets++)) return;
  SCOPED_TRACE(world.name);
  WideUnderTest wide(world, shapes);
  wide.check(query_rays(world, wide, seed, count / kShare), count / kShare / 4);
  const std::int64_t blocks = count / kShare / 128;
  wide.check(test::blocks_of_rays(world, seed, blocks, [&](const Ray& ray) { return wide.truth(ray); }),
             count / kShare / 8);
  tally.hits += wide.hits();
}

TEST(WideTraversal, EqualsTheReferenceOnDegenerateSets) {
  for_each_seed([](std::uint64_t seed) {
    Tally tally;
    for (const World& world : test::degenerate_worlds()) check_world(world, seed, 1500, {{}, {1, 0}}, tally);
    EXPECT_GT(tally.hits, 10000 / test::test_share());
  });
}

TEST(WideTraversal, EqualsTheReferenceOnHostileSets) {
  constexpr WideParameters kShapes[] = {{1, 0}, {100, 0}, {0, 2}, {3, 3}};
  for_each_seed([&](std::uint64_t seed) {
    Tally tally;
    std::size_t number = seed;
    for (const World& world : test::hostile_worlds(4096, 1000))
      check_world(world, seed, 5000, {{}, kShapes[number++ % std::size(kShapes)]}, tally);
    EXPECT_GT(tally.hits, 20000 / test::test_share());
  });
}

// Sets that are hard for a tree, a memory layout or a unit of length.
std::vector<World> special_worlds(std::uint64_t seed) {
  std::vector<World> worlds;
  // Radii: a palette that is exactly full, one that is too full by one, one without any repetition; one radius of 0
  // among few.
  for (const int radii : {31, 32, 33, 400}) {
    worlds.push_back(test::random_world(std::to_string(radii) + " radii", seed + 1, 800, 10, 1, 1));
    for (std::size_t i = 0; i < worlds.back().size(); ++i)
      worlds.back().r[i] = 0.1f + 0.9f * static_cast<float>(i % static_cast<std::size_t>(radii)) / 400;
  }
  for (const int n : {1, 2, 15, 16, 17, 255, 256, 257, 4097})
    worlds.push_back(test::random_world(std::to_string(n) + " random", seed + 2, n, 10, 0.3, 0.3));
  // One sphere around and among many tiny ones.
  worlds.push_back(test::random_world("tiny ones", seed + 3, 2000, 1, 1e-4, 1e-3));
  worlds.back().name = "a huge one and tiny ones";
  worlds.back().add(0, 0, 0, 0.9);
  worlds.back().add(50, 0, 0, 49.5);
  // Needles: tight clusters in rows.
  World needles = test::random_world("needles", seed + 4, 1500, 1, 1e-3, 1e-2);
  for (std::size_t i = 0; i < needles.size(); ++i) needles.y[i] *= 1e-3f, needles.z[i] *= 1e-3f, needles.x[i] *= 100;
  worlds.push_back(needles);
  // Spheres beyond 0 in one corner of a large set; magnitudes of every size.
  World magnitudes;
  magnitudes.name = "magnitudes";
  SplitMix64 rng(seed + 5);
  for (int i = 0; i < 600; ++i) {
    const double size = std::ldexp(1, -static_cast<int>(rng.next_below(90)));
    magnitudes.add(test::uniform(rng, -1, 1) * size, test::uniform(rng, -1, 1) * size, test::uniform(rng, -1, 1) * size,
                   size * test::uniform(rng, 0, 0.5));
  }
  worlds.push_back(magnitudes);
  worlds.push_back(test::coincident_world(seed + 6, 3, 700));
  worlds.back().name = "three piles";
  const World base = test::random_world("base", seed + 7, 700, 10, 0.1, 1.5);
  for (const double factor : {1e-30, 1e-20, 1e20, 1e30})
    worlds.push_back(base.scaled(factor, "scaled by " + std::to_string(std::log10(factor))));
  return worlds;
}

TEST(WideTraversal, EqualsTheReferenceOnSpecialSets) {
  for_each_seed([](std::uint64_t seed) {
    Tally tally;
    for (const World& world : special_worlds(seed)) check_world(world, seed, 4000, {{}}, tally);
    EXPECT_GT(tally.hits, 20000 / test::test_share());
  });
}

TEST(WideTraversal, EqualsTheReferenceOnRandomSets) {
  for_each_seed([](std::uint64_t seed) {
    Tally tally;
    for (std::uint64_t k = 1; k <= (kShare > 1 ? 20 : 60) && !testing::Test::HasFatalFailure(); ++k) {
      SplitMix64 rng(seed + k);
      const int count = static_cast<int>(test::log_uniform(rng, 1, 3000));
      const double half = test::log_uniform(rng, 1e-6, 1e6);
      const double r_lo = half * test::log_uniform(rng, 1e-5, 1);
      const double r_hi = r_lo * test::log_uniform(rng, 1.01, 1e4);
      const double away = rng.next_below(2) == 0 ? 0 : half * test::log_uniform(rng, 1, 1e4);
      const World world =
          test::random_world("random " + std::to_string(k), seed + k, count, half, r_lo, r_hi, away, -away, away * 0.3);
      const WideParameters shape{static_cast<std::int64_t>(rng.next_below(20)),
                                 static_cast<std::int64_t>(rng.next_below(6))};
      check_world(world, seed + k, 2000, {{}, shape}, tally);
    }
    EXPECT_GT(tally.hits, 5000 / test::test_share());
  });
}

TEST(WideTraversal, DeepTreesAndLongLists) {
  // Groups of spheres at 2^-i, one inside the corner of the other: more levels than a tile's lists have room for.
  World world;
  world.name = "groups at all scales";
  SplitMix64 rng(71);
  for (int i = 0; i < 120; ++i)
    for (int k = 0; k < 6; ++k) {
      const double scale = std::ldexp(1, -i);
      world.add(scale * test::uniform(rng, 0.5, 1), scale * test::uniform(rng, 0.5, 1),
                scale * test::uniform(rng, 0.5, 1), scale * test::uniform(rng, 0.005, 0.05));
    }
  WideUnderTest wide(world, {{1, 0}});
  EXPECT_GT(wide.tree().levels, 8);
  // Rays through the corner, or past it at any scale; a few thousand spheres are met exactly.
  std::vector<Ray> rays;
  for (std::int64_t i = 0; i < 17000 / kShareOfAll; ++i) {
    const Vec3d eye{test::uniform(rng, -1, 2), test::uniform(rng, -1, 2), test::uniform(rng, -1, 2)};
    const double miss = std::ldexp(1, -static_cast<int>(rng.next_below(60)));
    const Vec3d target{test::uniform(rng, 0, miss), test::uniform(rng, 0, miss), test::uniform(rng, 0, miss)};
    Ray ray;
    ray.origin = to_float(eye);
    ray.direction = to_float(target - to_double(ray.origin));
    rays.push_back(ray);
  }
  wide.check(rays, 200);
  wide.check(query_rays(world, wide, 72, 4000 / kShareOfAll), 200);
  EXPECT_GT(wide.hits(), 2000 / kShareOfAll);

  // All rays of one octant, from deep inside towards the corner. No list gets shorter on the way to the rays' start. At
  // last there is no room for another list, and one stream of all rays goes on.
  rays.clear();
  for (std::int64_t i = 0; i < 32768 / kShareOfAll; ++i) {
    const double near = std::ldexp(1, -60 - static_cast<int>(rng.next_below(50)));
    Ray ray;
    ray.origin = to_float(Vec3d{test::uniform(rng, 1, 2), test::uniform(rng, 1, 2), test::uniform(rng, 1, 2)} * near);
    ray.direction = to_float(Vec3d{0, 0, 0} - to_double(ray.origin) / near);
    rays.push_back(ray);
  }
  const std::int64_t hits_before = wide.hits();
  wide.check(rays, 200);
  EXPECT_GT(wide.hits() - hits_before, 10000 / kShareOfAll);
}

TEST(WideTraversal, LargeSets) {
  // Enough spheres that the builder sorts them into a grid first, evenly and in clusters.
  for (const bool clusters : {false, true}) {
    World world = test::random_world(clusters ? "large, clusters" : "large", 73, 160000, 20, 0.02, 0.1);
    if (clusters)
      for (std::size_t i = 0; i < world.size(); ++i)
        for (std::vector<float>* c : {&world.x, &world.y, &world.z})
          (*c)[i] = std::round((*c)[i] * 0.2f) * 5 + (*c)[i] * 0.1f;
    WideUnderTest wide(world);
    wide.check(query_rays(world, wide, 74, 4000 / kShare), 1000 / kShare);
    wide.check(test::blocks_of_rays(world, 75, 64 / kShare, [&](const Ray& ray) { return wide.truth(ray); }),
               100 / kShare);
    EXPECT_GT(wide.hits(), 2000 / kShare);
  }
}

TEST(WideTraversal, AnyNumberOfRays) {
  const World world = test::random_world("random", 52, 3000, 10, 0.1, 0.8);
  WideUnderTest wide(world);
  const RayBatch all = test::batch_of(query_rays(world, wide, 53, 70000 / kShareOfAll));
  for (const std::int64_t n : {0, 1, 2, 3, 15, 16, 17, 31, 33, 63, 64, 65, 127, 129, 1000, 4096, 4097, 16384, 70000}) {
    if (n > all.size() || testing::Test::HasFatalFailure()) break;
    wide.check(all.span().part(0, n), 0);
    // Arrays that start at any address, and end with the last ray.
    const std::int64_t first = all.size() - n;
    wide.check(all.span().part(first, n), 0);
  }
}

TEST(WideTraversal, ArraysThatAreLeftOut) {
  const World world = test::coincident_world(54, 200, 3);
  WideUnderTest wide(world);
  const RayBatch full = test::batch_of(query_rays(world, wide, 55, 3000 / kShare));
  for (int kept = 0; kept < 16 && !testing::Test::HasFatalFailure(); ++kept) {
    SCOPED_TRACE("arrays kept: " + std::to_string(kept));
    RaySpan rays = full.span();
    if ((kept & 1) == 0) rays.t_min = nullptr;
    if ((kept & 2) == 0) rays.t_max = nullptr;
    if ((kept & 4) == 0) rays.leaves = nullptr;
    if ((kept & 8) == 0) rays.inside = nullptr;
    wide.check(rays, 200);
  }
}

TEST(WideTraversal, TheOrderOfTheRaysDoesNotShow) {
  const World world = test::random_world("random", 56, 2000, 10, 0.1, 0.8);
  WideUnderTest wide(world);
  const auto closest = [&](const Ray& ray) { return wide.truth(ray); };
  std::vector<Ray> rays = test::blocks_of_rays(world, 57, 64, closest);
  // A valid ray and an invalid one in turn, then each octant in turn, then all the same, then shuffled.
  std::vector<Ray> alternating = rays;
  for (std::size_t i = 1; i < alternating.size(); i += 2) alternating[i].direction = {0, 0, 0};
  wide.check(alternating, 100);
  std::vector<Ray> octants = rays;
  for (std::size_t i = 0; i < octants.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) octants[i].direction[axis] *= (i >> axis & 1) != 0 ? -1.0f : 1.0f;
  wide.check(octants, 100);
  wide.check(std::vector<Ray>(1000, rays[0]), 1);
  SplitMix64 rng(58);
  for (std::size_t i = rays.size() - 1; i > 0; --i) std::swap(rays[i], rays[rng.next_below(i + 1)]);
  wide.check(rays, 100);
  // One ray that starts too far away for binary32 among near ones, at each place of its block.
  for (std::size_t place = 0; place < 64; place += 7) {
    std::vector<Ray> mixed(rays.begin(), rays.begin() + 64);
    mixed[place].origin = {1e12f, 2e12f, -1e12f};
    mixed[place].direction = {-1e12f, -2e12f, 1e12f};
    wide.check(mixed, 64);
  }
}

TEST(WideTraversal, OfNoSpheresHitsNothing) {
  WideUnderTest wide(World{});
  std::vector<Ray> rays;
  SplitMix64 rng(59);
  for (int i = 0; i < 200; ++i) rays.push_back({{0, rng.next_float(), 0}, {rng.next_float(), 1, rng.next_float()}});
  rays[7].leaves = 0;
  wide.check(rays);
  EXPECT_EQ(wide.hits(), 0);
  EXPECT_GT(wide.queries(), 0);
}

TEST(WideTraversal, OfEqualSpheresTheSmallestIdIsHit) {
  World world = test::pile("pile", 1000, 0, 0, 0, 1);
  for (int i = 0; i < 20; ++i) world.add(10 + i, 0, 0, 0.25);
  WideUnderTest wide(world);
  std::vector<Ray> rays(70, Ray{{0.25f, 0.5f, 5}, {0, 0, -1}});
  wide.check(rays);
  EXPECT_EQ(closest_hit(wide.tree(), rays[0]).sphere_id, 0);
  // A ray that leaves one of several equal spheres leaves all of them.
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].leaves = static_cast<std::int64_t>(i * 14);
    rays[i].inside = i % 2 == 0;
  }
  wide.check(rays);
  EXPECT_FALSE(closest_hit(wide.tree(), rays[1]).found());
}

TEST(WideTraversal, EndsOfASegmentExactlyAtTheHit) {
  const World world = test::random_world("random", 60, 400, 10, 0.2, 3);
  WideUnderTest wide(world);
  std::vector<Ray> rays;
  for (Ray ray : query_rays(world, wide, 61, 1500 / kShare)) {
    const Hit hit = wide.truth(ray);
    if (!hit.found()) continue;
    constexpr double kInf = std::numeric_limits<double>::infinity();
    for (const double end : {std::nextafter(hit.t, -kInf), hit.t, std::nextafter(hit.t, kInf)}) {
      Ray cut = ray;
      cut.t_max = end;
      rays.push_back(cut);
      cut = ray;
      cut.t_min = end;
      rays.push_back(cut);
      cut.t_max = end;
      rays.push_back(cut);
    }
  }
  ASSERT_GT(static_cast<std::int64_t>(rays.size()), 3000 / kShare);
  wide.check(rays, 500);
}

}  // namespace
}  // namespace bihive
