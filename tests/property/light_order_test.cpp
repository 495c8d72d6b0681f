// Rays that lead to one light from surfaces everywhere get the reference traversal's answers on every target, sorted
// for beams and not.
// ctest: kernel
#include "bihive/wide/schedule/light_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bihive/simd/target.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/schedule/reordered_batch.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/trace/beams.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/scenes.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

constexpr int kRays = 2563;  // no multiple of a vector or a block
constexpr int kFewerRays = 1000, kMoreRays = 3205;

struct Box {
  Vec3d middle;
  double size = 1e-300;
};

Box box_of(const test::World& world) {
  Vec3d lo{1e300, 1e300, 1e300};
  Vec3d hi = lo * -1;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const double c[3] = {double(world.x[i]), double(world.y[i]), double(world.z[i])};
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], c[axis] - double(world.r[i]));
      hi[axis] = std::max(hi[axis], c[axis] + double(world.r[i]));
    }
  }
  return {(lo + hi) * 0.5, std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z, 1e-300})};
}

Vec3d unit(SplitMix64& rng) {
  for (;;) {
    const Vec3d v{test::uniform(rng, -1, 1), test::uniform(rng, -1, 1), test::uniform(rng, -1, 1)};
    if (dot(v, v) <= 1 && dot(v, v) > 1e-4) return normalized(v);
  }
}

// Lights far away, beside the set, in its middle (so that directions go everywhere), in the middle of a sphere.
Vec3d some_light(const test::World& world, const Box& box, int which, SplitMix64& rng) {
  switch (which) {
    case 0:
      return box.middle + unit(rng) * (box.size * 100);
    case 1:
      return box.middle + unit(rng) * (box.size * test::uniform(rng, 0.3, 2));
    case 2:
      return box.middle;
    default: {
      const auto i = static_cast<std::size_t>(rng.next_below(world.size()));
      return {double(world.x[i]), double(world.y[i]), double(world.z[i])};
    }
  }
}

// Rays from surfaces, some of them inward, some from no surface, a few that lead to another point than the light.
RayBatch rays_to(Vec3d light, const test::World& world, const Box& box, bool plain, SplitMix64& rng,
                 int count = kRays) {
  RayBatch rays;
  for (int i = 0; i < count; ++i) {
    const auto sphere = static_cast<std::size_t>(rng.next_below(world.size()));
    const Vec3d centre{double(world.x[sphere]), double(world.y[sphere]), double(world.z[sphere])};
    Ray ray;
    ray.origin = to_float(centre + unit(rng) * double(world.r[sphere]));
    ray.leaves = static_cast<std::int64_t>(sphere);
    ray.t_max = 1;
    if (!plain) {
      ray.inside = rng.next_below(8) == 0;
      if (rng.next_below(8) == 0) {
        ray.origin = to_float(box.middle + unit(rng) * box.size);
        ray.leaves = kNothing;
        ray.inside = false;
      }
      if (rng.next_below(64) == 0) ray.origin = to_float(light);
      if (rng.next_below(16) == 0) ray.t_max = test::uniform(rng, -0.1, 1.5);
    }
    ray.direction = to_float(light - to_double(ray.origin));
    rays.push_back(ray);
  }
  return rays;
}

std::vector<std::uint8_t> hidden_by_reference(const test::WideUnderTest& tested, const RaySpan& rays) {
  std::vector<std::uint8_t> hidden;
  for (std::int64_t i = 0; i < rays.count; ++i) hidden.push_back(tested.truth(rays.at(i)).found() ? 1 : 0);
  return hidden;
}

void check(const std::string& what, const test::WideUnderTest& tested, const RaySpan& rays) {
  const WideTree& tree = tested.tree();
  const std::vector<std::uint8_t> expected = hidden_by_reference(tested, rays);
  const auto same = [&](const char* how, const auto& ask) {
    std::vector<std::uint8_t> hidden(expected.size(), 2);
    ask(hidden.data());
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(hidden[i], expected[i]) << what << ", " << how << ", " << active_target() << ", ray " << i << ": "
                                        << test::text_of(rays.at(static_cast<std::int64_t>(i)));
  };
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    same("any order", [&](std::uint8_t* hidden) { occluded(tree, rays, RayOrder::any, hidden); });
    same("blocks", [&](std::uint8_t* hidden) { occluded(tree, rays, RayOrder::blocks, hidden); });
    // Beams also where nobody would choose them, and with neighbours that are none: all blocks at once, and in two
    // goes.
    if (!wide::beams_take(tree, rays)) continue;
    for (const std::int64_t step : {1, 3})
      same("sorted beams", [&](std::uint8_t* hidden) {
        for (const bool others : {false, true}) {
          const wide::SortedBeams done = wide::occluded_by_sorted_beams(tree, rays, {step, others}, hidden);
          for (const RemainingRays::Run& run : done.remaining.runs())
            for (std::int64_t i = run.first; i < run.first + run.count; ++i)
              hidden[i] = occluded(tree, rays.at(i)) ? 1 : 0;
        }
      });
    if (testing::Test::HasFatalFailure()) return;
  }
  ASSERT_TRUE(use_target("").ok());
}

