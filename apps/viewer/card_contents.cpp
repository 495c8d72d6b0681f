// Contents of the cards, except for those that have files of their own.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/setting_name.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/names.h"
#include "bihive/scene/style.h"
#include "cards.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

// A slider's range; numbers beyond it need the command line.
constexpr int kMostPrims = 64, kMostDepth = 64;

// A limit of the tree: the engine's choice, or a number. At the slider's left end the engine chooses.
void limit_slider(const char* name, std::optional<std::int64_t>& value, int max) {
  label(name);
  int position = value ? static_cast<int>(std::clamp<std::int64_t>(*value, 1, max)) : 0;
  const std::string shown = !value ? "auto" : *value == kUnlimited ? "unlimited" : std::to_string(*value);
  const std::string id = std::string("##") + name;
  if (!ImGui::SliderInt(id.c_str(), &position, 0, max, shown.c_str(), ImGuiSliderFlags_AlwaysClamp)) return;
  if (position == 0)
    value.reset();
  else
    value = position;
}

// Only a perspective camera has a lens.
Camera projected(Camera camera, Projection projection) {
  if (projection == Projection::orthographic) camera.aperture = 0;
  return with_projection(camera, projection);
}

// Whether the shown input has this setting of reading.
bool has_input(const ReadingSetting& row, const SceneFacts& facts, const std::string& input) {
  BuiltInKind kind = BuiltInKind::file;
  for (const BuiltInScene& one : kBuiltInScenes)
    if (input == one.name) kind = one.kind;
  if (row.shown_for == ReadingOf::scenarios_and_files) return kind != BuiltInKind::fixed;
  if (kind != BuiltInKind::file) return false;
  if (row.shown_for == ReadingOf::molecules) return row.inputs.find(facts.format) != std::string_view::npos;
  if (row.shown_for == ReadingOf::frames) return facts.frames > 1;
  return row.shown_for == ReadingOf::files || facts.has_cell;
}

// The same with another text of one setting; an empty one takes it away, as do those that exclude it.
GivenReading with_setting(const GivenReading& given, const ReadingSetting& row, const std::string& text) {
  const auto excludes = [](const ReadingSetting& one, const ReadingSetting& other) {
    return std::find(one.excludes.begin(), one.excludes.end(), other.id) != one.excludes.end();
  };
  GivenReading changed;
  for (const auto& [other, value] : given.all())
    if (other->id != row.id && (text.empty() || !(excludes(*other, row) || excludes(row, *other))))
      static_cast<void>(changed.take(other->id, value));
  if (!text.empty()) static_cast<void>(changed.take(row.id, text));
  return changed;
}

// The style's, transparent, or a colour.
void draw_background(std::string& background) {
  label("Background");
  const bool is_colour = !background.empty() && background != "none";
  ImGui::SetNextItemWidth(is_colour ? -ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x : -1);
  const char* const shown = is_colour ? "a colour" : background.empty() ? "the style's" : "transparent";
  if (ImGui::BeginCombo("##background", shown)) {
    if (ImGui::Selectable("the style's", background.empty())) background.clear();
    if (ImGui::Selectable("transparent", background == "none")) background = "none";
    for (const char* const colour : {"white", "grey", "black"})
      if (ImGui::Selectable(colour, background == colour)) background = colour;
    ImGui::EndCombo();
  }
  if (!is_colour) return;
  ImGui::SameLine();
  colour_edit("##background_colour", background);
}

}  // namespace

