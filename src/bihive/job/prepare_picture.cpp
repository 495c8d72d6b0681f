#include "bihive/job/prepare_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/image/font_file.h"
#include "bihive/io/frames.h"
#include "bihive/job/choose_labels.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/choose_sticks.h"
#include "bihive/job/failure.h"
#include "bihive/job/floor.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/title_values.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/frame_picture.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"
#include "bihive/render/stereo.h"
#include "bihive/scene/cavities.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/legend.h"
#include "bihive/scene/show_density.h"
#include "bihive/scene/title_text.h"
#include "bihive/settings/check_picture.h"
#include "bihive/settings/parameter.h"
#include "bihive/settings/picture_report.h"

namespace bihive {

using nlohmann::ordered_json;

namespace {

bool shows_reference_tree(View view) {
  return view == View::traversal || view == View::tree;
}

// The title with the frame's values. A generated scene has no frame; its number is 0.
std::string filled_title(const std::string& title, const PictureRequest& request, const Input& input,
                         std::int64_t spheres) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const std::int64_t frame = numbered_frame(request.input.reading.options().frame, input.frames);
  TitleValues values{{"frame", static_cast<double>(frame)},
                     {"time", input.time_ps.value_or(kUnknown)},
                     {"step", input.step ? static_cast<double>(*input.step) : kUnknown},
                     {"spheres", static_cast<double>(spheres)}};
  if (!request.labels.title_values.empty()) {
    const TitleValues more = values_of_frame(request.labels.title_values, frame);
    values.insert(values.begin(), more.begin(), more.end());
  }
  Result<std::string> filled = fill_title(title, values);
  if (!filled) fail_setting("title", ": " + filled.error().message, filled.error().hint);
  return *filled;
}

void check_stereo(const RenderSettings& settings) {
  const Stereo& stereo = settings.stereo;
  if (stereo.form == StereoForm::none) return;
  if (settings.view != View::shaded)
    fail_setting("stereo", " draws the shaded picture alone", "leave out " + setting_name("view"));
  if (settings.crop) fail_setting("stereo", " draws the whole picture", "leave out " + setting_name("crop"));
  if (stereo.halves() && settings.width_px % 2 != 0)
    fail_setting("stereo", fmt::format(" makes two halves of the picture, and {} pixels have none", settings.width_px),
                 "give an even width by " + setting_name("size"));
  if (stereo.form == StereoForm::anaglyph && settings.transparent)
    fail_setting("stereo", " anaglyph has no transparent background", "give a colour by " + setting_name("background"));
}

// Applies the user's options to the scene: transfer curve, background, camera, light. Returns the scene's own settings
// with the user's options.
RenderSettings apply_options(const PictureRequest& request, Input& input, const CameraSelections& selections,
                             const WholeSet* whole) {
  Scene& scene = input.scene;
  const Overrides& user = request.picture;
  PictureSettings picture = scene.picture;
  if (request.labels.none) picture.labels = {};
  if (request.aperture.value_or(0) > 0 && !user.has("samples_auto")) use_lens_samples(picture);
  user.apply_to(picture);
  if (request.background) picture.transparent = *request.background == kNoBackground;
  scene.picture.transfer = picture.transfer;
  RenderSettings settings = settings_from(picture);
  settings.crop = request.crop;
  if (request.crop && (request.crop->x1 > settings.width_px || request.crop->y1 > settings.height_px))
    fail_setting("crop",
                 fmt::format(" ends outside the picture of {} x {} pixels", settings.width_px, settings.height_px),
                 "give the size of the whole picture by " + setting_name("size"));
  if (request.print_size && request.dots_per_inch == 0)
    fail_setting("size", " in print needs the pixels per inch", "add " + setting_name("dpi") + " 300");
  if (settings.line_unit == LineUnit::pt && request.dots_per_inch == 0)
    fail_setting("line_unit", " pt needs the pixels per inch of the print", "add " + setting_name("dpi") + " 300");
  if (user.has("length_unit") && !settings.labels.scale_bar)
    fail_setting("length_unit", " is for the scale bar, and the picture has none",
                 "add " + setting_name("scale_bar") + ", or leave it out");
  if (user.has("legend_title") && !settings.labels.legend)
    fail_setting("legend_title", " is for the legend, and the picture has none",
                 "add " + setting_name("legend") + ", or leave it out");
  if (user.is_on("cell") && !scene.spheres.cell() && !scene.spheres.empty())
    fail({"there is no periodic cell that " + setting_name("cell") + " could draw", request.input.input, 0, 0,
          "give one with " + setting_name("cell_vectors")});
  if (user.is_on("cell") && request.view != View::shaded)
    fail_setting("cell", " draws on the shaded picture alone", "leave out " + setting_name("view"));
  settings.view = request.view;
  settings.dots_per_inch = request.dots_per_inch;
  if (!request.labels.font.empty()) settings.font = value_or_fail(read_font(request.labels.font));
  settings.threads = static_cast<int>(request.threads);
  if (request.background && !settings.transparent)
    scene.background = *colour_from(*request.background, scene.picture.transfer);
  if (user.has("matte") && !settings.transparent)
    fail_setting("matte", " is the colour behind a transparent picture, and this one has a background",
                 "add " + setting_name("background") + " none, or give the colour by " + setting_name("background"));
  if (!settings.transparent) settings.matte.reset();
  if (settings.matte) scene.background = *settings.matte;
  if (user.has("eye_distance") && settings.stereo.form == StereoForm::none)
    fail_setting("eye_distance", " is for stereo pictures", "add " + setting_name("stereo") + " side");
  check_stereo(settings);
  if (settings.transparent && shows_reference_tree(settings.view))
    fail_setting("view", " " + name_of(kViews, settings.view) + " has no transparent background",
                 "give a colour by " + setting_name("background") + ", or choose another view");
  settings.labels.title =
      filled_title(settings.labels.title, request, input, whole != nullptr ? whole->count : scene.spheres.size());
  const bool is_fixed = request.fixed && !request.fixed->fits_each;
  scene.camera =
      is_fixed ? request.fixed->camera : choose_camera(input, request, one_view(settings), selections, whole);
  if (const Status status = check_picture(settings, scene.camera.aperture); !status)
    fail_usage(status.error().message, status.error().hint);
  lay_floor(request, settings, input);
  apply_look(request.style, input);
  leave_out_labels(user, scene, settings);
  if (leaves_out_fog(settings, user, input.states_fog)) settings.fog.reset();
  return settings;
}

// The probe of the cavities that scene and user ask for; infinite: none.
double choose_cavities(const PictureRequest& request, const Scene& scene, const WholeSet* whole) {
  PictureSettings picture = scene.picture;
  request.picture.apply_to(picture);
  if (picture.shows_cavities() && whole != nullptr)
    fail_setting("show_cavities", " needs all spheres in one place, and they are distributed over ranks",
                 "leave " + setting_name("show_cavities") + " out");
  return picture.cavity_probe;
}

void draw_cavities(double probe, const PictureRequest& request, bool is_of_film, Scene& scene) {
  const Result<ShownCavities> shown = show_cavities(scene, probe, static_cast<int>(request.threads));
  if (!shown) fail_setting("show_cavities", ": " + shown.error().message, shown.error().hint);
  if (shown->undecided_spheres > 0)
    warn("the pieces of " + grouped(shown->undecided_spheres) +
         " spheres could not be told apart: cavities may be wrong");
  if (shown->cavities == 0 && !is_of_film)
    warn(fmt::format("there is no cavity for a probe of radius {}, and nothing to be seen", probe));
}

std::string without_sticks() {
  return "with " + setting_name("bonds") + " none, without " + setting_name("arrows") + ", " + setting_name("trace") +
         ", " + setting_name("links") + ", " + setting_name("show_contacts") + ", " + setting_name("trail") + " and " +
         setting_name("hbonds");
}

// Refuses what the GPU cannot draw.
void refuse_on_gpu(RenderEngine engine, const Scene& scene, const RenderSettings& settings) {
  const auto refuse = [engine](const std::string& what, const std::string& without) {
    fail_setting("engine", " " + name_of(kRenderEngines, engine) + " draws no " + what,
                 "leave " + setting_name("engine") + " out, or draw " + without);
  };
  if (settings.stereo.form != StereoForm::none) refuse("stereo pictures", "without " + setting_name("stereo"));
  if (settings.cell_lines) refuse("edges of a cell", "without " + setting_name("cell"));
  if (settings.adaptive_samples) refuse("adaptive samples", "with a number of them: " + setting_name("samples") + " 4");
  if (scene.plane && scene.plane->shadows_only)
    refuse("floors of shadows", "with a colour of " + setting_name("floor"));
  if (!scene.sticks.empty()) refuse("bonds, arrows, tubes and links", without_sticks());
  if (settings.opacity_rule == OpacityRule::as_one && lets_light_through(scene))
    refuse("overlapping spheres as one", "with " + setting_name("opacity_rule") + " first");
  if (has_clips(scene)) refuse("cut spheres", "without " + setting_name("clip"));
  if (scene.cavity_walls != nullptr) refuse("walls of cavities", "without " + setting_name("show_cavities"));
  if (scene.spheres.has_images()) refuse("replicated spheres", "without " + setting_name("replicate"));
  if (const Parameter* const row = first_cpu_only(settings))
    refuse("pictures with " + setting_name(std::string(row->id)), "without it");
}

constexpr std::int64_t kMostSeen = 50'000'000;  // spheres and images, for a question about all of them

// Insides of spheres are dark; empty: none is seen.
std::string dark_insides(const Scene& scene, const RenderSettings& settings) {
  if (settings.view != View::shaded || scene.spheres.total_size() > kMostSeen) return "";
  const std::int64_t count = spheres_around_eye(scene.spheres, scene.camera, settings);
  if (count == 0) return "";
  const bool parallel = scene.camera.projection == Projection::orthographic;
  return fmt::format("{} {} sphere{}, and the inside of a sphere is dark: move the eye back{}",
                     parallel ? "the plane of an orthographic eye cuts" : "the eye is inside", count,
                     count == 1 ? "" : "s", parallel ? ", which changes no size" : "");
}

// Why no sphere is to be seen; empty: one is. Passes over the spheres, unless there are very many images.
std::string why_empty(const Scene& scene, const RenderSettings& settings) {
  const SphereSet& spheres = scene.spheres;
  if (spheres.empty() || settings.view == View::tree || spheres.total_size() > kMostSeen) return "";
  if (scene.sticks.own_count() > 0) return "";  // tubes and arrows are seen without their spheres
  const auto all = [](const std::vector<float>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](float number) { return number == 0; });
  };
  if (all(spheres.r())) return "no sphere is seen: all have radius 0";
  const std::vector<float>& opacity = spheres.attributes().opacity;
  if (settings.view == View::shaded && !opacity.empty() && all(opacity)) return "no sphere is seen: all have opacity 0";
  RenderSettings without_cell = one_view(settings);
  const CanvasArea whole{0, 0, double(without_cell.width_px), double(without_cell.height_px)};
  without_cell.cell_lines.reset();
  if (covers_spheres(spheres, scene.camera, without_cell, whole)) return "";
  return "no sphere is in the picture: the camera looks past them; without a camera of your own all are in view";
}

}  // namespace

