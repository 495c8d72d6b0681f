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
#include "bihive/base/sha256.h"
#include "bihive/base/version.h"
#include "bihive/image/png_pixels.h"
#include "bihive/image/transfer.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/methods_text.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/render/finished_pixels.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/load_scene.h"
#include "bihive/settings/overrides.h"
#include "bihive/settings/parameter_text.h"
#include "c_errors.h"
#include "c_progress.h"
#include "c_spheres.h"

/// A scene as read, its tree, and its user's settings.
struct bihive_scene {
  bihive::LoadedScene loaded;
  std::optional<bihive::Tracer> tracer;  // refers to `loaded`
  bihive::Scene as_read;                 // without the spheres: the start of each picture
  bihive::Overrides picture;
  std::vector<std::pair<std::string, std::string>> settings;  // ids and values of the other options, in their order
  bihive::PictureRecord source;                               // its bytes, and the program
  std::string style;                                          // empty: none was named
  std::string methods;                                        // the text for the last rendered picture
  std::mutex in_use;                                          // each picture places the camera and the lights again
};

namespace bihive::c {
namespace {

// Options of a picture that another argument takes, or that a picture in memory cannot have.
constexpr std::pair<std::string_view, const char*> kElsewhere[] = {
    {"width_px", "width and height are arguments of bihive_render()"},
    {"height_px", "width and height are arguments of bihive_render()"},
    {"size", "width and height are arguments of bihive_render()"},
    {"crop", "crop: bihive_render() draws whole pictures"},
    {"threads", "threads is an argument of bihive_render()"},
    {"bits", "bits: bihive_render() gives 8 of each colour"},
    {"style", "style is an argument of bihive_scene_new() and bihive_scene_from_bytes()"}};

Result<Style> style_or_default(const char* name) {
  return style_named(name == nullptr ? style_names().front() : std::string_view(name));
}

// The members of a scene that prepare_picture() changes if no setting affects spheres.
void put_light(const Scene& from, Scene& to) {
  to.lights = from.lights;
  to.camera = from.camera;
  to.background = from.background;
  to.ambient_light = from.ambient_light;
  to.picture = from.picture;
}

int take_scene(LoadedScene loaded, const char* style, std::vector<RecordedFile> files, Work* work, double share_before,
               bihive_scene** scene) {
  auto made = std::make_unique<bihive_scene>();
  made->source.version = version();
  made->source.commit = commit();
  made->source.files = std::move(files);
  if (style != nullptr) made->style = style;
  made->loaded = std::move(loaded);
  put_light(made->loaded.scene, made->as_read);
  const Section section(work, share_before, 1);
  auto tracer = Tracer::build(made->loaded.scene, Engine::automatic);
  if (!tracer) return failed(tracer.error());
  made->tracer.emplace(std::move(*tracer));
  *scene = made.release();
  return kDone;
}

// An action on spheres, or `select`.
bool is_of_spheres(std::string_view id) {
  const RequestOption<PictureRequest>* const row = picture_option(id);
  return row != nullptr && row->theme == OptionTheme::spheres && row->repeatable;
}

PictureRequest request_of(const bihive_scene& scene) {
  PictureRequest request;
  request.picture = scene.picture;
  for (const auto& [id, value] : scene.settings) take_setting(request, id, value);
  refuse_settings_of_files(request.input);
  if (request.input.reading.has("replicate")) fail_setting("replicate", " is for scene files here");
  return request;
}

// A flag of the table of options is on or off by its text.
bool is_off(const RequestOption<PictureRequest>& row, const char* value) {
  const std::string_view text(value);
  if (!row.value_name.empty() || text.empty() || text == "true") return false;
  if (text != "false") fail_setting(row.id, ": expected true or false, found \"" + std::string(text) + "\"");
  return true;
}

// An option that is not a parameter of the picture. NULL resets it; for actions on spheres it resets all, because each
// acts on what earlier ones have selected.
void set_option(bihive_scene& scene, const std::string& id, const char* value) {
  const RequestOption<PictureRequest>* const row = picture_option(id);
  const auto before = scene.settings;
  const bool of_spheres = is_of_spheres(id);
  if (value == nullptr || row == nullptr || !row->repeatable)
    std::erase_if(scene.settings, [&](const auto& one) {
      const bool is_counterpart = one.first == "no_" + id || "no_" + one.first == id;
      return one.first == id || is_counterpart || (of_spheres && is_of_spheres(one.first));
    });
  if (value == nullptr) return;
  if (row == nullptr || !is_off(*row, value))
    scene.settings.emplace_back(id, row && row->value_name.empty() ? "" : value);
  else if (const std::string off = "no_" + id; picture_option(off) != nullptr)
    scene.settings.emplace_back(off, "");
  try {
    request_of(scene);
  } catch (...) {
    scene.settings = before;
    throw;
  }
}

int check_picture(const bihive_scene* scene, int width, int height, int samples, int threads,
                  const std::uint8_t* rgba) {
  constexpr int kMostPixels = 65535;
  constexpr int kMostSamples = 4096;
  if (scene == nullptr) return failed("the scene is NULL");
  if (rgba == nullptr) return failed("there is no place for the picture");
  if (width < 1 || width > kMostPixels || height < 1 || height > kMostPixels)
    return failed("width and height must be from 1 to 65535");
  if (samples < 0 || samples > kMostSamples) return failed("samples must be from 1 to 4096, or 0 for the scene's");
  if (threads < 0) return failed("the number of threads is negative; 0 takes all");
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
  if (scene == nullptr) return failed("there is no place for the scene");
  *scene = nullptr;
  return guarded_long([&](Work* work) {
    if (count < 1) return failed("a scene needs at least one sphere");
    if (xyz == nullptr || radii == nullptr) return failed("the spheres are NULL");
    const auto look = style_or_default(style);
    if (!look) return failed(look.error());
    auto spheres = spheres_of(xyz, radii, count);
    if (!spheres) return failed(spheres.error());
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
    return take_scene(scene_of_spheres(std::move(file), "arrays", &*look), style, {}, work, 0, scene);
  });
}

int bihive_scene_from_bytes(const char* bytes, size_t size, const char* name, const char* style, bihive_scene** scene) {
  if (scene == nullptr) return failed("there is no place for the scene");
  *scene = nullptr;
  return guarded_long([&](Work* work) {
    if (bytes == nullptr || name == nullptr) return failed("the bytes or their name are NULL");
    const auto look = style_or_default(style);
    if (!look) return failed(look.error());
    constexpr double kShareOfReading = 0.7;
    std::optional<Section> reading(std::in_place, work, 0, kShareOfReading);
    auto loaded = load_scene(std::string_view(bytes, size), name, {}, LooksOfFile::apply, &*look);
    if (!loaded) return failed(loaded.error());
    reading.reset();
    Sha256 digest;
    digest.add(std::string_view(bytes, size));
    RecordedFile source{kInputFile, without_folder(name), digest.digits()};
    return take_scene(std::move(*loaded), style, {std::move(source)}, work, kShareOfReading, scene);
  });
}

void bihive_scene_free(bihive_scene* scene) {
  delete scene;
}

int bihive_scene_view_from(bihive_scene* scene, const char* side) {
  if (scene == nullptr || side == nullptr) return failed("the scene or the side is NULL");
  return bihive_scene_set(scene, "view_from", side);
}

int bihive_scene_set(bihive_scene* scene, const char* name, const char* value) {
  return guarded([&] {
    if (scene == nullptr || name == nullptr) return failed("the scene or the name is NULL");
    for (const auto& [id, why] : kElsewhere)
      if (id == name) return failed(why);
    const std::lock_guard<std::mutex> lock(scene->in_use);
    const auto is_selected = [](const auto& one) { return one.first == "select"; };
    const bool after_select = std::any_of(scene->settings.begin(), scene->settings.end(), is_selected);
    const Parameter* const parameter = parameter_named(name);
    if (parameter == nullptr || (after_select && is_of_spheres(name))) return set_option(*scene, name, value), kDone;
    if (value == nullptr) {
      scene->picture.reset(parameter->id);
      return kDone;
    }
    const Result<SettingValue> parsed = value_from_text(*parameter, value);
    if (!parsed) return failed(Error{std::string(name) + ": " + parsed.error().message, "", 0, 0, ""});
    scene->picture.set(parameter->id, *parsed);
    return kDone;
  });
}

int bihive_render(bihive_scene* scene, int width, int height, int samples, int threads, uint8_t* rgba) {
  return guarded_long([&](Work* work) {
    if (check_picture(scene, width, height, samples, threads, rgba) != kDone) return kFailed;
    const std::lock_guard<std::mutex> lock(scene->in_use);
    std::vector<std::string> warnings;
    const CollectedWarnings unsaid(warnings);

    // The request, and its scene: the one read, or a copy changed by settings of spheres.
    PictureRequest request = request_of(*scene);
    request.picture.set("width_px", width);
    request.picture.set("height_px", height);
    request.threads = threads;
    if (samples > 0) {
      request.picture.set("samples_auto", false);
      request.picture.set("samples_per_pixel", samples);
    }
    const RenderEngine engine = choose_engine(request);
    if (is_gpu(engine)) return failed("engine: bihive_render() draws on the CPU");
    const bool periodic = request.input.reading.options().periodic;
    PictureSettings asked_for = scene->loaded.scene.picture;
    request.picture.apply_to(asked_for);
    const bool changes_spheres = !request.looks.looks.empty() || !request.looks.element_colours.empty() || !periodic ||
                                 asked_for.sticks.bonds != Bonds::none || asked_for.arrows.any() ||
                                 asked_for.traces.any() || asked_for.hydrogen_bonds.any() || asked_for.trails.any() ||
                                 !request.links.empty() || asked_for.links.shows_contacts() ||
                                 asked_for.shows_cavities();
    std::optional<LoadedScene> changed;
    put_light(scene->as_read, scene->loaded.scene);
    if (changes_spheres) changed = scene->loaded;
    LoadedScene& input = changed ? *changed : scene->loaded;
    if (!periodic && input.scene.spheres.cell()) input.scene.spheres.cell()->periodic = {};
    const RenderSettings settings = prepare_picture(request, engine, input);
    value_or_fail(check_picture_memory(width, height));

    // Its tree.
    const bool has_tree = !changes_spheres && engine == RenderEngine::automatic && !request.tree.max_prims &&
                          !request.tree.max_depth && !request.tune;
    std::optional<Tracer> own;
    if (!has_tree)
      own.emplace(value_or_fail(
          Tracer::build(input.scene, structure_of(engine), tree_for(request, engine, input.scene, settings), threads)));

    // The picture.
    const Section section(work, 0, 1);
    const Rendered rendered = value_or_fail(render(input.scene, own ? *own : *scene->tracer, settings));
    const PngPixels pixels = finished_pixels(rendered.film, input.scene, settings, 8);
    write_rgba(pixels, rgba);
    request.style.name = scene->style;
    scene->methods =
        methods_text(request, settings_json(request, settings, input.scene, {}), input.scene, scene->source);
    return kDone;
  });
}

const char* bihive_scene_methods(const bihive_scene* scene) {
  return scene == nullptr || scene->methods.empty() ? nullptr : scene->methods.c_str();
}