void Cards::draw_scene(const Viewer& viewer, const std::string& input, CardRequests& requests) {
  const SceneFacts& facts = viewer.facts();
  if (!facts.title.empty()) ImGui::TextWrapped("%s", facts.title.c_str());
  ImGui::TextWrapped(
      "%s", fmt::format("{}: {} sphere{}, {}{}", facts.name, grouped(facts.spheres), facts.spheres == 1 ? "" : "s",
                        facts.format, facts.frames > 1 ? fmt::format(", {} frames", grouped(facts.frames)) : "")
                .c_str());
  for (const std::string& warning : facts.warnings) {
    ImGui::PushStyleColor(ImGuiCol_Text, kBad);
    ImGui::TextWrapped("%s", warning.c_str());
    ImGui::PopStyleColor();
  }
  if (!facts.rules.empty() && ImGui::CollapsingHeader("How it was read", ImGuiTreeNodeFlags_DefaultOpen))
    for (const std::string& rule : facts.rules) hint(rule);
  for (const ReadingSetting& row : reading_settings()) {
    if (row.label.empty() || !has_input(row, facts, input)) continue;
    const std::string title(row.label);
    std::string text;
    for (const auto& [given, value] : reading.all())
      if (given->id == row.id) text = given->value_name.empty() ? "true" : value;
    bool changed = false;
    if (row.value_name.empty()) {
      bool on = !text.empty();
      ImGui::PushID(title.c_str());
      changed = ImGui::Checkbox(title.c_str(), &on);
      ImGui::PopID();
      text = on ? "true" : "";
    } else {
      changed = fields_.text(title, std::string(row.empty_means).c_str(), text);
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.help.c_str());
    if (!changed) continue;
    GivenReading wanted = with_setting(reading, row, text);
    if (text.empty() || wanted.has(row.id)) requests.reading = std::move(wanted);
  }
}

bool Cards::draw_sections(std::string_view card, const Viewer& viewer, ViewerSettings& settings, ViewerLook& look) {
  bool changed = false;
  for (const CardSection& section : card_sections())
    if (section.card == card) changed = controls_.draw(section, viewer.facts(), settings, look) || changed;
  return changed;
}

bool Cards::draw_style(const Viewer& viewer, ViewerSettings& settings, ViewerLook& look) {
  const SceneFacts& facts = viewer.facts();
  if (!facts.takes_style) {
    hint("This scene has a look of its own. Styles are for files.");
  } else {
    // Tiles in two columns; without a name the default, or the file's own.
    const float across = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    int column = 0;
    const auto tile = [&](const std::string& name, const std::string& value, const std::string& help) {
      if (column++ % 2 != 0) ImGui::SameLine();
      const bool is_chosen =
          look.style == value || (look.style.empty() && facts.is_file_of_spheres && value == "default");
      if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, kChosen);
      if (ImGui::Button(name.c_str(), {across, 0})) look.style = value;
      if (is_chosen) ImGui::PopStyleColor();
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help.c_str());
    };
    if (!facts.is_file_of_spheres) tile("the file's own", "", "As the scene file says");
    for (const std::string& name : style_names()) tile(name, name, style_named(name).value().description);
  }
  draw_background(look.background);
  return draw_sections("style", viewer, settings, look);
}

void Cards::draw_show(const Viewer& viewer) {
  groups_.draw_list(viewer, rows);
  heading("By expression");
  rows.draw(viewer.facts());
  if (!group("How to select")) return;
  hint(
      "Such as: chain A and not water; element C and z > 3; within 5 of resname HOH. Looks are done from top to "
      "bottom.");
  std::string names;
  for (const std::string& name : viewer.facts().attributes) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty()) hint("Names here: " + names);
}

void Cards::draw_measure(const Viewer& viewer, const std::string& input) {
  hint(
      "Click spheres to pin them: two give a distance, three an angle, four a dihedral. A pointer that rests on a "
      "sphere names it.");
  if (const std::optional<std::string> selection = pins.draw_list()) {
    rows.begin(*selection);
    show("show", input);
  }
  if (group("Area and volume")) union_.draw(viewer, fields_);
}

void Cards::draw_share(CardRequests& requests) {
  static constexpr std::pair<const char*, CommandOf> kKinds[] = {{"a picture", CommandOf::picture},
                                                                 {"this window", CommandOf::window},
                                                                 {"a page, one file", CommandOf::page},
                                                                 {"a scene file", CommandOf::scene_file}};
  hint("A command brings back scene, look, view, camera and settings.");
  label("Of");
  const char* chosen = "";
  for (const auto& [name, kind] : kKinds)
    if (kind == command_of) chosen = name;
  if (ImGui::BeginCombo("##kind", chosen)) {
    for (const auto& [name, kind] : kKinds)
      if (ImGui::Selectable(name, kind == command_of)) command_of = kind;
    ImGui::EndCombo();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, kDim);
  ImGui::TextWrapped("%s", command.c_str());
  ImGui::PopStyleColor();
  if (ImGui::Button("Copy as command", {-1, 0})) requests.copy = command_of;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the key C");
}

