// Pictures drawn wave by wave have the same bits as pictures drawn ray by ray (render/shade/integrator.h), on every
// instruction set.
// ctest: kernel *cut
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "bihive/geometry/stick_set.h"
#include "bihive/math/rng.h"
#include "bihive/render/renderer.h"
#include "bihive/render/shade/integrator.h"
#include "bihive/render/shade/wave/wave_integrator.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/lens_pattern.h"
#include "bihive/simd/target.h"
#include "support/effects_reference.h"
#include "support/effort.h"
#include "support/random_scene.h"

namespace bihive {
namespace {

// The picture by the readable code, pixel after pixel.
struct Expected {
  Film film;
  RenderCounts rays;
};

Expected one_after_the_other(const Scene& scene, const RenderSettings& settings) {
  const Tracer tracer = Tracer::build(scene, Engine::reference).value();
  const PixelRays pixels(scene.camera, settings.width_px, settings.height_px);
  std::optional<AmbientRays> ambient;
  if (settings.ambient_occlusion) ambient.emplace(*settings.ambient_occlusion, settings.samples_per_pixel);
  const LightPointSets points(settings.light_points, settings.samples_per_pixel);
  const Transparency transparency = Transparency::of(scene, settings.opacity_rule, Engine::brute, 1).value();
  Integrator integrator(scene, tracer, settings.recursion, settings.shadows, ambient ? &*ambient : nullptr, &points,
                        &transparency);
  const test::EffectsReference effects(scene, tracer, settings, transparency.to_eye.get());
  const std::vector<CameraSample> samples = camera_samples(settings.samples_per_pixel);
  Expected expected{Film(settings.width_px, settings.height_px), {}};
  for (int y = 0; y < settings.height_px; ++y)
    for (int x = 0; x < settings.width_px; ++x) {
      Vec3d sum;
      for (int i = 0; i < settings.samples_per_pixel; ++i) {
        const auto& [place, lens] = samples[static_cast<std::size_t>(i)];
        Vec3d light = integrator.radiance(pixels.at(x + place.x, y + place.y, lens), i);
        if (integrator.deepest_hit() > 0) light = toned(light, settings.tone, exposure_factor(settings.tone));
        sum = sum + effects.applied(x + place.x, y + place.y, lens, light);
      }
      expected.film.at(x, y) = to_float(sum / settings.samples_per_pixel);
    }
  expected.rays = integrator.rays();
  return expected;
}

void expect_same(const Expected& expected, const Rendered& rendered, const std::string& what) {
  ASSERT_EQ(rendered.film.radiance.size(), expected.film.radiance.size());
  EXPECT_EQ(std::memcmp(rendered.film.radiance.data(), expected.film.radiance.data(),
                        expected.film.radiance.size() * sizeof(Vec3f)),
            0)
      << what;
  EXPECT_EQ(rendered.rays.primary, expected.rays.primary) << what;
  EXPECT_EQ(rendered.rays.shadow, expected.rays.shadow) << what;
  EXPECT_EQ(rendered.rays.reflected, expected.rays.reflected) << what;
  EXPECT_EQ(rendered.rays.transmitted, expected.rays.transmitted) << what;
  EXPECT_EQ(rendered.rays.ambient, expected.rays.ambient) << what;
}

// Steps from one seed to the next, so that only a part is tested if all would take too long. Each step is coprime to
// its modulus.
std::uint64_t step() {
  return test::ray_share() > 1 ? 11 : 1;
}

class BestTargetAgain {
 public:
  ~BestTargetAgain() { (void)use_target(""); }
};

TEST(Wave, pictures_are_those_of_one_ray_after_the_other) {
  const BestTargetAgain restore;
  for (std::uint64_t seed = 1; seed <= 60; seed += step()) {
    const Scene scene = test::random_scene(seed);
    RenderSettings settings = test::random_settings(seed);
    const Expected expected = one_after_the_other(scene, settings);
    for (const Engine engine : {Engine::wide, Engine::reference}) {
      const Tracer tracer = Tracer::build(scene, engine).value();
      for (const std::string& target : test::targets_under_test()) {
        ASSERT_TRUE(use_target(target));
        settings.threads = target.size() % 2 == 0 ? 1 : 2;
        const Result<Rendered> rendered = render(scene, tracer, settings);
        ASSERT_TRUE(rendered);
        expect_same(expected, *rendered, scene.name + " on " + target);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

// Between the first spheres of the scene, in a chain; as thick as the first sphere, or thinner. Then arrows on them, of
// which some have a colour or an opacity of their own.
StickSet chain_of(Scene& scene, std::uint64_t seed) {
  SphereSet& spheres = scene.spheres;
  std::vector<ImagePair> pairs;
  for (std::int32_t i = 0; i + 1 < std::min<std::int64_t>(spheres.size(), 12); ++i) pairs.push_back({{i, i + 1}, {}});
  const double radius = spheres.radius(0) * (seed % 3 == 0 ? 1 : 0.3);
  const auto is_parted = [&](const SpherePair& pair) { return !are_equally_clear(scene, pair[0], pair[1]); };
  StickSet made = StickSet::between(spheres, pairs, radius, is_parted).value();
  std::vector<OwnStick> arrows;
  for (const ImagePair& pair : pairs) {
    const auto [one, other] = pair.pair;
    const Vec3d from = spheres.local_centre(one);
    OwnStick arrow{from, 2.0 * from - spheres.local_centre(other), 2 * radius, 0, one};
    if (one % 2 == 0) arrow.colour = Vec3f{0.25F, 0.5F, 0.125F * static_cast<float>(one % 8)};
    if (seed % 2 == 1 && one % 3 == 0) arrow.opacity = 0.3F;
    arrows.push_back(arrow);
  }
  EXPECT_TRUE(made.add(spheres, arrows));
  return made;
}

// Half of the scenes let light through, by all rules.
TEST(Wave, sticks_are_those_of_one_ray_after_the_other) {
  const BestTargetAgain restore;
  std::int64_t on_sticks = 0, on_clear_sticks = 0;
  for (std::uint64_t seed = 401; seed <= 448; seed += step()) {
    Scene scene = test::random_scene(seed);
    if (scene.spheres.size() < 3 || !(scene.spheres.radius(0) > 0)) continue;
    if (seed % 2 == 0) {
      for (Material& material : scene.materials) material.transmissive = 0;
      scene.spheres.attributes().opacity.clear();
      scene.clips.clear();
    }
    scene.sticks = chain_of(scene, seed);
    RenderSettings settings = test::random_settings(seed);
    if (seed % 6 == 1) settings.opacity_rule = OpacityRule::as_one;
    const Expected expected = one_after_the_other(scene, settings);
    for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
      const Tracer tracer = Tracer::build(scene, engine).value();
      for (const std::string& target : test::targets_under_test()) {
        ASSERT_TRUE(use_target(target));
        const Result<Rendered> rendered = render(scene, tracer, settings);
        ASSERT_TRUE(rendered);
        expect_same(expected, *rendered, scene.name + " on " + target);
        if (::testing::Test::HasFailure()) return;
      }
      const PixelRays pixels(scene.camera, settings.width_px, settings.height_px);
      for (int y = 0; y < settings.height_px; ++y)
        for (int x = 0; x < settings.width_px; ++x) {
          const std::int64_t id = tracer.closest_hit(pixels.at(x + 0.5, y + 0.5)).sphere_id;
          if (id < scene.spheres.size()) continue;
          ++on_sticks;
          on_clear_sticks += shown_material(scene, id).transmissive > 0 ? 1 : 0;
        }
    }
  }
  EXPECT_GT(on_sticks, static_cast<std::int64_t>(1000 / step()));  // fewer scenes, fewer hits
  EXPECT_GT(on_clear_sticks, static_cast<std::int64_t>(100 / step()));
}

TEST(Wave, sticks_are_refused_where_they_would_be_wrong) {
  Scene scene = test::random_scene(3);
  for (Material& material : scene.materials) material.transmissive = 0;
  scene.spheres.attributes().opacity.clear();
  scene.sticks = chain_of(scene, 3);
  const RenderSettings settings = test::random_settings(3);
  const Tracer tracer = Tracer::build(scene, Engine::reference).value();
  EXPECT_FALSE(render(scene, Tracer::build(scene.spheres, Engine::reference).value(), settings));
  RenderSettings of_tree = settings;
  of_tree.view = View::traversal;
  of_tree.transparent = false;
  EXPECT_FALSE(render(scene, tracer, of_tree));
  scene.spheres.attributes().opacity.assign(static_cast<std::size_t>(scene.spheres.size()), 1);
  scene.spheres.attributes().opacity[1] = 0.5F;
  EXPECT_FALSE(Tracer::build(scene, Engine::wide));
  EXPECT_FALSE(render(scene, tracer, settings));
}

TEST(Wave, planes_that_show_shadows_alone) {
  const BestTargetAgain restore;
  std::int64_t darker = 0;
  for (std::uint64_t seed = 307; seed <= 346; seed += step()) {
    Scene scene = test::random_scene(seed);
    if (!scene.plane) scene.plane = thesis_plane();
    scene.plane->shadows_only = true;
    scene.background = {0.9, 0.7, 0.5};
    RenderSettings settings = test::random_settings(seed);
    settings.shadows = settings.shadows || !settings.ambient_occlusion;
    const Expected expected = one_after_the_other(scene, settings);
    for (const Engine engine : {Engine::wide, Engine::reference}) {
      const Tracer tracer = Tracer::build(scene, engine).value();
      for (const std::string& target : test::targets_under_test()) {
        ASSERT_TRUE(use_target(target));
        const Result<Rendered> rendered = render(scene, tracer, settings);
        ASSERT_TRUE(rendered);
        expect_same(expected, *rendered, scene.name + " on " + target);
        if (::testing::Test::HasFailure()) return;
      }
    }
    Scene without = scene;
    without.plane.reset();
    const Expected empty = one_after_the_other(without, settings);
    for (std::size_t i = 0; i < expected.film.radiance.size(); ++i)
      darker += expected.film.radiance[i].x < empty.film.radiance[i].x ? 1 : 0;
  }
  // Of the scenes that are tested in part, seed 318 alone has some 400 such pixels.
  EXPECT_GT(darker, step() > 1 ? 300 : 1000);
}

// A picture is rounded to binary32, which hides another order of a sum; so compare before the rounding.
TEST(Wave, sums_are_the_same_before_they_are_rounded) {
  const BestTargetAgain restore;
  const int width = 40, height = 20;
  for (std::uint64_t seed = 101; seed <= 130; seed += step()) {
    Scene scene = test::random_scene(seed);
    for (Material& material : scene.materials) {
      material.reflective = 0.3;
      material.transmissive = 0.4;
      material.refraction_index = 1.2;
    }
    const PixelRays pixels(scene.camera, width, height);
    const bool shadows = seed % 2 == 0;
    const int recursion = seed % 3 == 0 ? 1 : 5;
    const Tracer reference = Tracer::build(scene, Engine::reference).value();
    Integrator integrator(scene, reference, recursion, shadows);
    std::vector<Vec3d> expected;
    for (int i = 0; i < width * height; ++i)
      expected.push_back(integrator.radiance(pixels.at(i % width + 0.5, i / width + 0.5)));

    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    const WaveScene wave_scene(scene);
    for (const std::string& target : test::targets_under_test()) {
      ASSERT_TRUE(use_target(target));
      WaveBuffers buffers;
      Wave& wave = WaveIntegrator::primaries(buffers);
      wave.reset(width * height);
      wave.starts_at_eye = true;
      wave.count = width * height;
      for (int i = 0; i < width * height; ++i) {
        const Ray ray = pixels.at(i % width + 0.5, i / width + 0.5);
        for (int axis = 0; axis < 3; ++axis) {
          wave.origin[axis][i] = ray.origin[axis];
          wave.direction[axis][i] = ray.direction[axis];
        }
      }
      WaveIntegrator waves(wave_scene, tracer, {recursion, true, shadows, false}, nullptr);
      waves.trace(buffers, wave.count);
      for (int i = 0; i < width * height; ++i) {
        const Vec3d sum = buffers.sums.at(i);
        ASSERT_EQ(std::memcmp(&sum, &expected[static_cast<std::size_t>(i)], sizeof sum), 0)
            << scene.name << " on " << target << ", ray " << i;
      }
    }
  }
}

// A pixel with more samples than a wave has rays, and than there are sets of directions.
TEST(Wave, ambient_occlusion_of_many_samples) {
  const Scene scene = test::random_scene(3);
  RenderSettings settings;
  settings.width_px = 5;
  settings.height_px = 9;
  settings.samples_per_pixel = 1000;
  settings.recursion = 1;
  settings.ambient_occlusion = {4.0, 2};
  const Expected expected = one_after_the_other(scene, settings);
  expect_same(expected, render(scene, Tracer::build(scene, Engine::wide).value(), settings).value(), "many samples");
}

// One pass shades primary rays without shadows; the last vector of a tile is rarely full.
TEST(Wave, primary_rays_alone_with_unfilled_vectors) {
  const BestTargetAgain restore;
  constexpr std::array<std::array<int, 2>, 6> kSizes{{{1, 1}, {3, 1}, {2, 3}, {7, 5}, {13, 11}, {17, 9}}};
  for (std::uint64_t seed = 201; seed <= 248; seed += step()) {
    const Scene scene = test::random_scene(seed);
    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    RenderSettings settings;
    settings.width_px = kSizes[seed % kSizes.size()][0];
    settings.height_px = kSizes[seed % kSizes.size()][1];
    settings.samples_per_pixel = seed % 4 == 0 ? 3 : 1;
    settings.recursion = 1;
    settings.shadows = false;
    settings.threads = 1;
    const Expected expected = one_after_the_other(scene, settings);
    for (const std::string& target : test::targets_under_test()) {
      ASSERT_TRUE(use_target(target));
      // Data of an earlier picture in the thread's memory must not matter.
      Scene before = scene;
      before.plane = thesis_plane();
      RenderSettings normals = settings;
      normals.view = View::normal;
      normals.width_px = normals.height_px = 40;
      ASSERT_TRUE(render(before, tracer, normals));
      expect_same(expected, render(scene, tracer, settings).value(), scene.name + " on " + target);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(Wave, generations_that_grow_too_large_are_cut) {
  // Every surface sends two rays, sixteen generations deep: many more at once than a piece may hold.
  Scene scene = four_spheres_scene();
  for (Material& material : scene.materials) {
    material.reflective = 0.4;
    material.transmissive = 0.5;
    material.refraction_index = 1.3;
  }
  // From inside a sphere around everything, every ray hits something.
  scene.plane.reset();
  scene.spheres =
      SphereSet::from_world(std::vector<double>{0, 0, 3, -4}, {0, 0, 1, 2}, {0, 0, 5, -5}, {20, 30, 3, 4}).value();
  scene.material_of_sphere = {0, 1, 1, 0};
  scene.camera.eye = {0, 0, 15};
  RenderSettings settings;
  settings.width_px = 16;
  settings.height_px = 9;
  settings.samples_per_pixel = 1;
  settings.recursion = 16;
  const Expected expected = one_after_the_other(scene, settings);
  ASSERT_GT(expected.rays.reflected, 4 * kMostRaysAtOnce);
  for (const Engine engine : {Engine::wide, Engine::reference}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    settings.threads = engine == Engine::wide ? 2 : 1;
    expect_same(expected, render(scene, tracer, settings).value(), "two rays a surface");
  }
}

TEST(Wave, pixels_of_very_many_samples_are_cut) {
  const Scene scene = four_spheres_scene();
  RenderSettings settings;
  settings.width_px = 9;
  settings.height_px = 5;
  settings.samples_per_pixel = 2500;
  settings.recursion = 2;
  const Expected expected = one_after_the_other(scene, settings);
  ASSERT_GT(expected.rays.primary, 3 * kMostRaysAtOnce);
  const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
  for (settings.threads = 1; settings.threads <= 2; ++settings.threads)
    expect_same(expected, render(scene, tracer, settings).value(), "2500 samples");
}

TEST(Wave, large_pictures_of_the_scenarios) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed}) {
    const Scene scene = scenario_scene(scenario, {1000, 1, 1}).value();
    const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
    RenderSettings settings;
    settings.width_px = 231;
    settings.height_px = 193;
    settings.samples_per_pixel = 1;
    const Expected expected = one_after_the_other(scene, settings);
    expect_same(expected, render(scene, tracer, settings).value(), scene.name);
  }
}

TEST(Wave, draws_into_the_film_that_it_is_given) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
  RenderSettings settings;
  settings.width_px = 70;
  settings.height_px = 50;
  Film old(70, 50);
  for (Vec3f& pixel : old.radiance) pixel = {7, 7, 7};
  const Vec3f* const memory = old.radiance.data();
  const Result<Rendered> rendered = render(scene, tracer, settings, {}, nullptr, std::move(old));
  EXPECT_EQ(rendered->film.radiance.data(), memory);
  expect_same(one_after_the_other(scene, settings), *rendered, "into an old film");
}

}  // namespace
}  // namespace bihive
