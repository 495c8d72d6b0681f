#include "bihive/viewer/command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/io/cell_options.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/names.h"

namespace bihive {
namespace {

using Words = std::vector<std::string>;

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::string vector(Vec3d v) {
  return number_text(v.x) + "," + number_text(v.y) + "," + number_text(v.z);
}

// "--id=value": a value may begin with a hyphen.
void add(Words& words, std::string_view id, const std::string& value) {
  const std::string option = option_of_setting(id);
  if (value.starts_with('-')) {
    words.push_back(option + "=" + value);
  } else {
    words.push_back(option);
    words.push_back(value);
  }
}

void add_if(Words& words, std::string_view id, const std::string& value) {
  if (!value.empty()) add(words, id, value);
}

struct TextOfValue {
  const Parameter& parameter;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const {
    return parameter.kind == ParameterKind::choice ? names_of(parameter)[static_cast<std::size_t>(value)]
                                                   : std::to_string(value);
  }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(Vec3d value) const { return vector(value); }
};

// The user's settings. A value that no option can state, such as a flag without `--no-...`, is the default.
void add_parameters(Words& words, const ViewerSettings& settings) {
  const Overrides& user = settings.picture.user;
  for (const auto& [parameter, value] : user.all()) {
    if (parameter->id == "samples_per_pixel") {
      if (!user.has("samples_auto") || !user.is_on("samples_auto"))
        add(words, "samples", TextOfValue{*parameter}(std::get<std::int64_t>(*value)));
    } else if (parameter->id == "samples_auto") {
      if (std::get<bool>(*value)) add(words, "samples", "auto");
    } else if (parameter->id == "outline_px") {
      add(words, "outline", number_text(std::get<double>(*value)));
    } else if (const bool* const flag = std::get_if<bool>(value); flag != nullptr) {
      if (*flag) words.push_back(option_of(*parameter));
      if (!*flag && parameter->has_no_option) words.push_back(option_of_setting("no_" + std::string(parameter->id)));
    } else if (parameter->has_option) {
      const std::string text = std::visit(TextOfValue{*parameter}, *value);
      if (!text.empty()) add(words, parameter->id, text);
    }
  }
}

// The angle under which parallel rays have this shorter side (with_projection()).
double angle_of(const Camera& camera) {
  return camera.projection == Projection::orthographic ? with_projection(camera, Projection::perspective).fov_deg
                                                       : camera.fov_deg;
}

void add_camera(Words& words, const ShownState& state) {
  const Camera& camera = state.settings.camera;
  if (!state.own_camera) {
    add(words, "eye", vector(camera.eye));
    add(words, "look_at", vector(camera.look_at));
    add(words, "up", vector(camera.up));
    add(words, "fov", number_text(angle_of(camera)));
  } else {
    if (state.side) add(words, "view_from", *state.side);
    const bool is_usual = camera.projection == Projection::orthographic || camera.fov_deg == Camera().fov_deg;
    if (!is_usual) add(words, "fov", number_text(camera.fov_deg));
  }
  if (camera.projection == Projection::orthographic || !state.own_camera)
    add(words, "projection", name_of(kProjections, camera.projection));
  if (camera.aperture > 0) add(words, "aperture", number_text(camera.aperture));
  if (camera.aperture > 0 && !state.settings.focus_on.empty())
    add(words, "focus", state.settings.focus_on);
  else if (camera.aperture > 0 && camera.focus > 0)
    add(words, "focus", number_text(camera.focus));
}

void add_look(Words& words, const ViewerLook& look) {
  add_if(words, "style", look.style);
  add_if(words, "element_colours", look.element_colours);
  add_if(words, "background", look.background);
  for (const std::string& light : look.lights) add(words, "light", light);
  add_if(words, "colour_by", look.colour_by);
  add_if(words, "nan_colour", look.nan_colour);
  add_if(words, "crease", look.crease);
  add_if(words, "floor", look.floor);
  // The options after a selection apply to it; "all" comes first where rows of selections came before.
  std::string selected;
  bool is_first = true;
  for (const LookRow& row : look.rows) {
    const std::string wanted = row.select.empty() ? "all" : row.select;
    if (wanted != selected || is_first) add(words, "select", wanted);
    selected = wanted;
    is_first = false;
    const LookActionText* const action = look_action_named(row.action);
    if (action != nullptr && action->value.empty())
      words.push_back("--" + row.action);
    else
      add(words, row.action, row.value);
  }
}

}  // namespace

std::vector<std::string> command_words(CommandOf kind, const ShownState& state, const std::string& output) {
  Words words{"bihive"};
  const auto say = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  const std::string input = state.input.starts_with('-') ? "./" + state.input : state.input;
  const std::string size = fmt::format("{}x{}", state.width_px, state.height_px);
  switch (kind) {
    case CommandOf::picture:
      say({"render", input, "-o", output + ".png", "--size", size});
      break;
    case CommandOf::window:
      say({"view", input});
      break;
    case CommandOf::page:
      say({"web", input, "--html", output + ".html"});
      break;
    case CommandOf::scene_file:
      say({"scene", "save", output + ".json", input, "--size", size});
      break;
  }
  if (state.count) add(words, "count", std::to_string(*state.count));
  if (state.seed && kind != CommandOf::page) add(words, "seed", std::to_string(*state.seed));
  for (const auto& [row, text] : state.reading.all()) {
    if (state.settings.replicate && row->id == "replicate") continue;
    if (row->value_name.empty())
      words.push_back(option_of_setting(row->id));
    else
      add(words, row->id, text);
  }
  if (state.settings.replicate) {
    const auto& [a, b, c] = *state.settings.replicate;
    add(words, "replicate", fmt::format("{}x{}x{}", a, b, c));
  }
  if (state.settings.view != View::shaded) add(words, "view", name_of(kViews, state.settings.view));
  add_camera(words, state);
  // Without a selection, options mean all spheres: these come before the rows.
  add_parameters(words, state.settings);
  add_look(words, state.look);
  const auto add_limit = [&](std::string_view id, const std::optional<std::int64_t>& limit) {
    if (limit) add(words, id, *limit == kUnlimited ? "unlimited" : std::to_string(*limit));
  };
  add_limit("max_prims", state.settings.max_prims);
  add_limit("max_depth", state.settings.max_depth);
  if (state.settings.engine == ViewerEngine::gpu && kind != CommandOf::page && kind != CommandOf::scene_file)
    add(words, "engine", "gpu");
  return words;
}

std::string quoted_for_shell(const std::string& word) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           std::string_view("-_=+./:,%@").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string command_text(CommandOf kind, const ShownState& state, const std::string& output) {
  std::string text;
  for (const std::string& word : command_words(kind, state, output))
    text += (text.empty() ? "" : " ") + quoted_for_shell(word);
  return text;
}

}  // namespace bihive
