// Searches among caps: lanes of every instruction set find what plain loops find, bit for bit, and measures do not
// depend on the set. ctest: kernel
#include "bihive/measure/cap_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
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
        const int crossing =
            first_of(caps, from, [&](const CapNumbers& other) { return CirclePair::of(other, cap).d > kDoubt; });
        ASSERT_EQ(first_crossing(arrays, from, cap, kDoubt), crossing) << target;
        const int holding = first_of(caps, from, [&](const CapNumbers& other) {
          return dot(a, other.axis) - other.c >= -kDoubt || dot(b, other.axis) - other.c >= -kDoubt;
        });
        ASSERT_EQ(first_holding(arrays, from, a, b, kDoubt), holding) << target;
        found += (unclear < arrays.size()) + (crossing < arrays.size()) + (holding < arrays.size());
      }
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
