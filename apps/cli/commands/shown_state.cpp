#include "commands/shown_state.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "bihive/base/json_text.h"
#include "bihive/base/setting_name.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/film/fixed_json.h"
#include "bihive/job/input.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/scene_request.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/names.h"
#include "bihive/scene/style.h"
#include "bihive/viewer/viewer_json.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive::cli {

bool places_camera(const ViewOptions& options) {
  return options.eye || options.look_at || options.fit || options.zoom_to || options.up || options.turn ||
         options.zoom || options.view_of;
}

namespace {

using nlohmann::ordered_json;

template <class T>
void put(ordered_json& object, const char* key, const std::optional<T>& value) {
  if (value) object[key] = *value;
}

ViewerLook look_of(const ViewOptions& options) {
  ViewerLook look;
  look.style = options.style.name;
  look.element_colours = options.looks.element_colours;
  look.background = options.background.value_or("");
  look.lights = options.style.light_words;
  look.nan_colour = options.looks.nan_colour;
  look.floor = options.floor.value_or("");
  // A side to look from does not keep the file's camera, nor its up.
  if (options.floor && options.up) look.floor_up = *options.up;
  if (options.floor && !options.up && (options.view_from || options.view_of)) look.floor_up = {0, 1, 0};
  look.rows = options.looks.rows;
  return look;
}

// The parameters of the picture that the user has set.
void put_parameters(const ViewOptions& options, ordered_json& settings) {
  Overrides chosen = options.picture;
  if (chosen.has("length_unit") && !chosen.is_on("scale_bar"))
    fail_usage(setting_name("length_unit") + " is for the scale bar, and the picture has none",
               "add " + setting_name("scale_bar") + ", or leave it out");
  // Without labels: only the requested ones.
  for (const Parameter& parameter : picture_parameters())
    if (options.labels.none && parameter.group == ParameterGroup::labels && !chosen.has(parameter.id))
      chosen.set(parameter.id, parameter.get(PictureSettings()));
  // A scene file may ask for more samples than window and page draw.
  ordered_json parameters = *json_from_text<ordered_json>(overrides_to_json(chosen));
  if (const auto samples = parameters.find("samples_per_pixel"); samples != parameters.end())
    *samples = std::min<std::int64_t>(samples->get<std::int64_t>(), kMostSamples);
  settings.update(parameters);
}

// The size for which a camera is fitted. The angle is along the shorter side, so what fits a square fits every window;
// a pixel more says which side is longer.
PictureSize fitted_size(const std::optional<PictureSize>& window) {
  constexpr int kSide = 800;
  return window && window->height_px > window->width_px ? PictureSize{kSide, kSide + 1} : PictureSize{kSide + 1, kSide};
}

// The camera of `bihive render`.
Camera camera_of_picture(const ViewOptions& options) {
  const PictureSize size = fitted_size(options.size);
  if (options.input.input == kStandardStream)
    fail_usage("such a camera needs the input twice, and the standard input can be read once",
               "write it into a file first");
  PictureRequest request = options;
  request.picture.set("width_px", size.width_px);
  request.picture.set("height_px", size.height_px);
  const Style style = choose_style(request.style);
  Input input = load_input(request.input, LooksOfFile::keep, &style, /*asked_for=*/!request.style.name.empty());
  prepare_picture(request, RenderEngine::automatic, input);
  return input.scene.camera;
}

void put_camera(const ViewOptions& options, bool with_side, ordered_json& settings) {
  ordered_json camera = ordered_json::object();
  put(camera, "fov_deg", options.fov_deg);
  if (options.projection) camera["projection"] = name_of(kProjections, *options.projection);
  put(camera, "aperture", options.aperture);
  if (options.focus) {
    if (options.aperture.value_or(0) == 0)
      fail_usage(setting_name("focus") + " changes nothing without an aperture",
                 "give the radius of the lens by " + setting_name("aperture"));
    if (const double* const distance = std::get_if<double>(&*options.focus))
      camera["focus"] = *distance;
    else
      settings["focus_on"] = std::get<std::string>(*options.focus);
  }
  if (places_camera(options) || (with_side && options.view_from)) camera = camera_json(camera_of_picture(options));
  if (!camera.empty()) settings["camera"] = camera;
}

void check_style(const ViewOptions& options) {
  const std::string& name = options.style.name;
  if (name.empty()) return;
  if (const Result<Style> style = style_named(name); !style)
    fail_usage(setting_name("style") + ": " + style.error().message, "see bihive styles");
  const std::string& input = options.input.input;
  if (is_built_in_scene(input) && input != "demo")
    fail_usage(setting_name("style") + " is for files, not for " + input);
}

}  // namespace

void take_request_to_show(ViewOptions& options, bool of_page) {
  options.looks.check_for_action();
  std::string left_out;
  const auto takes = [&](const std::string& id) {
    // Window and page have sizes and engines of their own, and draw with as many threads as there are.
    if (id == "size" || id == "engine" || id == "threads") return false;
    const RequestOption<PictureRequest>* const row = picture_option(id);
    if (row == nullptr || (row->in_window && (row->in_page || !of_page))) return true;
    left_out += (left_out.empty() ? "" : ", ") + setting_name(id);
    return false;
  };
  const std::string document = options.input.input;
  if (!take_saved_request(options, takes)) return;
  if (!left_out.empty()) warn(document + ": " + left_out + " left out: bihive render alone has it");
}

void check_shown(const ViewOptions& options) {
  check_input_options(options.input);
  check_style(options);
  const std::string& colours = options.looks.element_colours;
  if (!colours.empty() && !element_colours_called(colours))
    fail_usage(setting_name("element_colours") + ": there are no element colours \"" + colours + "\"",
               "there are soft, jmol and cpk; files of colours are for bihive render");
}

ordered_json settings_to_show(const ViewOptions& options, bool with_side) {
  const auto limit = [](std::int64_t value) {
    return value == kUnlimited ? ordered_json("unlimited") : ordered_json(value);
  };
  ordered_json settings = ordered_json::object();
  settings["view"] = name_of(kViews, options.view);
  if (options.window_engine) settings["engine"] = name_of(kViewerEngines, *options.window_engine);
  put_parameters(options, settings);
  put_camera(options, with_side, settings);
  if (options.tree.max_prims) settings["max_prims"] = limit(*options.tree.max_prims);
  if (options.tree.max_depth) settings["max_depth"] = limit(*options.tree.max_depth);
  return settings;
}

ordered_json look_to_show(const ViewOptions& options) {
  return *json_from_text<ordered_json>(viewer_look_to_json(look_of(options)));
}

}  // namespace bihive::cli
