#include "section_controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <sstream>

#include "bihive/io/cell_options.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/colour_maps.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/names.h"
#include "widgets.h"

namespace bihive::window {
namespace {

// Numbers of the slider are rounded to few digits, so that 0.30000001 is never shown.
void angle_slider(const char* name, double& value, double min, double max, const char* format) {
  label(name);
  auto shown = static_cast<float>(value);
  const std::string id = std::string("##") + name;
  if (ImGui::SliderFloat(id.c_str(), &shown, static_cast<float>(min), static_cast<float>(max), format,
                         ImGuiSliderFlags_AlwaysClamp))
    value = std::round(100 * static_cast<double>(shown)) / 100;
}

// A control's name, not shown on the screen.
std::string hidden_name(const Parameter& parameter) {
  return "##" + std::string(parameter.id);
}

bool has_slider(const Parameter& parameter) {
  return parameter.slider_least != parameter.slider_most;
}

bool flag(const Parameter& parameter, SettingValue& value) {
  return ImGui::Checkbox(hidden_name(parameter).c_str(), &std::get<bool>(value));
}

bool name(const Parameter& parameter, SettingValue& value) {
  const std::vector<std::string> names = choice_labels_of(parameter);
  auto& position = std::get<std::int64_t>(value);
  bool changed = false;
  if (!ImGui::BeginCombo(hidden_name(parameter).c_str(), names[static_cast<std::size_t>(position)].c_str()))
    return false;
  for (std::int64_t i = 0; i < std::ssize(names); ++i)
    if (ImGui::Selectable(names[static_cast<std::size_t>(i)].c_str(), i == position)) {
      changed = i != position;
      position = i;
    }
  ImGui::EndCombo();
  return changed;
}

bool whole_slider(const Parameter& parameter, SettingValue& value) {
  auto shown = static_cast<int>(std::get<std::int64_t>(value));
  if (!ImGui::SliderInt(hidden_name(parameter).c_str(), &shown, static_cast<int>(parameter.slider_least),
                        static_cast<int>(parameter.slider_most), "%d", ImGuiSliderFlags_AlwaysClamp))
    return false;
  value = std::int64_t{shown};
  return true;
}

// Numbers of the slider are rounded to few digits, so that 0.30000001 is never shown.
bool number_slider(const Parameter& parameter, SettingValue& value) {
  auto shown = static_cast<float>(std::get<double>(value));
  const bool is_whole = parameter.slider_step >= 1;
  // A share is written as it is typed: 0.35.
  std::string format = fmt::format("%{}.{}f", parameter.slider_least < 0 ? "+" : "", is_whole ? 0 : 2);
  if (!parameter.unit.empty() && parameter.unit != "%") format += " " + std::string(parameter.unit);
  if (parameter.or_zero && shown == 0) format = "none";
  if (!ImGui::SliderFloat(hidden_name(parameter).c_str(), &shown, static_cast<float>(parameter.slider_least),
                          static_cast<float>(parameter.slider_most), format.c_str(), ImGuiSliderFlags_AlwaysClamp))
    return false;
  const double steps = is_whole ? 1 : 100;
  double number = std::round(steps * static_cast<double>(shown)) / steps;
  if (parameter.or_zero) number = number < 0.5 ? 0 : std::max(parameter.least, number);
  value = number;
  return true;
}

// The long label where there is room.
std::string title_of_control(const Parameter& parameter) {
  const std::string longer = sentence(parameter.long_label);
  const float room = 0.36F * ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x;
  return !longer.empty() && ImGui::CalcTextSize(longer.c_str()).x < room ? longer : sentence(parameter.label);
}

bool is_on(std::string_view id, const PictureSettings& settings) {
  const SettingValue value = parameter_named(id)->get(settings);
  if (const bool* const flag = std::get_if<bool>(&value)) return *flag;
  return std::get<double>(value) != 0;
}

// Whether engine or camera cannot draw it.
bool is_beyond(const Parameter& parameter, const ViewerSettings& settings) {
  return (parameter.cpu_only && settings.engine == ViewerEngine::gpu) ||
         (parameter.needs == ParameterNeeds::orthographic && settings.camera.projection == Projection::perspective);
}

// Whether changing it has no effect. A setting that the camera cannot draw can still be switched off.
bool is_off(const Parameter& parameter, const ViewerSettings& settings) {
  const PictureSettings now = settings.picture.result();
  if (!parameter.implies.empty() && !is_on(parameter.implies, now)) return true;
  if (!parameter.only_with.empty() && !is_on(parameter.only_with, now)) return true;
  if (!parameter.replaced_by.empty() && is_on(parameter.replaced_by, now) &&
      !is_beyond(*parameter_named(parameter.replaced_by), settings))
    return true;
  if (!is_beyond(parameter, settings)) return false;
  return parameter.cpu_only || parameter.kind != ParameterKind::flag || !is_on(parameter.id, now);
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : " ") + text;
  return all;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The fields of ATTR:MAP:MIN,MAX:log.
struct ColourByParts {
  std::string attribute, map, range, log;

