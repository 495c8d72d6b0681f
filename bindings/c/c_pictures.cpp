// Scenes and pictures of bihive.h.
#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive.h"
#include "bihive/base/near_name.h"
#include "bihive/image/png_pixels.h"
#include "bihive/image/transfer.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/framing_cell.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/names.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/title_text.h"
#include "bihive/settings/check_picture.h"
#include "bihive/settings/overrides.h"
#include "bihive/settings/parameter_text.h"
#include "c_errors.h"
#include "c_spheres.h"

/// A scene, the tracer of its spheres, and the side from which to look at them. The tracer refers to the scene.
struct bihive_scene {
  bihive::LoadedScene loaded;
  std::optional<bihive::Tracer> tracer;
  std::optional<bihive::ViewFrom> side;
  bihive::Overrides user;
  std::mutex in_use;  // each picture places the camera and the lights anew
};

namespace bihive::c {
namespace {

Result<Style> style_or_default(const char* name) {
  return style_named(name == nullptr ? style_names().front() : std::string_view(name));
}

int take_scene(LoadedScene loaded, bihive_scene** scene) {
  auto made = std::make_unique<bihive_scene>();
  made->loaded = std::move(loaded);
  auto tracer = Tracer::build(made->loaded.scene, Engine::automatic);
  if (!tracer) return fail(tracer.error());
  made->tracer.emplace(std::move(*tracer));
  *scene = made.release();
  return kDone;
}

// The camera that shows everything.
Camera fitted_camera(const Scene& scene, const PictureSettings& picture, const Side& side, int width, int height) {
  const Lens lens{scene.camera.fov_deg, scene.camera.projection};
  const RemainingSpheres remaining(scene);
  Camera camera = picture.cell_lines ? frame_with_cell(remaining.set(), side, lens, width, height)
                                     : frame_spheres(remaining.set(), side, lens, width, height);
  camera.aperture = scene.camera.aperture;
  camera.focus = scene.camera.focus;
  return camera;
}

// As the user placed them, else around everything.
void place_camera_and_lights(bihive_scene& of, const PictureSettings& picture, int width, int height) {
  Scene& scene = of.loaded.scene;
  if (of.side || !of.loaded.has_camera)
    scene.camera = fitted_camera(scene, picture, side_of(of.side.value_or(ViewFrom::front)), width, height);
  if (!of.loaded.has_lights) scene.lights = lights_around(of.loaded.rig, scene.camera);
}

int check_picture(const bihive_scene* scene, int width, int height, int samples, int threads,
                  const std::uint8_t* rgba) {
  constexpr int kMostPixels = 65535;
  constexpr int kMostSamples = 4096;
  if (scene == nullptr) return fail("the scene is NULL");
  if (rgba == nullptr) return fail("there is no place for the picture");
  if (width < 1 || width > kMostPixels || height < 1 || height > kMostPixels)
    return fail("width and height must be from 1 to 65535");
  if (samples < 0 || samples > kMostSamples) return fail("samples must be from 1 to 4096, or 0 for the scene's");
  if (threads < 0) return fail("the number of threads is negative; 0 takes all");
  return kDone;
}

void write_rgba(const PngPixels& pixels, std::uint8_t* rgba) {
  const auto channels = static_cast<std::size_t>(pixels.channels);
  const std::size_t count = pixels.bytes.size() / channels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const from = pixels.bytes.data() + channels * i;
    std::copy(from, from + 3, rgba + 4 * i);
    rgba[4 * i + 3] = channels == 4 ? from[3] : 255;
  }
}

}  // namespace
}  // namespace bihive::c

using namespace bihive;     // NOLINT(google-build-using-namespace): the functions below are C's
using namespace bihive::c;  // NOLINT(google-build-using-namespace)

int bihive_scene_new(const double* xyz, const double* radii, const uint8_t* rgb, int64_t count, const char* style,
                     bihive_scene** scene) {
  if (scene == nullptr) return fail("there is no place for the scene");
  *scene = nullptr;
  return guarded([&] {
    if (count < 1) return fail("a scene needs at least one sphere");
    if (xyz == nullptr || radii == nullptr) return fail("the spheres are NULL");
    const auto look = style_or_default(style);
    if (!look) return fail(look.error());
    auto spheres = spheres_of(xyz, radii, count);
    if (!spheres) return fail(spheres.error());
    SphereFile file;
    file.spheres = std::move(*spheres);
    if (rgb != nullptr) {
      std::vector<Vec3f>& colour = file.spheres.attributes().colour;
      colour.resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < colour.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
          colour[i][axis] =
              static_cast<float>(linear_from_srgb(double(rgb[3 * i + static_cast<std::size_t>(axis)]) / 255));
    }
    return take_scene(scene_of_spheres(std::move(file), "arrays", &*look), scene);
  });
}

