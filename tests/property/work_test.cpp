// The work on hostile sets, counted and not timed: n log n for a tree of n spheres, and for a picture of n rays.
//
// Spheres read by the builders, boxes and spheres tested by the walks. For each set the work per n log2 n at several n
// stays below the bound stated here. A ray costs more than log n on a few sets; their bound is stated as well, and
// docs/reliability.md shows the figures.
//
// In the environment BIHIVE_PRINT_WORK prints them, and BIHIVE_LONG adds a million spheres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bihive/bih/observer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/wide/build/split.h"
#include "bihive/wide/trace/ray_walk-inl.h"
#include "bihive/wide/wide_builder.h"
#include "support/effort.h"
#include "support/growing_sets.h"

namespace bihive {
namespace {

namespace here = HWY_NAMESPACE;

const std::vector<int>& sizes() {
  static const std::vector<int> sizes = [] {
    if (test::test_share() > 1) return std::vector<int>{1000, 8000};
    if (std::getenv("BIHIVE_LONG") != nullptr) return std::vector<int>{1000, 8000, 64000, 1000000};
    return std::vector<int>{1000, 8000, 64000};
  }();
  return sizes;
}

// With two sets more, which are hostile to rays.
const std::vector<test::GrowingSet>& sets_of_work() {
  static const std::vector<test::GrowingSet> sets = [] {
    std::vector<test::GrowingSet> all = test::growing_sets();
    const std::vector<test::GrowingSet> more{
        {"radius far above spacing",
         [](int n) {
           return test::filled(n, [](test::World& w, SplitMix64& g, int) {
             w.add(2 * g.next_double(), 2 * g.next_double(), 2 * g.next_double(), 0.5);
           });
         }},
        {"exponential, with radii",
         [](int n) {
           return test::filled(n, [n](test::World& w, SplitMix64&, int i) {
             const double c = std::exp2(-100.0 * i / n);
             w.add(c, 0.5 * c, 0.25 * c, 0.1 * c);
           });
         }},
    };
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return sets;
}

double n_log_n(int n) {
  return n * std::log2(double(n));
}

void note(const char* what, const char* set, int n, double share) {
  if (std::getenv("BIHIVE_PRINT_WORK") != nullptr) std::printf("%-14s %-36s %8d %10.2f\n", what, set, n, share);
}

// Rays of a picture of the whole set, a square of pixels whose camera stands off along the diagonal.
std::vector<Ray> picture_of(const SphereSet& spheres, int side) {
  Vec3d lo{HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], spheres.centre(id)[axis] - spheres.radius(id));
      hi[axis] = std::max(hi[axis], spheres.centre(id)[axis] + spheres.radius(id));
    }
  const Vec3d middle = 0.5 * lo + 0.5 * hi, half = 0.5 * hi - 0.5 * lo;
  const double extent = std::max({half.x, half.y, half.z});
  const Vec3d eye = middle + extent * Vec3d{2.2, 1.7, 3.1};
  std::vector<Ray> rays;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      // Through a point of the middle plane of the box.
      const Vec3d at{middle.x + half.x * (2 * (i + 0.5) / side - 1), middle.y + half.y * (2 * (j + 0.5) / side - 1),
                     middle.z};
      Ray ray;
      ray.origin = to_float(eye);
      ray.direction = to_float((1 / extent) * (at - eye));
      rays.push_back(ray);
    }
  return rays;
}

// Boxes and spheres that the reference walk tests for a ray.
double reference_work(const Tree& tree, const SphereSet& spheres, const std::vector<Ray>& rays) {
  CountingObserver observer;
  for (const Ray& ray : rays) traverse<false>(tree, spheres, ScaledRay(ray, spheres), observer);
  return double(observer.node_visits + observer.sphere_tests) / double(rays.size());
}

// Steps of the wide walk for a ray, each of which tests up to sixteen boxes or spheres; larger leaves are several
// steps.
double wide_work(const WideTree& tree, const std::vector<Ray>& rays) {
  std::int64_t steps = 0;
  for (const Ray& world : rays) {
    here::RayWalk walk;  // NOLINT: written before read
    ScaledRay scaled(world, tree.scale);
    double length = 0, shift = 0;
    if (!here::set_up_single_ray(world, tree, walk.ray, length, shift)) continue;
    Hit best;
    const auto decide = [&](std::uint32_t slot) {
      best.keep_nearer(sphere_hit(scaled, tree.centre(slot), tree.spheres.radius(slot)), tree.spheres.id(slot));
      if (best.found()) walk.ray.s_best = std::min(walk.ray.s_best, upper_distance(best.t, length, shift));
      return false;
    };
    walk.begin(0);
    do {
      ++steps;
    } while (walk.step<false>(tree, decide));
  }
  const double steps_of_leaf = std::ceil(double(tree.largest_leaf) / kWidth);
  return double(steps) * std::max(1.0, steps_of_leaf) / double(rays.size());
}

