// Searches among caps: lanes of every instruction set find what plain loops find, bit for bit, and measures do not
// depend on the set. ctest: kernel
#include "bihive/measure/cap_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/union_measures.h"
#include "bihive/simd/target.h"
#include "support/effort.h"
#include "support/world.h"

namespace bihive {
namespace {

using measure::CapArrays;
using measure::CapNumbers;
using measure::CirclePair;

constexpr double kDoubt = 0x1p-44;

CapNumbers random_cap(SplitMix64& rng) {
  // Few numbers, so that caps touch, share circles and repeat.
  const auto step = [&] { return std::floor(5 * rng.next_double()) - 2; };
  Vec3d axis{step(), step(), step()};
  if (axis == Vec3d{}) axis = {0, 0, 1};
  const double angle = rng.next_double() < 0.5 ? (1 + std::floor(6 * rng.next_double())) / 4 : 3 * rng.next_double();
  return {normalized(axis), std::cos(angle), std::sin(angle)};
}

template <class Test>
int first_of(const std::vector<CapNumbers>& caps, int from, const Test& test) {
  int i = from;
  while (i < static_cast<int>(caps.size()) && !test(caps[static_cast<std::size_t>(i)])) ++i;
  return i;
}

int widest_of(const std::vector<CapNumbers>& caps, const CapNumbers& cap) {
  int widest = static_cast<int>(caps.size());
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(caps.size()); ++i) {
    const CapNumbers& other = caps[static_cast<std::size_t>(i)];
    const auto [g, d] = CirclePair::of(other, cap);
    const double cosine = other.c - g * cap.c, square = cosine * std::abs(cosine) / ((1 - g) * (1 + g));
    if (!(d > kDoubt) || !(square < least)) continue;
    least = square;
    widest = i;
  }
  return widest;
}

// By the definition: the arc from the middle of what it covers to its end.
TEST(CapLanes, TheWidestCrossingCoversTheLongestArc) {
  SplitMix64 rng(8);
  for (int scene = 0; scene < 100; ++scene) {
    const CapNumbers cap{{0, 0, 1}, 0.6, 0.8};
    std::vector<CapNumbers> caps;
    for (int i = 0; i < 9; ++i) caps.push_back(random_cap(rng));
    const int widest = widest_of(caps, cap);
    // Points of the circle that a cap covers, of 3,600.
    const auto covered = [&](const CapNumbers& other) {
      int count = 0;
      for (int n = 0; n < 3600; ++n) {
        const double angle = 3.14159265358979323846 * n / 1800;
        count += dot(Vec3d{0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.6}, other.axis) > other.c ? 1 : 0;
      }
      return count;
    };
    for (const CapNumbers& other : caps)
      if (CirclePair::of(other, cap).d > kDoubt) {
        ASSERT_LT(widest, 9);
        EXPECT_LE(covered(other), covered(caps[static_cast<std::size_t>(widest)]) + 2);
      }
  }
}

// Caps on both sides of a circle, and the arc that the widest of them leaves.
TEST(CapLanes, ArcsThatAreSaidToBeCoveredAre) {
  SplitMix64 rng(12);
  const CapNumbers cap{{0, 0, 1}, 0.6, 0.8};
  int covered = 0, missed = 0, open = 0;
  for (int scene = 0; scene < 600; ++scene) {
    CapArrays arrays, crossing;
    const int count = 2 + static_cast<int>(10 * rng.next_double());
    arrays.clear(static_cast<std::size_t>(count));
    std::vector<CapNumbers> caps;
    for (int i = 0; i < count; ++i) {
      const double turn = 6.3 * rng.next_double(), z = 0.3 + 0.6 * rng.next_double(), across = std::sqrt(1 - z * z);
      const double angle = 0.3 + rng.next_double();
      caps.push_back({{across * std::cos(turn), across * std::sin(turn), z}, std::cos(angle), std::sin(angle)});
      arrays.push(caps.back());
    }
    const int widest = widest_crossing(arrays, cap, kDoubt, crossing);
    if (widest == arrays.size()) continue;
    const CapNumbers& first = caps[static_cast<std::size_t>(widest)];
    const double g = dot(first.axis, cap.axis);
    const Vec3d along = normalized(first.axis - g * cap.axis), up = cross(cap.axis, along);
    const double half = std::acos((first.c - g * cap.c) / (std::sqrt(1 - g * g) * cap.s));
    const auto at = [&](double angle) { return cap.s * (std::cos(angle) * along + std::sin(angle) * up); };
    const double pi = 3.14159265358979323846;
    // How deep each point of the arc lies in the cap that holds it best.
    double least = 1;
    for (int n = 1; n < 720; ++n) {
      const Vec3d point = cap.c * cap.axis + at(half + (2 * pi - 2 * half) * n / 720);
      double depth = -1;
      for (const CapNumbers& other : caps) depth = std::max(depth, dot(point, other.axis) - other.c);
      least = std::min(least, depth);
    }
    for (const std::string& target : test::targets_under_test()) {
      ASSERT_TRUE(use_target(target).ok());
      const bool is_covered = surely_cover(crossing, cap, {at(half), at(pi), at(-half)}, 0x1p-30);
      if (is_covered) {
        EXPECT_GT(least, 0) << target;
      }
      covered += is_covered ? 1 : 0;
      missed += !is_covered && least > 0.02 ? 1 : 0;
      open += least < 0 ? 1 : 0;
    }
    ASSERT_TRUE(use_target("").ok());
  }
  EXPECT_GT(covered, 100);
  EXPECT_GT(open, 100);
  EXPECT_LT(missed, covered / 20);
}

TEST(CapLanes, FindWhatPlainLoopsFind) {
  SplitMix64 rng(7);
  int found = 0;
  for (int scene = 0; scene < 400; ++scene) {
    std::vector<CapNumbers> caps(static_cast<std::size_t>(40 * rng.next_double()));
    CapArrays arrays;
    arrays.clear(caps.size());
    for (CapNumbers& cap : caps) {
      cap = random_cap(rng);
      arrays.push(cap);
    }
    // As caps that lie in others.
    for (int i = 0; i < arrays.size(); i += 7) {
      arrays.erase(i);
      caps[static_cast<std::size_t>(i)] = {{}, 2, 0};
    }
    const CapNumbers cap = random_cap(rng);
    const Vec3d a = random_cap(rng).axis, b = random_cap(rng).axis;
    for (const std::string& target : test::targets_under_test()) {
      ASSERT_TRUE(use_target(target).ok());
      ASSERT_EQ(active_target(), target);
      for (int from = 0; from <= arrays.size(); ++from) {
        const int unclear = first_of(caps, from, [&](const CapNumbers& other) {
          const auto [g, d] = CirclePair::of(other, cap);
          const bool apart = d < -kDoubt && g - other.c * cap.c <= 0 && other.c + cap.c > 0x1p-40;
          return !(d > kDoubt || apart);
        });
        ASSERT_EQ(first_unclear(arrays, from, cap, kDoubt), unclear) << target;
        const int holding = first_of(caps, from, [&](const CapNumbers& other) {
          return dot(a, other.axis) - other.c >= -kDoubt || dot(b, other.axis) - other.c >= -kDoubt;
        });
        ASSERT_EQ(first_holding(arrays, from, a, b, kDoubt), holding) << target;
        found += (unclear < arrays.size()) + (holding < arrays.size());
      }
      const int widest = widest_of(caps, cap);
      CapArrays crossing;
      ASSERT_EQ(widest_crossing(arrays, cap, kDoubt, crossing), widest) << target;
      found += widest < arrays.size() ? 1 : 0;
      int count = 0;
      for (const CapNumbers& other : caps) {
        if (!(CirclePair::of(other, cap).d > kDoubt)) continue;
        ASSERT_LT(count, crossing.size());
        EXPECT_EQ((Vec3d{crossing[0][count], crossing[1][count], crossing[2][count]}), other.axis) << target;
        EXPECT_EQ(crossing[3][count], other.c) << target;
        ++count;
      }
      EXPECT_EQ(count, crossing.size()) << target;
    }
    ASSERT_TRUE(use_target("").ok());
  }
  EXPECT_GT(found, 1000);
}

TEST(CapLanes, MeasuresDoNotDependOnTheInstructionSet) {
  SplitMix64 rng(11);
  test::World world;
  for (int i = 0; i < static_cast<int>(3000 / test::ray_share()) + 200; ++i)
    world.add(6 * rng.next_double(), 6 * rng.next_double(), 6 * rng.next_double(), std::exp2(-3 * rng.next_double()));
  const SphereSet spheres = test::sphere_set(world);
  MeasureOptions options;
  options.probe = 0.1;
  options.cavities = options.sphere_volumes = options.contacts = true;
  const UnionMeasures usual = measure_union(spheres, options).value();
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    const UnionMeasures measures = measure_union(spheres, options).value();
    EXPECT_EQ(measures.sphere_area, usual.sphere_area) << target;
    EXPECT_EQ(measures.sphere_volume, usual.sphere_volume) << target;
    EXPECT_EQ(measures.contacts.size(), usual.contacts.size()) << target;
    EXPECT_EQ(measures.cavities.size(), usual.cavities.size()) << target;
  }
  ASSERT_TRUE(use_target("").ok());
}

}  // namespace
}  // namespace bihive