  explicit ColourByParts(const std::string& text) {
    std::istringstream stream(text);
    for (std::string* part : {&attribute, &map, &range, &log}) std::getline(stream, *part, ':');
  }
  std::string text() const {
    if (attribute.empty()) return "";
    std::string all = attribute + ":" + map + ":" + range + ":" + log;
    all.erase(all.find_last_not_of(':') + 1);
    return all;
  }
};

}  // namespace

void SectionControls::parameter(const Parameter& parameter, LayeredSettings& picture) {
  SettingValue value = picture.value(parameter);
  const std::string title = title_of_control(parameter);
  bool changed = false;
  switch (parameter.kind) {
    case ParameterKind::flag:
      label(title);
      changed = flag(parameter, value);
      break;
    case ParameterKind::whole:
      label(title);
      changed = whole_slider(parameter, value);
      break;
    case ParameterKind::number:
      if (has_slider(parameter)) {
        label(title);
        changed = number_slider(parameter, value);
      } else {
        constexpr double kNone = -1;
        const double* const before = std::get_if<double>(&value);
        double shown = before != nullptr ? *before : kNone;
        changed = fields_.number(title, std::string(parameter.empty_means).c_str(), kNone, shown);
        if (shown != kNone) value = shown;
        if (shown == kNone || (shown == 0 && parameter.nullable)) value = {};
      }
      break;
    case ParameterKind::choice:
      label(title);
      changed = name(parameter, value);
      break;
    case ParameterKind::text:
    case ParameterKind::colour: {
      const auto* const before = std::get_if<std::string>(&value);
      std::string shown = before != nullptr ? *before : "";
      changed = fields_.text(title, parameter.empty_means.empty() ? "none" : parameter.empty_means.data(), shown);
      value = shown;
      if (parameter.nullable && shown.empty()) value = {};
    }
  }
  if (changed && fits(parameter, value)) picture.user.set(parameter.id, value);
}

void SectionControls::parameters(ParameterGroup group, ViewerSettings& settings) {
  for (const Parameter* const row : controls_of(group)) {
    ImGui::BeginDisabled(is_off(*row, settings));
    parameter(*row, settings.picture);
    ImGui::EndDisabled();
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) continue;
    const bool says_why = is_beyond(*row, settings) && !row->note.empty();
    ImGui::SetTooltip("%s", std::string(says_why ? row->note : row->help).c_str());
  }
}

bool SectionControls::draw_colours(const SceneFacts& facts, ViewerLook& look, ColourRanges& ranges) {
  ColourByParts parts(look.colour_by);
  bool changed = choice("Colour by", facts.is_file_of_spheres ? "the style's colours" : "the file's colours",
                        facts.attributes, parts.attribute);
  if (changed) parts.range.clear();  // another attribute has another range
  ImGui::BeginDisabled(parts.attribute.empty());
  changed = choice("Map", "automatic", colour_map_names(), parts.map) || changed;
  changed = fields_.text("Range", "MIN,MAX: all values", parts.range) || changed;
  if (!parts.attribute.empty()) changed = ranges.draw(parts.attribute, parts.range) || changed;
  bool log = parts.log == "log";
  changed = check("Logarithmic", log) || changed;
  parts.log = log ? "log" : "";
  ImGui::EndDisabled();
  if (changed) look.colour_by = parts.text();
  changed = fields_.text("Unknown numbers", "grey", look.nan_colour) || changed;
  if (!facts.has_elements) return changed;
  return choice("Elements", "the style's colours", element_colour_names(), look.element_colours) || changed;
}