// The pictures of the tree show the reference tree, also if another engine is faster.
RenderEngine choose_engine(const PictureRequest& request) {
  const RenderEngine engine = request.engine;
  if (!shows_reference_tree(request.view) || engine == RenderEngine::reference) return engine;
  if (engine == RenderEngine::automatic) return RenderEngine::reference;
  const std::string view = " " + name_of(kViews, request.view);
  const std::string chosen = setting_name("engine") + " " + name_of(kRenderEngines, engine);
  if (engine == RenderEngine::brute || engine == RenderEngine::wide_brute || engine == RenderEngine::gpu_brute)
    fail_setting("view", view + " shows a tree, and " + chosen + " has none");
  if (engine == RenderEngine::wide)
    fail_setting("view", view + " shows the reference tree, and " + setting_name("engine") + " wide has another one",
                 "leave " + setting_name("engine") + " out, or choose " + setting_name("engine") + " reference");
  if (request.view == View::tree)
    fail_setting("view", view + " is drawn by the CPU alone, not by " + chosen,
                 "leave " + setting_name("engine") + " out, or choose " + setting_name("engine") + " reference");
  return engine;
}

RenderSettings prepare_picture(const PictureRequest& request, RenderEngine engine, Input& input, const WholeSet* whole,
                               const FrameSource* frames) {
  if (request.tune)
    check_tuning(request.tree, name_of(kRenderEngines, engine), !is_gpu(engine) && !is_brute(structure_of(engine)));
  if (request.tune) check_tuned_view(request.view);
  PictureSettings& picture = input.scene.picture;
  if (const SettingValue* const transfer = request.picture.find("transfer"))
    parameter_named("transfer")->set(picture, *transfer);
  const bool is_of_film = request.fixed.has_value();
  if (is_of_film && request.fixed->motion)
    if (const Status status = move_spheres(input.scene.spheres, *request.fixed->motion); !status) fail(status.error());
  if (is_of_film && request.fixed->density && input.density) show_density(input, request.fixed->density);
  const CameraSelections selections = is_of_film ? CameraSelections() : CameraSelections(request, input.scene.spheres);
  const ChosenSticks sticks = choose_sticks(request, input.scene, whole);
  const double cavity_probe = choose_cavities(request, input.scene, whole);
  const std::optional<LinkTable> contacts = find_contacts(sticks, input.scene, request.threads);
  scale_balls(sticks, input.scene);
  look(input, request.looks, is_of_film ? request.fixed->ranges_of_looks : std::vector<ColourRange>{}, is_of_film);
  draw_sticks(sticks, contacts, request, frames, input);
  const bool has_cavities = std::isfinite(cavity_probe);
  if (has_cavities) draw_cavities(cavity_probe, request, is_of_film, input.scene);
  RenderSettings settings = apply_options(request, input, selections, whole);
  if (shows_reference_tree(settings.view) && has_clips(input.scene))
    fail_setting("view", " " + name_of(kViews, settings.view) + " shows the tree of whole spheres",
                 "leave out " + setting_name("clip"));
  if (shows_reference_tree(settings.view) && input.scene.spheres.has_images())
    fail_setting("view", " " + name_of(kViews, settings.view) + " shows the tree of the stored spheres",
                 "leave out " + setting_name("replicate"));
  if (shows_reference_tree(settings.view) && has_cavities)
    fail_setting("view", " " + name_of(kViews, settings.view) + " shows the tree of whole spheres",
                 "leave out " + setting_name("show_cavities"));
  if (shows_reference_tree(settings.view) && !input.scene.sticks.empty())
    fail_setting("view", " " + name_of(kViews, settings.view) + " shows the tree of the spheres",
                 "draw it " + without_sticks());
  if (input.scene.spheres.has_images() && has_clips(input.scene))
    fail_setting("clip", " does not cut the copies of " + setting_name("replicate"), "leave one of them out");
  if (whole != nullptr && settings.opacity_rule == OpacityRule::as_one)
    fail_setting("opacity_rule", " as_one needs all spheres in one place, and they are distributed over ranks",
                 "add " + setting_name("opacity_rule") + " first");
  if (is_gpu(engine)) refuse_on_gpu(engine, input.scene, settings);
  if (whole == nullptr) {
    if (const std::string shared = shared_colours(input.scene); !shared.empty()) warn(shared);
    if (const std::string unknown = unknown_numbers(input.scene); !unknown.empty()) warn(unknown);
    if (const std::string why = why_empty(input.scene, settings); !why.empty() && !has_cavities) warn(why);
    if ((request.eye || request.fit) && !is_of_film && !has_cavities)
      if (const std::string dark = dark_insides(input.scene, settings); !dark.empty()) warn(dark);
    if (settings.labels.legend)
      if (const std::string equal = equal_colours(input.scene); !equal.empty()) warn(equal);
    for (const std::string& lacking : missing_letters(input.scene, settings)) warn(lacking);
  }
  return settings;
}

