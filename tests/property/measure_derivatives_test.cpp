// Derivatives of area and volume: closed forms of two spheres, and differences of the measures themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/union_measures.h"
#include "support/effort.h"
#include "support/world.h"

namespace bihive {
namespace {

UnionMeasures measures_of(const SphereSet& set, bool periodic) {
  MeasureOptions options;
  options.derivatives = true;
  options.periodic = periodic;
  return measure_union(set, options).value();
}

TEST(MeasureDerivatives, OneAndTwoSpheres) {
  test::World world;
  world.add(1, 2, 3, 1.5);
  const UnionMeasures one = measures_of(test::sphere_set(world), false);
  EXPECT_NEAR(one.derivatives[0].area_by_radius, 8 * std::numbers::pi * 1.5, 1e-13);
  EXPECT_NEAR(one.derivatives[0].volume_by_radius, 4 * std::numbers::pi * 2.25, 1e-13);
  EXPECT_EQ(one.derivatives[0].area_by_centre, (Vec3d{0, 0, 0}));
  // Equal spheres at the distance d: area 4 pi r^2 + 2 pi r d, volume 4/3 pi r^3 + pi (r^2 d - d^3 / 12).
  world = {};
  world.add(0, 0, 0, 1);
  world.add(1.25, 0, 0, 1);
  const UnionMeasures two = measures_of(test::sphere_set(world), false);
  EXPECT_NEAR(two.derivatives[1].area_by_centre.x, 2 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(two.derivatives[0].area_by_centre.x, -2 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(two.derivatives[1].volume_by_centre.x, std::numbers::pi * (1 - 1.25 * 1.25 / 4), 1e-14);
  EXPECT_NEAR(two.derivatives[0].area_by_radius + two.derivatives[1].area_by_radius,
              8 * std::numbers::pi + 2.5 * std::numbers::pi, 1e-13);
  EXPECT_NEAR(two.derivatives[0].volume_by_radius + two.derivatives[1].volume_by_radius,
              4 * std::numbers::pi + 2.5 * std::numbers::pi, 1e-13);
}

// Central differences over steps of 2^-12, exact in binary32, and of their halves: Richardson's extrapolation leaves
// the fourth power of the step, where no circle appears or vanishes between.
TEST(MeasureDerivatives, AgreeWithDifferences) {
  SplitMix64 rng(77);
  const int sets = std::max(4, static_cast<int>(40 / test::ray_share()));
  int compared = 0;
  for (int set = 0; set < sets; ++set) {
    const bool periodic = set % 2 == 1;
    const int count = 2 + set % 9;
    std::vector<std::array<double, 4>> spheres;
    for (int i = 0; i < count; ++i) {
      const auto at = [&] { return std::round(1024 * rng.next_double()) / 1024; };
      spheres.push_back({at(), at(), at(), 0.25 + at() / 4});
    }
    const auto measured = [&] {
      test::World world;
      for (const auto& s : spheres) world.add(s[0], s[1], s[2], s[3]);
      SphereSet made = test::sphere_set(world);
      made.cell() = Cell{{}, {Vec3d{1.25, 0, 0}, Vec3d{0.25, 1.5, 0}, Vec3d{0, -0.5, 1.375}}};
      return measures_of(made, periodic);
    };
    const UnionMeasures measures = measured();
    for (int i = 0; i < count; ++i)
      for (int axis = 0; axis < 4; ++axis) {
        struct Slope {
          double area, volume;
        };
        const auto slope = [&](double step) {
          const double here = spheres[i][axis];
          spheres[i][axis] = here + step;
          const UnionMeasures after = measured();
          spheres[i][axis] = here - step;
          const UnionMeasures before = measured();
          spheres[i][axis] = here;
          return Slope{(after.area - before.area) / (2 * step), (after.volume - before.volume) / (2 * step)};
        };
        const Slope wide = slope(0x1p-12), narrow = slope(0x1p-13);
        const MeasureDerivatives& own = measures.derivatives[i];
        const double area = axis < 3 ? own.area_by_centre[axis] : own.area_by_radius;
        const double volume = axis < 3 ? own.volume_by_centre[axis] : own.volume_by_radius;
        // A kink between the steps shows as slopes that differ by more than their curvature.
        if (std::abs(wide.area - narrow.area) > 1e-5) continue;
        EXPECT_NEAR((4 * narrow.area - wide.area) / 3, area, 1e-5) << "set " << set << " sphere " << i << " " << axis;
        EXPECT_NEAR((4 * narrow.volume - wide.volume) / 3, volume, 1e-6)
            << "set " << set << " sphere " << i << " " << axis;
        ++compared;
      }
  }
  EXPECT_GT(compared, sets * 8);  // sets differ, and a sanitizer takes four
}

}  // namespace
}  // namespace bihive
