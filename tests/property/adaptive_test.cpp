// Adaptive samples: a picture has the bits of a reference that decides and draws pixel after pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/render/shade/integrator.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/lens_pattern.h"
#include "support/effects_reference.h"
#include "support/effort.h"

namespace bihive {
namespace {

// Pixels as docs/pictures.md defines them.
class Reference {
 public:
  Reference(const Scene& scene, const Tracer& tracer, const RenderSettings& settings)
      : scene_(scene),
        tracer_(tracer),
        settings_(settings),
        pixels_(scene.camera, settings.width_px, settings.height_px),
        effects_(scene, tracer, settings) {}

  Film picture() const {
    std::vector<Pixel> few;
    for (int y = 0; y < settings_.height_px; ++y)
      for (int x = 0; x < settings_.width_px; ++x) few.push_back(pixel(x, y, 4));
    Film film;
    film.resize(settings_.width_px, settings_.height_px, settings_.transparent);
    for (int y = 0; y < film.height; ++y)
      for (int x = 0; x < film.width; ++x) {
        const std::size_t at = film.number_of(x, y);
        const Pixel chosen = on_edge(few, x, y) ? pixel(x, y, 16) : few[at];
        film.radiance[at] = chosen.light;
        if (settings_.transparent) film.coverage[at] = chosen.coverage;
      }
    return film;
  }

 private:
  struct Pixel {
    Vec3f light{0, 0, 0};
    float coverage = 0;
    bool samples_differ = false;
  };

  static double shown(double light) { return std::sqrt(std::clamp(light, 0.0, 1.0)); }

  static bool differ(const Pixel& a, const Pixel& b) {
    double most = std::abs(double(a.coverage) - double(b.coverage));
    for (int channel = 0; channel < 3; ++channel)
      most = std::max(most, std::abs(shown(double(a.light[channel])) - shown(double(b.light[channel]))));
    return most > 1.0 / 8;
  }

  bool on_edge(const std::vector<Pixel>& few, int x, int y) const {
    const auto at = [&](int px, int py) {
      return few[static_cast<std::size_t>(py) * std::size_t(settings_.width_px) + std::size_t(px)];
    };
    if (at(x, y).samples_differ) return true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (x + dx >= 0 && x + dx < settings_.width_px && y + dy >= 0 && y + dy < settings_.height_px &&
            differ(at(x, y), at(x + dx, y + dy)))
          return true;
    return false;
  }

  Pixel pixel(int x, int y, int count) const {
    std::optional<AmbientRays> ambient;
    if (settings_.ambient_occlusion) ambient.emplace(*settings_.ambient_occlusion, count);
    const LightPointSets points(settings_.light_points, count);
    Integrator integrator(scene_, tracer_, settings_.recursion, settings_.shadows, ambient ? &*ambient : nullptr,
                          &points);
    Vec3d sum;
    int hits = 0;
    std::vector<Vec3d> lights;
    const std::vector<CameraSample> samples = camera_samples(count);
    for (int i = 0; i < count; ++i) {
      const auto& [place, lens] = samples[static_cast<std::size_t>(i)];
      Vec3d light = integrator.radiance(pixels_.at(x + place.x, y + place.y, lens), i);
      const bool hit = integrator.deepest_hit() > 0;
      if (hit) light = toned(light, settings_.tone, exposure_factor(settings_.tone));
      if (settings_.transparent && !hit) continue;
      light = effects_.applied(x + place.x, y + place.y, lens, light);
      lights.push_back(light);
      sum = sum + light;
      ++hits;
    }
    Pixel made;
    if (hits > 0) made.light = to_float(sum / hits);
    if (settings_.transparent) made.coverage = static_cast<float>(double(hits) / count);
    made.samples_differ = hits != 0 && hits != count;
    for (const Vec3d& a : lights)
      for (const Vec3d& b : lights)
        for (int channel = 0; channel < 3; ++channel)
          if (shown(a[channel]) - shown(b[channel]) > 1.0 / 16) made.samples_differ = true;
    return made;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  RenderSettings settings_;
  PixelRays pixels_;
  test::EffectsReference effects_;
};

Scene scene_of(std::uint64_t seed) {
  Scene scene = seed % 4 == 3 ? four_spheres_scene()
                              : scenario_scene(static_cast<Scenario>(1 + seed % 4), {100, 2, seed}).value();
  if (seed % 3 == 1) scene.lights[0].radius = 5;
  if (seed % 3 == 2) scene.plane.reset();
  if (seed % 5 == 1) scene.camera.aperture = 3;
  if (seed % 2 == 1) scene.background = {0.7, 0.8, 1};
  return scene;
}

TEST(AdaptiveSamples, pictures_are_those_of_one_pixel_after_the_other) {
  for (std::uint64_t seed = 1; seed <= 24; seed += test::ray_share() > 1 ? 7 : 1) {
    const Scene scene = scene_of(seed);
    RenderSettings settings;
    settings.adaptive_samples = true;
    settings.width_px = 20 + static_cast<int>(seed * 7 % 61);
    settings.height_px = 3 + static_cast<int>(seed * 11 % 37);
    settings.recursion = 1 + static_cast<int>(seed % 3);
    settings.shadows = seed % 4 != 0;
    settings.light_points = 2;
    settings.transparent = seed % 3 == 0;
    if (seed % 5 == 0) settings.ambient_occlusion = {9.0, 3};
    if (seed % 4 == 2) settings.outline = Outline{1.5, 0.3, {0.2, 0, 0.1}};
    if (seed % 6 < 2) settings.fog = Fog{0.1, 0.8, 0.7};
    if (seed % 7 < 4) settings.tone = {0.8, static_cast<ToneCurve>(seed % 3)};
    const Tracer reference = Tracer::build(scene.spheres, Engine::reference).value();
    const Film expected = Reference(scene, reference, settings).picture();
    const Tracer wide = Tracer::build(scene.spheres, Engine::wide).value();
    for (const Tracer* tracer : {&reference, &wide})
      for (const int threads : {1, 2, 7}) {
        settings.threads = threads;
        const Film film = render(scene, *tracer, settings).value().film;
        ASSERT_EQ(std::memcmp(film.radiance.data(), expected.radiance.data(), film.radiance.size() * sizeof(Vec3f)), 0)
            << "seed " << seed << ", " << threads << " threads";
        ASSERT_EQ(film.coverage, expected.coverage) << "seed " << seed;
      }
    const std::uint64_t number = seed % 5;
    settings.crop =
        Tile{static_cast<int>(number), static_cast<int>(number % 3), settings.width_px - 7, settings.height_px};
    const Film part = render(scene, wide, settings).value().film;
    const Film cut = part_of(expected, *settings.crop);
    ASSERT_EQ(std::memcmp(part.radiance.data(), cut.radiance.data(), cut.radiance.size() * sizeof(Vec3f)), 0) << seed;
  }
}

}  // namespace
}  // namespace bihive
