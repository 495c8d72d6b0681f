// Ambient occlusion: the sets of directions, and what places see where the answer is known.
// ctest: asan-long
#include "bihive/scene/ambient_occlusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/render/shading.h"
#include "bihive/scene/scene.h"

namespace bihive {
namespace {

using ::testing::DoubleNear;

TEST(DirectionSets, spread_evenly_over_the_sphere) {
  for (const int samples : {1, 4, 9, 64}) {
    const DirectionSets sets(64, samples);
    EXPECT_EQ(sets.count(), std::min(samples, kMostDirectionSets));
    std::set<std::tuple<float, float, float>> different;
    for (int i = 0; i < sets.count(); ++i) {
      Vec3d sum;
      double squares[3] = {};
      for (const Vec3f& direction : sets.of_sample(i)) {
        const Vec3d d = to_double(direction);
        EXPECT_NEAR(length(d), 1, 1e-7);
        sum = sum + d;
        for (int axis = 0; axis < 3; ++axis) squares[axis] += d[axis] * d[axis] / 64;
        different.insert({direction.x, direction.y, direction.z});
      }
      EXPECT_LT(length(sum), 0.05 * 64);
      for (const double square : squares) EXPECT_NEAR(square, 1.0 / 3, 0.02);
    }
    EXPECT_EQ(different.size(), 64u * static_cast<unsigned>(sets.count()));
    EXPECT_EQ(sets.of_sample(sets.count()), sets.of_sample(0));
  }
}

// So one of them is in front of every surface.
TEST(DirectionSets, two_directions_are_opposite) {
  const DirectionSets faint(32, 16);
  const DirectionSets of_picture(2, 16);
  Vec3d squares;
  for (int i = 0; i < faint.count(); ++i) {
    const std::vector<Vec3f>& set = faint.of_sample(i, kFaintLevels - 1);
    ASSERT_EQ(set.size(), 2u);
    EXPECT_EQ(set[1], -set[0]);
    EXPECT_EQ(set, of_picture.of_sample(i));
    const Vec3d d = to_double(set[0]);
    squares = squares + Vec3d{d.x * d.x, d.y * d.y, d.z * d.z};
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis] / faint.count(), 1.0 / 3, 0.05);
}

// A floor at y = 0 and spheres above it.
struct Floor {
  Scene scene;
  Tracer tracer;

  explicit Floor(const std::vector<std::array<double, 4>>& spheres) : scene(make(spheres)), tracer(trace(scene)) {}

  double visibility(double x, double z, int directions, double distance) const {
    Ray ray;
    ray.origin = to_float(Vec3d{x, 0.001, z});
    ray.direction = {0, -1, 0};
    const Surface surface = surface_at(scene, ray, scene_hit(scene, tracer, ray));
    std::int64_t rays = 0;
    const double seen =
        ambient_visibility(scene, tracer, surface, DirectionSets(directions, 1).of_sample(0), distance, rays).x;
    EXPECT_NEAR(static_cast<double>(rays), directions / 2.0, 2);
    return seen;
  }

 private:
  static Scene make(const std::vector<std::array<double, 4>>& spheres) {
    std::vector<double> column[4];
    for (const std::array<double, 4>& sphere : spheres)
      for (std::size_t i = 0; i < 4; ++i) column[i].push_back(sphere[i]);
    Scene made;
    made.spheres = SphereSet::from_world(column[0], column[1], column[2], column[3]).value();
    made.plane.emplace();
    return made;
  }
  static Tracer trace(const Scene& scene) { return Tracer::build(scene.spheres, Engine::reference).value(); }
};

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(AmbientOcclusion, a_sphere_above_a_plane_hides_its_analytic_share) {
  // The cosine-weighted share of a sphere that lies wholly above the horizon: cos (r / d)^2.
  const Floor floor({{0, 3, 0, 2}});
  for (const double x : {0.0, 1.0, 2.0, 4.0}) {
    const double squared = 9 + x * x;
    const double expected = 1 - 3 / std::sqrt(squared) * 4 / squared;
    // About a hundred of the 2,048 directions lie at the sphere's edge, and each counts wholly or not at all.
    EXPECT_THAT(floor.visibility(x, 0, 4096, kNoLimit), DoubleNear(expected, 0.006)) << x;
  }
}

TEST(AmbientOcclusion, a_wall_in_the_open_is_exactly_as_bright_as_without) {
  EXPECT_EQ(Floor({{1000, -5000, 0, 1}}).visibility(0, 0, 64, kNoLimit), 1.0);
}

TEST(AmbientOcclusion, what_is_farther_than_the_distance_does_not_darken) {
  const Floor floor({{0, 3, 0, 2}});
  EXPECT_EQ(floor.visibility(0, 0, 256, 0.99), 1.0);
  const double part = floor.visibility(0, 0, 256, 1.2);
  EXPECT_LT(part, 1.0);
  EXPECT_GT(part, floor.visibility(0, 0, 256, kNoLimit));
}

TEST(AmbientOcclusion, the_plane_hides_half_of_a_spheres_side) {
  // A point on the equator of a sphere far above the plane: everything below the horizon is plane.
  const Floor floor({{0, 3, 0, 1}});
  Ray ray;
  ray.origin = {10, 3, 0};
  ray.direction = {-1, 0, 0};
  const Surface surface = surface_at(floor.scene, ray, scene_hit(floor.scene, floor.tracer, ray));
  std::int64_t rays = 0;
  const auto seen = [&](double distance) {
    return ambient_visibility(floor.scene, floor.tracer, surface, DirectionSets(4096, 1).of_sample(0), distance, rays)
        .x;
  };
  EXPECT_NEAR(seen(kNoLimit), 0.5, 0.005);
  EXPECT_EQ(seen(2.9), 1.0);
}

TEST(AmbientOcclusion, it_scales_the_ambient_term_of_a_picture) {
  Scene scene = Floor({{-1, 1, 0, 1}, {1, 1, 0, 1}}).scene;
  scene.camera.eye = {0, 1, 20};
  scene.camera.look_at = {0, 1, 0};
  scene.camera.fov_deg = 10;
  for (Material& material : scene.materials) material.diffuse = material.specular = 0;
  scene.plane->material = scene.materials[0];
  const Tracer tracer = Tracer::build(scene.spheres, Engine::automatic).value();
  RenderSettings settings;
  settings.width_px = settings.height_px = 32;
  const Film open = render(scene, tracer, settings)->film;
  settings.ambient_occlusion.emplace();
  const Rendered rendered = render(scene, tracer, settings).value();
  EXPECT_GT(rendered.rays.ambient, rendered.rays.primary * 20);
  // Where the spheres touch it is darker than on their outer sides.
  const auto share = [&](int x, int y) { return rendered.film.at(x, y).x / open.at(x, y).x; };
  EXPECT_LT(share(15, 16), 0.6f);
  EXPECT_GT(share(5, 10), share(15, 16) + 0.1f);
  EXPECT_LE(share(5, 10), 1);
}

}  // namespace
}  // namespace bihive
