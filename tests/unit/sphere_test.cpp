// ctest: inlined
// ctest: asan-long
#include "bihive/geometry/sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/plane.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double hit(const Ray& ray, Vec3d centre, double radius) {
  return sphere_hit(ScaledRay(ray, 1), centre, radius);
}

TEST(Sphere, IsHitAtTheNearRoot) {
  EXPECT_EQ(hit({{0, 0, 10}, {0, 0, -1}}, {0, 0, 0}, 1), 9);
}

TEST(Sphere, CountsTInLengthsOfTheDirection) {
  EXPECT_EQ(hit({{0, 0, 10}, {0, 0, -2}}, {0, 0, 0}, 1), 4.5);
  EXPECT_EQ(hit({{0, 0, 10}, {0, 0, -0.125f}}, {0, 0, 0}, 1), 72);
}

TEST(Sphere, IsHitAtTheFarRootFromInside) {
  EXPECT_EQ(hit({{0, 0, 0.5f}, {0, 0, -1}}, {0, 0, 0}, 1), 1.5);
}

TEST(Sphere, IsMissedBehindTheRayAndBesideIt) {
  EXPECT_EQ(hit({{0, 0, 10}, {0, 0, 1}}, {0, 0, 0}, 1), kInfinity);
  EXPECT_EQ(hit({{2, 0, 10}, {0, 0, -1}}, {0, 0, 0}, 1), kInfinity);
}

TEST(Sphere, IsHitOnceByATangent) {
  const SphereRoots roots = sphere_roots(ScaledRay({{1, 0, 10}, {0, 0, -1}}, 1), {0, 0, 0}, 1);
  EXPECT_EQ(roots.t_near, 10);
  EXPECT_EQ(roots.t_far, 10);
  const float beside = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(hit({{beside, 0, 10}, {0, 0, -1}}, {0, 0, 0}, 1), kInfinity);
}

TEST(Sphere, BothEndsOfTheSegmentCount) {
  Ray ray{{0, 0, 10}, {0, 0, -1}};
  ray.t_max = 9;
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), 9);
  ray.t_max = std::nextafter(9.0, 0.0);
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), kInfinity);
  ray.t_min = 9;
  ray.t_max = kInfinity;
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), 9);
  ray.t_min = std::nextafter(9.0, 10.0);
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), 11) << "the near root lies before the segment: the far one counts";
  ray.t_min = ray.t_max = 11;
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), 11);
  ray.t_min = std::nextafter(11.0, 12.0);
  ray.t_max = kInfinity;
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), kInfinity);
}

TEST(Sphere, ANegativeSegmentLooksBack) {
  Ray ray{{0, 0, 10}, {0, 0, 1}};
  ray.t_min = -kInfinity;
  EXPECT_EQ(hit(ray, {0, 0, 0}, 1), -11);
}

TEST(Sphere, OfRadiusZeroIsNeverHit) {
  EXPECT_EQ(hit({{0, 0, 10}, {0, 0, -1}}, {0, 0, 0}, 0), kInfinity);
  EXPECT_EQ(hit({{0, 0, 0}, {0, 0, -1}}, {0, 0, 0}, 0), kInfinity);
}

TEST(Sphere, ThatTheRayLeavesOutwardIsSkipped) {
  Ray ray{{0, 0, 0.5f}, {0, 0, -1}};
  const SphereSet spheres =
      SphereSet::from_world(std::vector<float>{0, 0, 0}, {0, 0, 0}, {0, 0, 0.25f}, {1, 1, 1}).value();
  ray.leaves = 0;
  const ScaledRay scaled(ray, spheres);
  const auto hit_of = [&](std::int64_t id) {
    return sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id));
  };
  EXPECT_EQ(hit_of(0), kInfinity);
  EXPECT_EQ(hit_of(1), kInfinity) << "an equal sphere has the same surface";
  EXPECT_EQ(hit_of(2), 1.25) << "another one is met";
}

TEST(Sphere, ThatTheRayGoesIntoIsMetAtTheFarRootAlone) {
  // The start lies a little outside, as a rounded point of the surface may.
  Ray ray{{0, 0, 1.0001f}, {0, 0, -1}};
  const SphereSet spheres =
      SphereSet::from_world(std::vector<float>{0, 0, 0}, {0, 0, 0}, {0, 0, -0.25f}, {1, 1, 1}).value();
  ray.leaves = 0;
  ray.inside = true;
  const ScaledRay scaled(ray, spheres);
  const auto hit_of = [&](std::int64_t id) {
    return sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id));
  };
  EXPECT_EQ(hit_of(0), double(1.0001f) + 1);
  EXPECT_EQ(hit_of(1), double(1.0001f) + 1) << "an equal sphere has the same surface";
  EXPECT_EQ(hit_of(2), double(1.0001f) + 0.25 - 1) << "another one is met at its near root";
}

TEST(Sphere, SmallAndFarIsNotLost) {
  // Radius 0.001 seen from distance 100, at 0.999999 and 1.000001 radii: binary32 could not tell these apart.
  const double radius = double(0.001f);
  EXPECT_LT(hit({{0, 0, 100}, {0, 0, -1}}, {radius * 0.999999, 0, 0}, radius), 100);
  EXPECT_EQ(hit({{0, 0, 100}, {0, 0, -1}}, {radius * 1.000001, 0, 0}, radius), kInfinity);
}

TEST(Hit, OfEqualTKeepsTheSmallerId) {
  Hit best;
  EXPECT_FALSE(best.found());
  best.keep_nearer(kInfinity, 0);
  EXPECT_FALSE(best.found()) << "no hit is no candidate";
  best.keep_nearer(2, 5);
  best.keep_nearer(2, 7);
  EXPECT_EQ(best.sphere_id, 5);
  best.keep_nearer(2, 3);
  EXPECT_EQ(best.sphere_id, 3);
  best.keep_nearer(1, 9);
  EXPECT_EQ(best.sphere_id, 9);
  EXPECT_EQ(best.t, 1);
}

TEST(Plane, IsHitFromBothSidesInsideTheSegmentOnly) {
  const Plane ground{{0, -20, 0}, {0, 1, 0}};
  Ray ray{{3, 10, 4}, {0, -2, 0}};
  EXPECT_EQ(plane_hit(ray, ground), 15);
  EXPECT_EQ(plane_hit({{3, -25, 4}, {1, 5, 0}}, ground), 1);
  EXPECT_EQ(plane_hit({{3, 10, 4}, {0, 1, 0}}, ground), kInfinity);
  EXPECT_EQ(plane_hit({{3, 10, 4}, {1, 0, 0}}, ground), kInfinity) << "parallel";
  EXPECT_EQ(plane_hit({{3, -20, 4}, {1, 0, 0}}, ground), kInfinity) << "inside the plane";
  ray.t_max = 15;
  EXPECT_EQ(plane_hit(ray, ground), 15);
  ray.t_max = std::nextafter(15.0, 0.0);
  EXPECT_EQ(plane_hit(ray, ground), kInfinity);
  ray = {{3, -20, 4}, {0, 1, 0}};
  EXPECT_EQ(plane_hit(ray, ground), 0);
  ray.leaves = kPlane;
  EXPECT_EQ(plane_hit(ray, ground), kInfinity);
}

}  // namespace
}  // namespace bihive
