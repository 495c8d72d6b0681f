// The same picture bit for bit: with any number of threads, with tree or brute force, and with trees of any parameters.
// ctest: threads
#include "bihive/render/renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
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

TEST_P(EveryScene, a_part_has_the_bits_of_the_whole_picture) {
  const Scene drawn = scene();
  for (const Engine engine : {Engine::reference, Engine::wide}) {
    const Tracer tracer = Tracer::build(drawn.spheres, engine).value();
    for (const View view :
         {View::shaded, View::recursion, View::traversal, View::normal, View::distance, View::id, View::tree}) {
      if (engine == Engine::wide && (view == View::traversal || view == View::tree)) continue;
      for (const int samples : {1, 3}) {
        RenderSettings settings = small(drawn, view, 2);
        settings.samples_per_pixel = samples;
        settings.shadows = true;
        settings.recursion = 3;
        if (samples == 3) settings.ambient_occlusion = {6, 5};
        const Film whole = render(drawn, tracer, settings)->film;
        for (const Tile& part : {Tile{0, 0, 70, 50}, {1, 2, 70, 50}, {33, 7, 34, 8}, {5, 9, 65, 48}}) {
          settings.crop = part;
          const Film film = render(drawn, tracer, settings)->film;
          ASSERT_EQ(film.width, part.width());
          ASSERT_EQ(film.height, part.height());
          expect_same_bits(film, part_of(whole, part));
        }
      }
    }
  }
}

TEST_P(EveryScene, a_transparent_picture_laid_over_the_background_is_the_picture) {
  Scene drawn = scene();
  drawn.plane.reset();
  drawn.background = {0.3, 0.6, 0.9};
  for (const int samples : {1, 4}) {
    RenderSettings settings = small(drawn, View::shaded, 1);
    settings.samples_per_pixel = samples;
    settings.recursion = 3;
    settings.shadows = samples == 4;
    const Film opaque = render(drawn, Tracer::build(drawn.spheres, Engine::brute).value(), settings)->film;
    EXPECT_TRUE(opaque.coverage.empty());
    settings.transparent = true;
    const Film film = render(drawn, Tracer::build(drawn.spheres, Engine::brute).value(), settings)->film;
    ASSERT_EQ(film.coverage.size(), film.radiance.size());
    int partly = 0, none = 0;
    for (std::size_t i = 0; i < film.radiance.size(); ++i) {
      const double share = film.coverage[i];
      ASSERT_EQ(share * samples, std::floor(share * samples));
      partly += share > 0 && share < 1;
      none += share == 0;
      if (share == 0) {
        ASSERT_EQ(film.radiance[i], (Vec3f{0, 0, 0}));
      }
      const Vec3d laid = share * to_double(film.radiance[i]) + (1 - share) * drawn.background;
      ASSERT_NEAR(length(laid - to_double(opaque.radiance[i])), 0, 1e-6) << i;
    }
    EXPECT_EQ(partly > 0, samples > 1);
    EXPECT_GT(none, 0);
    for (const Engine engine : {Engine::reference, Engine::wide})
      for (const int threads : {2, 7}) {
        settings.threads = threads;
        const Film other = render(drawn, Tracer::build(drawn.spheres, engine).value(), settings)->film;
        expect_same_bits(film, other);
        EXPECT_EQ(film.coverage, other.coverage);
      }
    for (const View view : {View::recursion, View::normal, View::distance, View::id}) {
      settings.view = view;
      EXPECT_EQ(render(drawn, Tracer::build(drawn.spheres, Engine::wide).value(), settings)->film.coverage,
                film.coverage);
    }
    settings.view = View::shaded;
    settings.crop = Tile{9, 5, 60, 44};
    const Film part = render(drawn, Tracer::build(drawn.spheres, Engine::wide).value(), settings)->film;
    expect_same_bits(part, part_of(film, *settings.crop));
    EXPECT_EQ(part.coverage, part_of(film, *settings.crop).coverage);
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

TEST(Renderer, views_of_the_tree_are_never_transparent) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  for (const View view : {View::traversal, View::tree}) {
    RenderSettings settings = small(scene, view, 1);
    settings.transparent = true;
    EXPECT_FALSE(render(scene, tracer, settings));
  }
}

TEST(Renderer, the_traversal_view_needs_a_tree) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::brute).value();
  EXPECT_FALSE(render(scene, tracer, small(scene, View::traversal, 1)));
}

}  // namespace
}  // namespace bihive
