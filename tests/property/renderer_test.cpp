// The same picture bit for bit: with any number of threads, with tree or brute force, and with trees of any parameters.
#include "bihive/render/renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <mutex>

#include "bihive/scene/generators.h"

namespace bihive {
namespace {

RenderSettings small(const Scene& scene, View view, int threads) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = 70;
  settings.height_px = 50;
  settings.samples_per_pixel = 2;
  settings.view = view;
  settings.threads = threads;
  return settings;
}

void expect_same_bits(const Film& a, const Film& b) {
  ASSERT_EQ(a.radiance.size(), b.radiance.size());
  EXPECT_EQ(std::memcmp(a.radiance.data(), b.radiance.data(), a.radiance.size() * sizeof(Vec3f)), 0);
}

class EveryScene : public ::testing::TestWithParam<int> {
 protected:
  Scene scene() const {
    if (GetParam() == 4) return four_spheres_scene();
    return scenario_scene(static_cast<Scenario>(GetParam()), {150, 2, 3}).value();
  }
};

TEST_P(EveryScene, threads_do_not_show) {
  const Scene drawn = scene();
  const Tracer tracer = Tracer::build(drawn.spheres, Engine::reference).value();
  for (const View view : {View::shaded, View::recursion, View::traversal, View::normal, View::distance, View::id}) {
    const Result<Rendered> one = render(drawn, tracer, small(drawn, view, 1));
    for (const int threads : {2, 7}) {
      const Result<Rendered> many = render(drawn, tracer, small(drawn, view, threads));
      expect_same_bits(one->film, many->film);
      EXPECT_EQ(one->rays.reflected, many->rays.reflected);
      EXPECT_EQ(one->rays.primary, 70 * 50 * 2);
    }
  }
}

TEST_P(EveryScene, brute_force_and_every_tree_agree) {
  Scene drawn = scene();
  for (const bool shadows : {false, true}) {
    drawn.picture.shadows = shadows;
    for (const View view : {View::shaded, View::recursion, View::normal, View::distance, View::id}) {
      const Tracer brute = Tracer::build(drawn.spheres, Engine::brute).value();
      const Result<Rendered> expected = render(drawn, brute, small(drawn, view, 2));
      for (const BuildParameters parameters :
           {BuildParameters{1, kUnlimited}, {8, kUnlimited}, {1, 3}, {kUnlimited, kUnlimited}}) {
        const Tracer tracer = Tracer::build(drawn.spheres, Engine::reference, parameters).value();
        expect_same_bits(expected->film, render(drawn, tracer, small(drawn, view, 2))->film);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(scenes, EveryScene, ::testing::Values(1, 2, 3, 4));

TEST_P(EveryScene, ambient_occlusion_is_the_same_by_every_engine_and_on_any_number_of_threads) {
  const Scene drawn = scene();
  RenderSettings settings = small(drawn, View::shaded, 1);
  settings.ambient_occlusion = {6, 7};
  const Film expected = render(drawn, Tracer::build(drawn.spheres, Engine::brute).value(), settings)->film;
  for (const Engine engine : {Engine::reference, Engine::wide})
    for (const int threads : {1, 2, 7}) {
      settings.threads = threads;
      expect_same_bits(expected, render(drawn, Tracer::build(drawn.spheres, engine).value(), settings)->film);
    }
}

TEST(Renderer, a_picture_in_other_units_is_the_same_picture) {
  // Everything times a power of two: every step scales exactly.
  const auto draw = [](double unit) {
    Scene scene = thesis_scene_without_spheres();
    scene.plane.reset();
    std::vector<double> x{-8, 8, 0, 2}, y{-10, -10, 4, -9}, z{-4, -4, -6, 12}, r{7.5, 7.5, 7.5, 5};
    for (std::vector<double>* values : {&x, &y, &z, &r})
      for (double& value : *values) value *= unit;
    scene.spheres = SphereSet::from_world(x, y, z, r).value();
    scene.material_of_sphere = {0, 0, 0, 1};
    scene.camera.eye = scene.camera.eye * unit;
    scene.lights[0].position = scene.lights[0].position * unit;
    const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
    return render(scene, tracer, small(scene, View::shaded, 1)).value().film;
  };
  const Film expected = draw(1);
  expect_same_bits(expected, draw(0x1p-66));
  expect_same_bits(expected, draw(0x1p66));
}

TEST(Renderer, progress_ends_at_1_and_cancelling_stops) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  double last = 0;
  const auto watch = [&](double done) { last = std::max(last, done); };
  ASSERT_TRUE(render(scene, tracer, small(scene, View::distance, 1), watch));
  EXPECT_EQ(last, 1);

  CancelToken cancel;
  int calls = 0;
  const auto stop = [&](double) {
    ++calls;
    cancel.cancel();
  };
  EXPECT_FALSE(render(scene, tracer, small(scene, View::shaded, 1), stop, &cancel));
  EXPECT_EQ(calls, 1);
}

TEST(Renderer, the_traversal_view_needs_a_tree) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::brute).value();
  EXPECT_FALSE(render(scene, tracer, small(scene, View::traversal, 1)));
}

}  // namespace
}  // namespace bihive