// Spheres that the splits of the wide builder read. All else that it does takes a few passes over spheres or nodes;
// where spheres lie in piles it does all of it twice.
std::int64_t wide_splitting(const SphereSet& spheres, int threads) {
  const std::int64_t count = spheres.size();
  const InputSummary summary = wide::summarize(spheres, 0, count);
  constexpr int kArrays = 5;
  const auto room = static_cast<std::size_t>(count + kWidth);
  std::vector<float> memory(2 * kArrays * room);
  std::vector<std::uint32_t> words(2 * room);
  const auto arrays = [&](std::size_t which) {
    float* const first = memory.data() + which * kArrays * room;
    return SphereArrays{first, first + room, first + 2 * room, first + 3 * room, words.data() + which * room};
  };
  NodeArena arena;
  SplitContext context;
  context.scratch = arrays(0);
  context.final = arrays(1);
  context.largest_radius = summary.largest_radius;
  context.arena = &arena;
  wide::load_spheres(spheres, 0, count, context);
  BinaryNode root;
  SplitRange range;
  range.node = &root;
  range.centres = summary.centres;
  range.count = count;
  parallel_tasks(threads, [&](TaskList& list) { wide::split_range(context, range, list); });
  EXPECT_FALSE(context.out_of_memory);
  return context.spheres_read;
}

TEST(Work, OfTheReferenceBuilder) {
  // A range is halved at most some 450 times until both halves are occupied: binary32 has no more.
  for (const test::GrowingSet& set : sets_of_work())
    for (const int n : sizes()) {
      const SphereSet spheres = test::sphere_set(set.make(n));
      std::int64_t spheres_read = 0;
      build_reference_tree(spheres, {8, kUnlimited}, &spheres_read);
      const double share = double(spheres_read) / n_log_n(n);
      note("reference tree", set.name, n, share);
      EXPECT_LT(share, 450 / std::log2(double(n)) + 3) << set.name << ", " << n;
      EXPECT_GE(spheres_read, n);
    }
}

TEST(Work, OfTheWideBuilder) {
  for (const test::GrowingSet& set : sets_of_work())
    for (const int n : sizes()) {
      const SphereSet spheres = test::sphere_set(set.make(n));
      const std::int64_t spheres_read = wide_splitting(spheres, 1);
      const double share = double(spheres_read) / n_log_n(n);
      note("wide tree", set.name, n, share);
      EXPECT_LT(share, 45) << set.name << ", " << n;
      EXPECT_GE(spheres_read, n);
      EXPECT_EQ(wide_splitting(spheres, 3), spheres_read) << set.name << ", on three threads";
    }
}

// How the work for a ray grows, at most.
enum class Growth { log_n, sqrt_n, n };

struct RayGrowth {
  Growth reference = Growth::log_n, wide = Growth::log_n;
};

// The reference tree keeps equal spheres in one leaf, and a ray tests each; the wide tree has one of them (Pile). Boxes
// of spheres about one centre lie in each other, and no tree of boxes tells which a ray meets first. Where radii are
// far above the spacing, a ray enters the boxes of all spheres near the surface before it meets one; on a line of
// overlapping spheres these are a share of all.
RayGrowth ray_growth(const std::string& set) {
  if (set == "coincident" || set == "piles at powers of two") return {Growth::n, Growth::log_n};
  if (set == "nested" || set == "on a line") return {Growth::n, Growth::n};
  if (set == "radius far above spacing") return {Growth::sqrt_n, Growth::sqrt_n};
  return {};
}

// Boxes and spheres of the reference walk; a step of the wide walk tests up to sixteen.
double most_work(Growth growth, bool is_wide, double n) {
  switch (growth) {
    case Growth::log_n:
      return (is_wide ? 1 : 8) * std::log2(n);
    case Growth::sqrt_n:
      return (is_wide ? 0.3 : 3) * std::sqrt(n);
    default:
      return (is_wide ? 0.07 : 1.05) * n;
  }
}

TEST(Work, OfPictures) {
  for (const test::GrowingSet& set : sets_of_work())
    for (const int n : sizes()) {
      const SphereSet spheres = test::sphere_set(set.make(n));
      const std::vector<Ray> rays = picture_of(spheres, 16);
      WideBuilder builder;
      const auto tree = builder.build(spheres, {}, 1);
      ASSERT_TRUE(tree.ok());
      const double reference = reference_work(build_reference_tree(spheres, {8, kUnlimited}), spheres, rays);
      const double wide = wide_work(**tree, rays);
      note("reference ray", set.name, n, reference);
      note("wide ray", set.name, n, wide);
      const RayGrowth growth = ray_growth(set.name);
      EXPECT_LT(reference, most_work(growth.reference, false, n)) << set.name << ", " << n;
      EXPECT_LT(wide, most_work(growth.wide, true, n)) << set.name << ", " << n;
      EXPECT_GT(std::min(reference, wide), 0) << set.name;
    }
}

}  // namespace
}  // namespace bihive