TEST(LightOrder, AreAnsweredAsByTheReference) {
  std::vector<test::World> worlds = test::degenerate_worlds();
  for (test::World& world : test::hostile_worlds(2000, 2000)) worlds.push_back(std::move(world));
  worlds.push_back(test::random_world("dense", 61, 3000, 5, 0.2, 1.0));
  worlds.push_back(test::random_world("one radius", 62, 4000, 20, 1, 1));
  SplitMix64 rng(63);
  int number = 0, taken = 0;
  for (const test::World& world : worlds) {
    if (world.size() == 0 || !test::takes_set(number++)) continue;
    ++taken;
    const test::WideUnderTest tested(world);
    const Box box = box_of(world);
    for (int which = 0; which < 4; ++which) {
      // Each light in some scenes only, because all of them in all scenes would take too long.
      if (test::ray_share() > 1 && which != taken % 4) continue;
      const Vec3d light = some_light(world, box, which, rng);
      const int count = which == 1 ? kFewerRays : which == 2 ? kMoreRays : kRays;
      const RayBatch rays = rays_to(light, world, box, which % 2 == 0, rng, count);
      check(world.name + ", light " + std::to_string(which), tested, rays.span());
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(LightOrder, AreKnownAsSuch) {
  const test::World world = test::random_world("one radius", 64, 4000, 20, 1, 1);
  const Box box = box_of(world);
  SplitMix64 rng(65);
  RayBatch rays = rays_to(some_light(world, box, 1, rng), world, box, true, rng);
  EXPECT_TRUE(wide::converge(rays.span()));
  EXPECT_FALSE(wide::converge(rays.span().part(0, 100)));  // sorting would not pay
  EXPECT_FALSE(wide::converge({}));

  // One ray that leads to another point is enough, at any place.
  rays.direction[1][2001] += 1;
  EXPECT_FALSE(wide::converge(rays.span()));
  rays.direction[1][2001] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(wide::converge(rays.span()));
}

// What beams do with rays from everywhere in a world to a light far away.
struct BeamsOfWorld {
  std::int64_t rays;
  wide::SortedBeams done;
};
BeamsOfWorld beams_of(const test::World& world, SplitMix64& rng) {
  const test::WideUnderTest tested(world);
  const Box box = box_of(world);
  const RayBatch rays = rays_to(some_light(world, box, 0, rng), world, box, true, rng);
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(rays.size()));
  return {rays.size(), wide::occluded_by_sorted_beams(tested.tree(), rays.span(), {}, hidden.data())};
}

// Spheres that beams of rays meet, a ray: few spheres hide all, or each ray has its own way through many.
TEST(LightOrder, BeamsCountTheSpheresThatTheyMeet) {
  SplitMix64 rng(66);
  const BeamsOfWorld few = beams_of(test::random_world("few", 67, 40, 1, 1, 1), rng);
  EXPECT_LT(static_cast<double>(few.done.spheres_met),
            static_cast<double>(few.rays - few.done.remaining.count() + 1) * wide::kMostSpheresMet);
  // 64 rays that are no neighbours: the beams are too wide, or meet many.
  const BeamsOfWorld many = beams_of(test::random_world("many", 68, 20000, 100, 0.1, 0.1), rng);
  EXPECT_TRUE(many.done.remaining.count() > many.rays / 2 ||
              many.done.spheres_met > (many.rays - many.done.remaining.count()) * wide::kMostSpheresMet);
}

// Rays in their order of cells, and how many spheres beams of them meet, a ray.
double spheres_met(const WideTree& tree, const RaySpan& rays) {
  wide::LightOrder by_light;
  wide::ReorderedBatch batch;
  EXPECT_TRUE(by_light.find(tree, rays, batch.order()));
  batch.gather(rays);
  const wide::SortedBeams done = wide::occluded_by_sorted_beams(tree, batch.rays(), {}, batch.hidden(rays.count));
  EXPECT_LT(done.remaining.count(), rays.count / 2);
  return static_cast<double>(done.spheres_met) / static_cast<double>(rays.count - done.remaining.count());
}

// From everywhere on one side of a world of small spheres. Each sphere is in the way of only one or two rays. Sorted
// beams are narrow enough, but each beam passes a hundred spheres and more.
TEST(LightOrder, RaysGoToTheListsWhereBeamsDoNotPay) {
  const test::WideUnderTest tested(test::random_world("small", 69, 120000, 100, 0.01, 0.15));
  SplitMix64 rng(70);
  const auto from_a_square = [&](double half_side) {
    RayBatch rays;
    for (int i = 0; i < kRays; ++i) {
      Ray ray;
      ray.origin =
          to_float(Vec3d{test::uniform(rng, -half_side, half_side), test::uniform(rng, -half_side, half_side), -110});
      ray.direction = to_float(Vec3d{0, 0, 1e4} - to_double(ray.origin));
      ray.t_max = 1;
      rays.push_back(ray);
    }
    return rays;
  };
  const RayBatch rays = from_a_square(20);
  ASSERT_TRUE(wide::converge(rays.span()));
  const std::vector<std::uint8_t> expected = hidden_by_reference(tested, rays.span());
  ASSERT_GT(std::count(expected.begin(), expected.end(), 1), kRays / 50);
  std::vector<std::uint8_t> hidden(expected.size());
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    EXPECT_GT(spheres_met(tested.tree(), rays.span()), wide::kMostSpheresMet) << target;
    occluded(tested.tree(), rays.span(), RayOrder::any, hidden.data());
    EXPECT_EQ(hidden, expected) << target;
    // Closer together they pass fewer spheres.
    EXPECT_LT(spheres_met(tested.tree(), from_a_square(3).span()), wide::kMostSpheresMet) << target;
  }
  ASSERT_TRUE(use_target("").ok());
}

}  // namespace
}  // namespace bihive