int bihive_scene_from_bytes(const char* bytes, size_t size, const char* name, const char* style, bihive_scene** scene) {
  if (scene == nullptr) return fail("there is no place for the scene");
  *scene = nullptr;
  return guarded([&] {
    if (bytes == nullptr || name == nullptr) return fail("the bytes or their name are NULL");
    const auto look = style_or_default(style);
    if (!look) return fail(look.error());
    auto loaded = load_scene(std::string_view(bytes, size), name, {}, LooksOfFile::apply, &*look);
    if (!loaded) return fail(loaded.error());
    return take_scene(std::move(*loaded), scene);
  });
}

void bihive_scene_free(bihive_scene* scene) {
  delete scene;
}

int bihive_scene_view_from(bihive_scene* scene, const char* side) {
  return guarded([&] {
    if (scene == nullptr || side == nullptr) return fail("the scene or the side is NULL");
    const ViewFrom* const found = value_named(kSides, side);
    if (found == nullptr) return fail("unknown side; known are front, back, left, right, top, bottom and iso");
    const std::lock_guard<std::mutex> lock(scene->in_use);
    scene->side = *found;
    return kDone;
  });
}

int bihive_scene_set(bihive_scene* scene, const char* name, const char* value) {
  return guarded([&] {
    if (scene == nullptr || name == nullptr) return fail("the scene or the name is NULL");
    const Parameter* const parameter = parameter_named(name);
    if (parameter == nullptr) {
      std::vector<std::string> ids;
      for (const Parameter& row : picture_parameters()) ids.emplace_back(row.id);
      const std::string near = near_name(name, ids);
      return fail(Error{"there is no parameter \"" + std::string(name) + "\"", "", 0, 0,
                        near.empty() ? "docs/settings.md lists them" : "did you mean " + near + "?"});
    }
    if (parameter->id == "width_px" || parameter->id == "height_px")
      return fail("width and height are arguments of bihive_render()");
    const std::lock_guard<std::mutex> lock(scene->in_use);
    if (value == nullptr) {
      scene->user.reset(parameter->id);
      return kDone;
    }
    const Result<SettingValue> parsed = value_from_text(*parameter, value);
    if (!parsed) return fail(Error{std::string(name) + ": " + parsed.error().message, "", 0, 0, ""});
    scene->user.set(parameter->id, *parsed);
    return kDone;
  });
}

int bihive_render(bihive_scene* scene, int width, int height, int samples, int threads, uint8_t* rgba) {
  return guarded([&] {
    if (check_picture(scene, width, height, samples, threads, rgba) != kDone) return kFailed;
    const std::lock_guard<std::mutex> lock(scene->in_use);
    PictureSettings picture = scene->loaded.scene.picture;
    scene->user.apply_to(picture);
    if (const Status status = bihive::check_picture(picture, scene->loaded.scene.camera.aperture); !status)
      return fail(status.error());
    if (scene->user.is_on("cell") && !scene->loaded.scene.spheres.cell())
      return fail("cell: the spheres have no periodic cell");
    place_camera_and_lights(*scene, picture, width, height);
    const Scene& drawn = scene->loaded.scene;
    RenderSettings settings = settings_from(picture);
    settings.width_px = width;
    settings.height_px = height;
    settings.threads = threads;
    if (samples > 0) {
      settings.adaptive_samples = false;
      settings.samples_per_pixel = samples;
    }
    if (Status status = check_picture_memory(width, height); !status) return fail(status.error());
    Result<std::string> title = fill_title(settings.labels.title, {{"spheres", double(drawn.spheres.size())}});
    if (!title) return fail(title.error());
    settings.labels.title = *title;
    if (Status status = check_labels(drawn, settings); !status) return fail(status.error());
    const auto rendered = render(drawn, *scene->tracer, settings);
    if (!rendered) return fail(rendered.error());
    PngPixels pixels = png_pixels_from_film(rendered->film, settings.transfer, 8, threads);
    draw_labels(pixels, drawn, settings);
    write_rgba(pixels, rgba);
    return kDone;
  });
}
