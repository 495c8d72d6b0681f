// A scene file through to a picture of 16 x 16 pixels: every engine draws the same bits, or refuses.
#include <string_view>

#include "bihive/render/renderer.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/scene_file.h"
#include "engines.h"

namespace {

// Brute force bounds the work: that many spheres and lights, and few samples.
constexpr std::int64_t kMostSpheres = 300;
constexpr std::size_t kMostLights = 4;

bihive::RenderSettings small_settings(const bihive::Scene& scene) {
  bihive::RenderSettings settings = bihive::settings_from(scene.picture);
  settings.width_px = settings.height_px = 16;
  settings.samples_per_pixel = std::min(settings.samples_per_pixel, 2);
  settings.recursion = std::min(settings.recursion, 4);
  settings.light_points = std::min(settings.light_points, 2);
  if (settings.ambient_occlusion)
    settings.ambient_occlusion->directions = std::min(settings.ambient_occlusion->directions, 4);
  settings.threads = 1;
  return settings;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  Result<LoadedScene> loaded = parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz/none.json", {});
  if (!loaded) {
    fuzz::demand(!loaded.error().message.empty());
    return 0;
  }
  Scene& scene = loaded->scene;
  if (scene.spheres.size() > kMostSpheres || scene.lights.size() > kMostLights) return 0;
  const RenderSettings settings = small_settings(scene);
  if (!loaded->has_camera) scene.camera = frame_spheres(scene.spheres, side_of(ViewFrom::front), {}, 16, 16);
  if (!check_camera(scene.camera)) return 0;
  if (!loaded->has_lights) {
    scene.ambient_light = loaded->rig.ambient_light;
    scene.lights = lights_around(loaded->rig, scene.camera);
  }

  Film expected;
  for (const Engine engine : {Engine::brute, Engine::reference, Engine::wide}) {
    const Result<Tracer> tracer = Tracer::build(scene, engine, {}, 1);
    fuzz::demand(tracer.ok());
    Result<Rendered> rendered = render(scene, *tracer, settings);
    fuzz::demand(rendered.ok());
    if (engine == Engine::brute) {
      expected = std::move(rendered->film);
      continue;
    }
    fuzz::demand(fuzz::same_bytes(rendered->film.radiance, expected.radiance));
    fuzz::demand(fuzz::same_bytes(rendered->film.coverage, expected.coverage));
  }
  return 0;
}
