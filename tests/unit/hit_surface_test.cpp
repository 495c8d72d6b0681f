#include "bihive/geometry/hit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

Vec3d random_vector(SplitMix64& random) {
  Vec3d made;
  for (int axis = 0; axis < 3; ++axis) made[axis] = 2 * random.next_double() - 1;
  return made;
}

// A ray from outside towards a point well inside of the sphere.
Ray ray_at(Vec3d centre, double radius, SplitMix64& random) {
  const Vec3d from = centre + (3 + radius) * normalized(random_vector(random));
  return {to_float(from), to_float(centre + 0.6 * radius * random_vector(random) - from)};
}

TEST(HitSurface, LiesOnTheSphere) {
  const ScaledRay ray({{0, 3, 10}, {0, 0, -2}}, 1);
  const std::optional<HitSurface> hit = hit_surface(ray, 3, {0, 0, 0}, 5);
  ASSERT_TRUE(hit);
  EXPECT_LT(length(hit->position - Vec3d{0, 3, 4}), 1e-15);  // a unit in the last place
  EXPECT_NEAR(hit->normal.y, 0.6, 1e-15);
  EXPECT_EQ(hit->t_exit, 7);
  // From inside: the hit is the exit.
  const std::optional<HitSurface> exit = hit_surface(ray, 7, {0, 0, 0}, 5);
  EXPECT_LT(length(exit->position - Vec3d{0, 3, -4}), 1e-15);
  EXPECT_EQ(exit->t_exit, 7);
}

TEST(HitSurface, IsNoneForAnotherRay) {
  const ScaledRay ray({{0, 3, 10}, {0, 0, -2}}, 1);
  EXPECT_FALSE(hit_surface(ray, std::nextafter(3.0, 4.0), {0, 0, 0}, 5));
  EXPECT_FALSE(hit_surface(ray, 3, {0, 0, 0x1p-40}, 5));
  EXPECT_FALSE(hit_surface(ray, 3, {9, 9, 9}, 5));
}

// Central differences with steps of h: their error is h^2 / 6 times a third derivative, which for these rays is below
// some hundreds, and 2^-52 / h of rounding. h = 2^-18 keeps both below 1e-8.
TEST(HitSurface, DerivativesAreThoseOfDifferences) {
  constexpr double h = 0x1p-18;
  SplitMix64 random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3d centre = random_vector(random);
    const double radius = 0.5 + random.next_double();
    const ScaledRay ray(ray_at(centre, radius, random), 1);
    const auto hit_of = [&](Vec3d c, double r) { return *hit_surface(ray, sphere_roots(ray, c, r).t_near, c, r); };
    const auto t_of = [&](Vec3d c, double r) { return sphere_roots(ray, c, r).t_near; };
    const HitDerivatives by = hit_derivatives(ray.direction, hit_of(centre, radius).normal, radius);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d step;
      step[axis] = h;
      EXPECT_NEAR(by.t_by_centre[axis], (t_of(centre + step, radius) - t_of(centre - step, radius)) / (2 * h), 1e-7);
      const Vec3d turn = (hit_of(centre + step, radius).normal - hit_of(centre - step, radius).normal) / (2 * h);
      for (int row = 0; row < 3; ++row) EXPECT_NEAR(by.normal_by_centre[row][axis], turn[row], 1e-7);
    }
    EXPECT_NEAR(by.t_by_radius, (t_of(centre, radius + h) - t_of(centre, radius - h)) / (2 * h), 1e-7);
    const Vec3d turn = (hit_of(centre, radius + h).normal - hit_of(centre, radius - h).normal) / (2 * h);
    for (int row = 0; row < 3; ++row) EXPECT_NEAR(by.normal_by_radius[row], turn[row], 1e-7);
  }
}

}  // namespace
}  // namespace bihive