bool SectionControls::draw_light(ViewerSettings& settings, ViewerLook& look) {
  constexpr const char* kOwn = "my own";
  std::vector<std::string> names;
  for (const auto& preset : light_presets()) names.push_back(preset.first);
  const bool is_preset =
      look.lights.size() == 1 && value_named(light_presets(), look.lights.front()) != nullptr && !own_lights_;
  const bool own = own_lights_ || (!look.lights.empty() && !is_preset);
  std::string chosen = own ? kOwn : is_preset ? look.lights.front() : "";
  names.emplace_back(kOwn);
  bool changed = choice("Lights", "the style's", names, chosen);
  if (changed) {
    own_lights_ = chosen == kOwn;
    changed = !own_lights_;
    if (changed) look.lights = words_of(chosen);
  }
  if (own) {
    std::string written = joined(look.lights);
    if (fields_.text("My lights", "from:-1,1,1::1:20", written)) {
      look.lights = words_of(written);
      own_lights_ = false;
      changed = true;
    }
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(
          "from:RIGHT,UP,TOWARDS:COLOUR:STRENGTH:DEGREES around the camera,\n"
          "at:X,Y,Z:COLOUR:STRENGTH:RADIUS in the world; more with spaces.\n"
          "Degrees and radius make shadows soft.");
  }
  changed |= fields_.text("Floor", "shadow, or a colour", look.floor);
  parameters(ParameterGroup::light, settings);
  return changed;
}

bool SectionControls::draw_lines(const SceneFacts& facts, ViewerSettings& settings, ViewerLook& look) {
  parameters(ParameterGroup::lines, settings);
  return choice("Between", facts.is_file_of_spheres ? "the style's lines" : "the file's lines", facts.attributes,
                look.crease);
}

void SectionControls::draw_lens(ViewerSettings& settings) {
  Camera& camera = settings.camera;
  const bool parallel = camera.projection == Projection::orthographic;
  ImGui::BeginDisabled(parallel);
  angle_slider("Angle", camera.fov_deg, 1, 120, "%.0f deg");
  const bool was_open = camera.aperture > 0;
  if (fields_.number("Aperture", "0: all is sharp", 0, camera.aperture) && camera.aperture > 0 && !was_open)
    settings.picture.user.reset("samples_auto");  // a lens needs many samples everywhere
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the lens's radius, in the file's units");
  ImGui::EndDisabled();

  // The focus. A choice still without its distance or spheres stays.
  ImGui::BeginDisabled(camera.aperture == 0);
  constexpr std::array<const char*, 3> kKinds{"the middle", "a distance", "selected spheres"};
  const int given = !settings.focus_on.empty() ? 2 : camera.focus > 0 ? 1 : 0;
  int kind = focus_kind_ < 0 ? given : focus_kind_;
  label("Sharp");
  if (ImGui::Combo("##sharp", &kind, kKinds.data(), static_cast<int>(kKinds.size()))) {
    focus_kind_ = kind == given || kind == 0 ? -1 : kind;
    if (kind == 0) {
      settings.focus_on.clear();
      camera.focus = 0;
    }
  }
  if (kind == 1 && fields_.number("Distance", "", 0, camera.focus)) {
    settings.focus_on.clear();
    focus_kind_ = -1;
  }
  if (kind == 2 && fields_.text("Spheres", "resname LIG", settings.focus_on)) focus_kind_ = -1;
  ImGui::EndDisabled();
  parameters(ParameterGroup::tone, settings);
}

void SectionControls::draw_cell(const SceneFacts& facts, ViewerSettings& settings) {
  const bool gpu = settings.engine == ViewerEngine::gpu;
  const auto words = [](const std::array<std::int32_t, 3>& counts) {
    return fmt::format("{}x{}x{}", counts[0], counts[1], counts[2]);
  };
  ImGui::BeginDisabled(gpu);
  parameters(ParameterGroup::cell, settings);
  const std::string own = words(facts.copies);
  std::string copies = settings.replicate ? words(*settings.replicate) : "";
  if (fields_.text("Copies", own.c_str(), copies)) {
    const Result<std::array<std::int32_t, 3>> counts = copies_from_text(copies);
    if (counts) settings.replicate = *counts;
    if (copies.empty()) settings.replicate.reset();
  }
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip(
        "%s", gpu ? "the CPU engine alone draws cells and copies" : "AxBxC: copies along the vectors of the cell");
}

void SectionControls::start_anew() {
  fields_.forget();
  own_lights_ = false;
  focus_kind_ = -1;
}

bool SectionControls::draw(const CardSection& section, const SceneFacts& facts, ViewerSettings& settings,
                           ViewerLook& look) {
  if (section.group == ParameterGroup::picture) return parameters(section.group, settings), false;
  if (section.group == ParameterGroup::cell && !facts.has_cell) return false;
  if (!group(std::string(section.title).c_str())) return false;
  switch (section.group) {
    case ParameterGroup::light:
      return draw_light(settings, look);
    case ParameterGroup::lines:
      return draw_lines(facts, settings, look);
    case ParameterGroup::tone:
      draw_lens(settings);
      return false;
    case ParameterGroup::cell:
      draw_cell(facts, settings);
      return false;
    case ParameterGroup::picture:
    case ParameterGroup::labels:
      parameters(section.group, settings);
  }
  return false;
}

}  // namespace bihive::window
