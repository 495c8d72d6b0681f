// Pictures of spheres that lie on several ranks have the same bits as those of one process that has them all.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"
#include "bihive/spread/ranks_in_process.h"
#include "support/effort.h"
#include "support/random_scene.h"

namespace bihive {
namespace {

std::unique_ptr<RanksInProcess> spread(const Scene& whole, const RenderSettings& settings, int ranks,
                                       FirstSpheres first = FirstSpheres::in_order) {
  Result<std::unique_ptr<RanksInProcess>> made = RanksInProcess::make(whole, settings, {}, ranks, first);
  return std::move(*made);
}

Rendered draw(RanksInProcess& ranks, int rank, RenderSettings settings) {
  const std::unique_ptr<RankChannel> channel = ranks.channel(rank);
  const std::unique_ptr<SpreadScene::Artist> artist = ranks.scene(rank).artist(*channel);
  settings.threads = 1;
  return render(artist->scene(), artist->tracer(), settings).value();
}

void expect_same(const Rendered& expected, const Rendered& drawn, const std::string& what) {
  ASSERT_EQ(expected.film.radiance.size(), drawn.film.radiance.size());
  EXPECT_EQ(std::memcmp(expected.film.radiance.data(), drawn.film.radiance.data(),
                        drawn.film.radiance.size() * sizeof(Vec3f)),
            0)
      << what;
  EXPECT_EQ(expected.rays.primary, drawn.rays.primary) << what;
  EXPECT_EQ(expected.rays.shadow, drawn.rays.shadow) << what;
  EXPECT_EQ(expected.rays.reflected, drawn.rays.reflected) << what;
  EXPECT_EQ(expected.rays.transmitted, drawn.rays.transmitted) << what;
  EXPECT_EQ(expected.rays.ambient, drawn.rays.ambient) << what;
}

TEST(Spread, pictures_are_those_of_one_process) {
  const std::uint64_t step = test::ray_share() > 1 ? 11 : 1;
  for (std::uint64_t seed = 1; seed <= 60; seed += step) {
    const Scene scene = test::random_scene(seed);
    const RenderSettings settings = test::random_settings(seed);
    const Rendered expected = render(scene, Tracer::build(scene, Engine::wide).value(), settings).value();
    for (const int ranks : {1, 2, 3, 4, 7, 8, 100}) {
      const auto here =
          spread(scene, settings, ranks, seed % 2 == 0 ? FirstSpheres::all_on_rank_0 : FirstSpheres::in_order);
      expect_same(expected, draw(*here, static_cast<int>(seed) % ranks, settings),
                  scene.name + " on " + std::to_string(ranks) + " ranks");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(Spread, other_views) {
  for (std::uint64_t seed = 61; seed <= 68; ++seed) {
    const Scene scene = test::random_scene(seed);
    RenderSettings settings = test::random_settings(seed);
    for (const View view : {View::recursion, View::normal, View::distance, View::id}) {
      settings.view = view;
      settings.transparent = seed % 2 == 0;
      const Rendered expected = render(scene, Tracer::build(scene, Engine::wide).value(), settings).value();
      const auto here = spread(scene, settings, 3);
      expect_same(expected, draw(*here, 1, settings), scene.name + ", view " + std::to_string(static_cast<int>(view)));
      EXPECT_EQ(expected.film.coverage, draw(*here, 2, settings).film.coverage);
    }
  }
}

// Spheres that share one surface lie on one rank, where a ray that leaves one of them leaves all.
TEST(Spread, spheres_that_coincide_touch_or_lie_in_each_other) {
  std::vector<double> x, y, z, r;
  for (int copy = 0; copy < 3; ++copy)
    for (int i = 0; i < 27; ++i) {
      x.push_back(i % 3 - 1);
      y.push_back(i / 3 % 3 - 1);
      z.push_back(i / 9 - 1);
      r.push_back(copy < 2 ? 0.5 : 0.25);
    }
  x.insert(x.end(), {0, -0.0, 0});
  y.insert(y.end(), {-0.0, 0, 0});
  z.insert(z.end(), {0, 0, 3});
  r.insert(r.end(), {0.5, 0.5, 0});
  for (const double unit : {1.0, 1e-20, 1e20}) {
    Scene scene = four_spheres_scene();
    std::vector<double> of_unit[4] = {x, y, z, r};
    for (std::vector<double>& values : of_unit)
      for (double& value : values) value *= unit;
    scene.spheres = SphereSet::from_world(of_unit[0], of_unit[1], of_unit[2], of_unit[3]).value();
    scene.material_of_sphere.clear();
    scene.materials = {transparent_material()};
    scene.materials[0].reflective = 0.2;
    scene.plane.reset();
    scene.camera.eye = unit * Vec3d{1, 2, 9};
    scene.camera.look_at = {};
    scene.lights = {{unit * Vec3d{10, 20, 30}}};
    RenderSettings settings;
    settings.width_px = 60;
    settings.height_px = 50;
    settings.samples_per_pixel = 2;
    for (const OpacityRule rule : {OpacityRule::each_surface, OpacityRule::once, OpacityRule::first}) {
      settings.opacity_rule = rule;
      settings.ambient_occlusion = {2 * unit, 7};
      const Rendered expected = render(scene, Tracer::build(scene, Engine::wide).value(), settings).value();
      for (const int ranks : {2, 5, 40}) {
        const auto here = spread(scene, settings, ranks);
        expect_same(expected, draw(*here, 0, settings), std::to_string(unit) + ", " + std::to_string(ranks) + " ranks");
      }
    }
  }
}

// A rank does not know the bodies of others that overlap its own.
TEST(Spread, overlapping_bodies_as_one_are_refused) {
  RenderSettings settings;
  settings.opacity_rule = OpacityRule::as_one;
  EXPECT_FALSE(RanksInProcess::make(four_spheres_scene(), settings, {}, 2, FirstSpheres::in_order));
}

}  // namespace
}  // namespace bihive
