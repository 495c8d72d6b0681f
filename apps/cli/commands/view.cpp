// bihive view: passes a checked command line on to bihive-view, the program with the window.

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "bihive/base/json_text.h"
#include "bihive/job/failure.h"
#include "bihive/job/input.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/names.h"
#include "bihive/scene/style.h"
#include "bihive/viewer/viewer_json.h"
#include "bihive/viewer/viewer_settings.h"
#include "commands/commands.h"
#include "commands/names.h"
#include "commands/picture_file.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/sibling_program.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProgram = "bihive-view";

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
  look.rows = options.looks.rows;
  return look;
}

// The parameters of the picture that the user has set.
void put_parameters(const ViewOptions& options, ordered_json& settings) {
  Overrides chosen = options.picture;
  if (chosen.has("length_unit") && !chosen.is_on("scale_bar"))
    fail_usage("--length-unit is for the scale bar, and the picture has none", "add --scale-bar, or leave it out");
  // Without labels: only the requested ones.
  for (const Parameter& parameter : picture_parameters())
    if (options.labels.none && parameter.group == ParameterGroup::labels && !chosen.has(parameter.id))
      chosen.set(parameter.id, parameter.get(PictureSettings()));
  settings.update(*json_from_text<ordered_json>(overrides_to_json(chosen)));
}

void put_camera(const ViewOptions& options, ordered_json& settings) {
  ordered_json camera = ordered_json::object();
  put(camera, "fov_deg", options.fov_deg);
  if (options.projection) camera["projection"] = name_of(kProjections, *options.projection);
  put(camera, "aperture", options.aperture);
  if (options.focus) {
    if (options.aperture.value_or(0) == 0)
      fail_usage("--focus changes nothing without an aperture", "give the radius of the lens by --aperture");
    if (const double* const distance = std::get_if<double>(&*options.focus))
      camera["focus"] = *distance;
    else
      settings["focus_on"] = std::get<std::string>(*options.focus);
  }
  if (!camera.empty()) settings["camera"] = camera;
}

// The JSON object of apps/viewer/request.h.
ordered_json request_of(const ViewOptions& options) {
  ordered_json request = ordered_json::object();
  const InputOptions& input = options.input;
  request["input"] = input.input == kStandardStream ? "/dev/stdin" : input.input;
  put(request, "count", input.count);
  put(request, "seed", input.seed);
  request["reading"] = *json_from_text<ordered_json>(reading_to_json(input.reading));
  if (options.size) request["size"] = {options.size->width_px, options.size->height_px};
  if (options.view_of)
    fail_usage("--view-from principal and best are for pictures, not for the window", "name one of " + list_of(kSides));
  if (options.view_from) request["view_from"] = name_of(kSides, *options.view_from);
  request["look"] = *json_from_text<ordered_json>(viewer_look_to_json(look_of(options)));
  if (!options.screenshot.empty()) request["screenshot"] = options.screenshot;

  const auto limit = [](std::int64_t value) {
    return value == kUnlimited ? ordered_json("unlimited") : ordered_json(value);
  };
  ordered_json settings = ordered_json::object();
  settings["view"] = name_of(kViews, options.view);
  if (options.window_engine) settings["engine"] = name_of(kViewerEngines, *options.window_engine);
  put_parameters(options, settings);
  put_camera(options, settings);
  if (options.tree.max_prims) settings["max_prims"] = limit(*options.tree.max_prims);
  if (options.tree.max_depth) settings["max_depth"] = limit(*options.tree.max_depth);
  request["settings"] = settings;
  return request;
}

void check_style(const ViewOptions& options) {
  const std::string& name = options.style.name;
  if (name.empty()) return;
  if (const Result<Style> style = style_named(name); !style)
    fail_usage("--style: " + style.error().message, "see bihive styles");
  const std::string& input = options.input.input;
  if (is_built_in_scene(input) && input != "demo") fail_usage("--style is for files, not for " + input);
}

}  // namespace

void run_view(const ViewOptions& options) {
  options.looks.check_for_action();
  if (options.window_engine == ViewerEngine::gpu && options.view == View::tree)
    fail_usage("--view tree is drawn by the CPU, and --engine gpu is not",
               "leave --engine out, or choose --engine cpu");
  check_input_options(options.input);
  check_style(options);
  const std::string& colours = options.looks.element_colours;
  if (!colours.empty() && !element_colours_called(colours))
    fail_usage("--element-colours: there are no element colours \"" + colours + "\"",
               "there are soft, jmol and cpk; files of colours are for bihive render");
  if (!options.screenshot.empty()) {
    check_picture_name(options.screenshot);
    if (options.screenshot == kStandardStream || is_exr(options.screenshot) || is_tiff(options.screenshot))
      fail_usage("--screenshot writes a PNG file", "name one that ends in .png");
    check_outputs(outputs_of(options), inputs_of(options));
  }
  const std::string request = request_of(options).dump(-1, ' ', false, ordered_json::error_handler_t::ignore);

  const char* const words[] = {kProgram, request.c_str(), nullptr};
  become_program(
      kProgram, words,
      "it is built where GLFW and Dear ImGui are: scripts/setup view, then make demo, or configure and build again");
}

}  // namespace bihive::cli