void Cards::draw_more(const Viewer& viewer, const FrameReport& report, ViewerSettings& settings, ViewerLook& look,
                      const Layout& layout, const std::string& input, CardRequests& requests) {
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float across = (ImGui::GetContentRegionAvail().x - 3 * space) / 4;
  if (layout.is_narrow()) {
    bool is_first = true;
    for (const Card& card : cards()) {
      if (!card.is_second) continue;
      if (!is_first) ImGui::SameLine();
      is_first = false;
      card_button(card, across, input);
    }
  }
  heading("Camera");
  label("Projection");
  if (ImGui::BeginCombo("##projection", name_of(kProjections, settings.camera.projection).c_str())) {
    for (const auto& [name, projection] : kProjections)
      if (ImGui::Selectable(name.c_str(), settings.camera.projection == projection))
        settings.camera = projected(settings.camera, projection);
    ImGui::EndCombo();
  }
  int column = 0;
  const auto button = [&](const std::string& name) {
    if (column++ % 4 != 0) ImGui::SameLine();
    return ImGui::Button(name.c_str(), {across, 0});
  };
  for (const auto& [name, side] : kSides)
    if (button(name)) requests.side = side;
  if (button("Home")) requests.home = true;
  for (const CardSection& section : card_sections()) {
    if (section.card != "more") continue;
    if (section.group == ParameterGroup::picture) {
      heading("Picture");
      label("Engine");
      if (ImGui::RadioButton("GPU", settings.engine == ViewerEngine::gpu) && viewer.has_gl())
        settings.engine = ViewerEngine::gpu;
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s",
                          viewer.has_gl() ? viewer.gl_description().c_str() : "no graphics processor that can do it");
      ImGui::SameLine();
      if (ImGui::RadioButton("CPU", settings.engine == ViewerEngine::cpu)) settings.engine = ViewerEngine::cpu;
    }
    controls_.draw(section, viewer.facts(), settings, look);
  }
  if (group("Laboratory")) draw_laboratory(viewer, report, settings, requests);
  heading("Window");
  if (ImGui::Button("Mouse and keys (?)", {-1, 0})) requests.help = true;
}

void Cards::draw_laboratory(const Viewer& viewer, const FrameReport& report, ViewerSettings& settings,
                            CardRequests& requests) {
  const std::string fps = report.fps > 0 ? fmt::format("{:.1f} frames/s moving", report.fps) : "move to see frames/s";
  ImGui::TextColored(kDim, "%s", fmt::format("{}   {:.3g} Mray/s", fps, report.mray_per_s).c_str());
  const std::string progress = report.settled       ? "all drawn"
                               : report.divisor > 1 ? fmt::format("1/{} of width and height", report.divisor)
                                                    : fmt::format("{:.0f} %", 100 * report.done);
  ImGui::ProgressBar(static_cast<float>(report.done), {-1, ImGui::GetTextLineHeight() / 3}, "");
  ImGui::TextColored(kDim, "%s", progress.c_str());
  if (settings.engine == ViewerEngine::gpu) hint(viewer.gl_description());
  label("View");
  if (ImGui::BeginCombo("##view", name_of(kViews, settings.view).c_str(), ImGuiComboFlags_HeightLarge)) {
    int number = 1;
    for (const auto& [name, view] : kViews) {
      const std::string entry = std::to_string(number++) + "  " + name;
      if (ImGui::Selectable(entry.c_str(), settings.view == view)) settings.view = view;
    }
    ImGui::EndCombo();
  }
  heading("Tree");
  limit_slider("max_prims", settings.max_prims, kMostPrims);
  limit_slider("max_depth", settings.max_depth, kMostDepth);
  ImGui::BeginDisabled(searches || needs_reference_tree(settings));
  if (ImGui::Button("Search limits that suit these spheres", {-1, 0})) requests.tune = true;
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("as bihive tune, in about ten seconds; pictures keep their bits.\nFor the CPU engine's own tree");
  table.draw();
  hint("The GPU traverses the reference tree, the CPU the wide one.");
}

}  // namespace bihive::window
