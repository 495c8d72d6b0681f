// Soft shadows: the points of a light, and shadows whose share is known.
// ctest: asan-long
#include "bihive/scene/light_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bihive/render/renderer.h"
#include "bihive/render/shading.h"

namespace bihive {
namespace {

TEST(LightPoints, fill_the_disc_evenly_from_any_side) {
  const LightPointSets sets(256, 1);
  for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, normalized(Vec3d{1, 2, -1})}) {
    int within_half = 0;
    Vec3d sum;
    for (const Vec3d& point : sets.of_sample(0)) {
      const Vec3d beside = point - dot(point, axis) * axis;
      EXPECT_LE(length(point), 1 + 1e-9);
      // A disc of half the area.
      if (dot(beside, beside) < 0.5) ++within_half;
      sum = sum + beside;
    }
    EXPECT_NEAR(within_half / 256.0, 0.5, 0.05);
    EXPECT_LT(length(sum) / 256, 0.03);
  }
}

TEST(LightPoints, samples_take_different_sets) {
  const LightPointSets sets(8, 4);
  EXPECT_EQ(sets.count(), 4);
  for (int i = 1; i < 4; ++i) EXPECT_NE(sets.of_sample(i), sets.of_sample(0));
  EXPECT_EQ(sets.of_sample(4), sets.of_sample(0));
  EXPECT_EQ(LightPointSets(1, 1000).count(), kMostPointSets);
}

// What a place at the origin, which faces +y, receives of a light above it.
LightShare share_of(double radius, const std::vector<std::array<double, 4>>& spheres) {
  Scene scene;
  std::vector<double> column[4];
  for (const std::array<double, 4>& sphere : spheres)
    for (std::size_t i = 0; i < 4; ++i) column[i].push_back(sphere[i]);
  scene.spheres = SphereSet::from_world(column[0], column[1], column[2], column[3]).value();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  const PointLight light{{0, 1000, 0}, {1, 1, 1}, radius};
  Surface surface{};
  surface.id = kPlane;
  surface.normal = {0, 1, 0};
  surface.incoming = {0, -1, 0};
  std::int64_t rays = 0;
  const LightPointSets points(1024, 1);
  const LightShare share = soft_light_share(light, tracer, surface, points.of_sample(0), rays);
  EXPECT_EQ(rays, 1024);
  return share;
}

TEST(SoftShadow, a_sphere_hides_its_share_of_the_disc) {
  // The light fills 0.1 of the distance to each side; a sphere on the axis fills a part of that.
  EXPECT_EQ(share_of(100, {{50, 3, 0, 1}}).seen.x, 1);
  EXPECT_NEAR(share_of(100, {{0, 500, 0, 25}}).seen.x, 1 - 0.25, 0.01);
  EXPECT_NEAR(share_of(100, {{0, 500, 0, 40}}).seen.x, 1 - 0.64, 0.01);
  EXPECT_EQ(share_of(100, {{0, 500, 0, 60}}).seen.x, 0);
  // A large sphere whose edge crosses the light's middle.
  EXPECT_NEAR(share_of(100, {{5000, 500, 0, 5000 - 0.01}}).seen.x, 0.5, 0.03);
}

TEST(SoftShadow, without_anything_in_between_the_facing_is_the_mean_of_the_points) {
  const LightShare share = share_of(100, {{50, 3, 0, 1}});
  // The mean cosine over a disc of tangent 0.1: 1 - 0.1^2 / 4.
  EXPECT_NEAR(share.facing.x, 1 - 0.0025, 0.0005);
}

}  // namespace
}  // namespace bihive