// Bytes per pixel of a file's band: display values, and the bytes of the file, 8 bits per colour.
constexpr double kFileBytes = 2 * 3;

bool comes_whole(RenderEngine engine, const RenderSettings& settings) {
  return is_gpu(engine) || is_drawn_whole(settings);
}

void check_memory_of(RenderEngine engine, const Input& input, const PictureRequest& request,
                     const RenderSettings& settings) {
  if (comes_whole(engine, settings)) value_or_fail(check_picture_memory(settings.width_px, settings.height_px));
  const Tile drawn = drawn_pixels(settings);
  const double row = predict_film_bytes(settings, drawn.width()) + kFileBytes * drawn.width();
  const double band = comes_whole(engine, settings) ? 0 : row * rows_of_band(drawn.height(), row);
  value_or_fail(check_render_memory(input.scene.spheres, structure_of(engine), request.tree, settings, band));
}

ordered_json settings_json(const PictureRequest& request, const RenderSettings& settings, const Scene& scene,
                           const std::vector<Layer>& layers) {
  const auto vector = [](Vec3d v) { return ordered_json{v.x, v.y, v.z}; };
  ordered_json json = ordered_json::object();
  json["view"] = name_of(kViews, settings.view);
  if (!layers.empty()) json["layers"] = ordered_json::array();
  for (const Layer& layer : layers) json["layers"].push_back(name_of_layer(layer));
  const ReportedScene reported{has_soft_light(scene), lets_light_through(scene)};
  json.update(*json_from_text<ordered_json>(picture_report(settings, reported)));
  if (settings.crop) json["crop"] = {settings.crop->x0, settings.crop->y0, settings.crop->x1, settings.crop->y1};
  if (layers.empty())
    json["transfer"] = names_of(*parameter_named("transfer"))[static_cast<std::size_t>(scene.picture.transfer)];
  json["background"] = vector(scene.background);
  if (settings.transparent) json["transparent"] = true;
  if (request.floor)
    json["floor"] = {{"point", vector(scene.plane->plane.point)},
                     {"normal", vector(scene.plane->plane.normal)},
                     {"shadows_only", scene.plane->shadows_only}};
  if (request.bits) json["bits"] = *request.bits;
  if (request.dots_per_inch > 0) json["dpi"] = request.dots_per_inch;
  json["camera"] = {{"eye", vector(scene.camera.eye)},
                    {"look_at", vector(scene.camera.look_at)},
                    {"up", vector(scene.camera.up)},
                    {"fov_deg", scene.camera.fov_deg}};
  if (scene.camera.projection == Projection::orthographic) {
    json["camera"]["projection"] = name_of(kProjections, scene.camera.projection);
    json["camera"]["shorter_side"] = scene.camera.shorter_side;
  }
  if (scene.camera.aperture > 0) {
    json["camera"]["aperture"] = scene.camera.aperture;
    json["camera"]["focus"] = focus_distance(scene.camera);
  }
  if (shows_reference_tree(settings.view)) {
    const auto limit = [](std::int64_t value) { return value == kUnlimited ? ordered_json() : ordered_json(value); };
    const BuildParameters tree = request.tree.for_reference();
    json["max_prims"] = limit(tree.max_prims);
    json["max_depth"] = limit(tree.max_depth);
  }
  const InputOptions& input = request.input;
  json["spheres"] = scene.spheres.size();
  for (const ReadingSetting& row : reading_settings()) {
    const std::string key(row.report.empty() ? row.id : row.report);
    // Scene files may replicate too.
    if (row.id == "replicate" && scene.spheres.has_images())
      json[key] = scene.spheres.images().counts;
    else if (row.id != "replicate" && input.reading.has(row.id))
      json[key] = *json_from_text<ordered_json>(row.value(input.reading.options()));
  }
  if (!request.looks.element_colours.empty()) json["element_colours"] = request.looks.element_colours;
  if (!request.looks.words.empty()) json["looks"] = request.looks.words;
  return json;
}

std::vector<std::pair<std::string, std::string>> text_of(const PictureRequest& request, const Scene& scene,
                                                         const ordered_json& settings) {
  // Files of pictures are the same in all folders.
  ordered_json without_folders = settings;
  for (const char* const file : {"trajectory", "element_colours"})
    if (settings.contains(file)) without_folders[file] = without_folder(settings[file].get<std::string>());
  const std::string name = scene.name == request.input.input ? without_folder(scene.name) : scene.name;
  std::vector<std::pair<std::string, std::string>> text{
      {"Software", "bihive " + std::string(version())}, {"Scene", name}, {"Settings", as_text(without_folders, -1)}};
  if (scene.seed) text.emplace_back("Seed", std::to_string(*scene.seed));
  return text;
}

}  // namespace bihive
