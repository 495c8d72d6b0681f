#include "look_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bihive/scene/element_colours.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/named_materials.h"
#include "bihive/scene/style.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

constexpr const char* kTransparent = "none";

bool has_value(const std::string& action) {
  const LookActionText* const row = look_action_named(action);
  return row != nullptr && !row->value.empty();
}

// A list to choose from; the names of `choices` are stored, the empty one is shown as `otherwise`.
bool combo(const char* name, const std::vector<std::string>& choices, const char* otherwise, std::string& chosen) {
  label(name);
  const std::string id = std::string("##") + name;
  bool changed = false;
  if (!ImGui::BeginCombo(id.c_str(), chosen.empty() ? otherwise : chosen.c_str(), ImGuiComboFlags_HeightLarge))
    return false;
  for (const std::string& choice : choices) {
    if (!ImGui::Selectable(choice.empty() ? otherwise : choice.c_str(), choice == chosen)) continue;
    changed = choice != chosen;
    chosen = choice;
  }
  ImGui::EndCombo();
  return changed;
}

bool draw_style(const SceneFacts& facts, std::string& style) {
  if (!facts.takes_style) {
    label("style");
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(kDim, "the scene's own");
    return false;
  }
  std::vector<std::string> choices = style_names();
  choices.insert(choices.begin(), "");
  return combo("style", choices, facts.is_file_of_spheres ? "default" : "the file's own", style);
}

// The style's, transparent, or a colour.
bool draw_background(std::string& background) {
  label("background");
  const bool is_colour = !background.empty() && background != kTransparent;
  bool changed = false;
  const char* const shown = is_colour ? background.c_str() : background.empty() ? "the style's" : "transparent";
  if (ImGui::BeginCombo("##background", shown)) {
    const std::array<std::pair<const char*, const char*>, 5> choices{
        {{"the style's", ""}, {"transparent", kTransparent}, {"white", "white"}, {"grey", "grey"}, {"black", "black"}}};
    for (const auto& [words, value] : choices)
      if (ImGui::Selectable(words, background == value)) {
        changed = background != value;
        background = value;
      }
    ImGui::EndCombo();
  }
  return changed;
}

// A menu of names, opened by an arrow beside a field.
bool names_arrow(const char* id, const std::vector<std::string>& names, std::string& chosen) {
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  bool changed = false;
  if (!ImGui::BeginCombo(id, nullptr, ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) return false;
  for (const std::string& name : names)
    if (ImGui::Selectable(name.c_str())) {
      chosen = name;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

// True when the user has finished the text.
bool text_field(const char* id, const char* hint, float width, std::string& text) {
  ImGui::SetNextItemWidth(width);
  ImGui::InputTextWithHint(id, hint, &text);
  return ImGui::IsItemDeactivatedAfterEdit();
}

std::vector<std::string> values_for(const LookActionText& action, const SceneFacts& facts) {
  if (action.names == ValueNames::attributes) return facts.attributes;
  std::vector<std::string> names;
  if (action.names == ValueNames::materials)
    for (const auto& material : named_materials()) names.push_back(material.first);
  return action.names == ValueNames::colours ? colour_names() : names;
}

}  // namespace

bool LookPanel::EditedRow::complete() const {
  return !has_value(row.action) || !row.value.empty();
}

void LookPanel::start_anew(const ViewerLook& look) {
  rows_.clear();
  sent_.clear();
  for (const LookRow& row : look.rows) rows_.push_back({row, "", false});
}

std::string LookPanel::answered(const Result<std::vector<std::int64_t>>& counts, std::size_t failed_row) {
  for (std::size_t i = 0; rows_sent_ && i < sent_.size(); ++i) {
    EditedRow& row = rows_[sent_[i]];
    row.is_fault = !counts && i == failed_row;
    row.words.clear();
    if (counts) row.words = fmt::format("{} sphere{}", (*counts)[i], (*counts)[i] == 1 ? "" : "s");
    if (!row.is_fault) continue;
    const int column = counts.error().column;
    row.words = (column > 0 ? fmt::format("column {}: ", column) : "") + counts.error().to_string();
  }
  const bool is_said = rows_sent_ && failed_row < sent_.size();
  return counts || is_said ? "" : counts.error().to_string();
}

bool LookPanel::draw_value(const SceneFacts& facts, LookRow& row) const {
  if (!has_value(row.action)) return false;
  ImGui::SameLine();
  const LookActionText& action = *look_action_named(row.action);
  const std::vector<std::string> values = values_for(action, facts);
  const float arrow = values.empty() ? 0 : ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
  bool changed =
      text_field("##value", std::string(action.example).c_str(), ImGui::GetContentRegionAvail().x - arrow, row.value);
  if (!values.empty()) changed = names_arrow("##values", values, row.value) || changed;
  return changed;
}

bool LookPanel::draw_row(const SceneFacts& facts, std::size_t number, bool& removed) {
  EditedRow& edited = rows_[number];
  LookRow& row = edited.row;
  ImGui::PushID(static_cast<int>(number));
  const float square = ImGui::GetFrameHeight(), space = ImGui::GetStyle().ItemInnerSpacing.x;
  bool changed = text_field("##select", "all", ImGui::GetContentRegionAvail().x - 2 * (square + space), row.select);
  std::string name;
  if (names_arrow("##names", facts.attributes, name)) row.select += (row.select.empty() ? "" : " ") + name + " ";
  ImGui::SameLine(0, space);
  removed = ImGui::Button("x", {square, 0});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("remove this look");

  ImGui::SetNextItemWidth(0.36F * ImGui::GetWindowWidth());
  if (ImGui::BeginCombo("##action", row.action.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string& action : look_action_names())
      if (ImGui::Selectable(action.c_str(), action == row.action) && action != row.action) {
        row.action = action;
        row.value.clear();
        changed = true;
      }
    ImGui::EndCombo();
  }
  changed = draw_value(facts, row) || changed;
  if (!edited.words.empty()) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(edited.is_fault ? kBad : kDim, "%s", edited.words.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::PopID();
  return changed;
}

std::optional<ViewerLook> LookPanel::draw(const Viewer& viewer) {
  const SceneFacts& facts = viewer.facts();
  ViewerLook look = viewer.look();
  bool changed = draw_style(facts, look.style);
  std::vector<std::string> element_colours = element_colour_names();
  element_colours.insert(element_colours.begin(), "");
  if (facts.has_elements) changed = combo("elements", element_colours, "the style's", look.element_colours) || changed;
  changed = draw_background(look.background) || changed;

  bool rows_changed = false;
  std::optional<std::size_t> to_remove;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    bool removed = false;
    rows_changed = draw_row(facts, i, removed) || rows_changed;
    if (removed) to_remove = i;
  }
  if (to_remove) rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(*to_remove));
  for (EditedRow& row : rows_)
    if (rows_changed || to_remove) row.words.clear();
  if (ImGui::Button("add a look for a selection", {-1, 0})) rows_.push_back({{"", "colour", ""}, "", false});
  if (!changed && !rows_changed && !to_remove) return std::nullopt;

  // Incomplete rows wait; a change of something else is applied with the current rows.
  rows_sent_ = rows_changed || to_remove;
  if (rows_sent_) {
    look.rows.clear();
    sent_.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i].complete()) continue;
      sent_.push_back(i);
      look.rows.push_back(rows_[i].row);
    }
  }
  if (look == viewer.look()) return std::nullopt;
  return look;
}

}  // namespace bihive::window
