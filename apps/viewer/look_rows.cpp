#include "look_rows.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "bihive/scene/look_text.h"
#include "bihive/scene/named_materials.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

// No selection means all spheres.
bool same_selection(const std::string& a, const std::string& b) {
  const auto is_all = [](const std::string& text) { return text.empty() || text == "all"; };
  return a == b || (is_all(a) && is_all(b));
}

bool has_value(const std::string& action) {
  const LookActionText* const row = look_action_named(action);
  return row != nullptr && !row->value.empty();
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

bool LookRows::EditedRow::complete() const {
  return !has_value(row.action) || !row.value.empty();
}

void LookRows::start_anew(const ViewerLook& look) {
  rows_.clear();
  sent_.clear();
  changed_ = rows_sent_ = false;
  for (const LookRow& row : look.rows) rows_.push_back({row, "", false});
}

std::string LookRows::answered(const Result<std::vector<std::int64_t>>& counts, std::size_t failed_row) {
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

bool LookRows::draw_value(const SceneFacts& facts, LookRow& row) const {
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

bool LookRows::draw_row(const SceneFacts& facts, std::size_t number, bool& removed) {
  EditedRow& edited = rows_[number];
  LookRow& row = edited.row;
  ImGui::PushID(static_cast<int>(number));
  const float square = ImGui::GetFrameHeight(), space = ImGui::GetStyle().ItemInnerSpacing.x;
  bool changed = text_field("##select", "all", ImGui::GetContentRegionAvail().x - 2 * (square + space), row.select);
  std::string name;
  if (names_arrow("##names", facts.attributes, name)) row.select += (row.select.empty() ? "" : " ") + name + " ";
  ImGui::SameLine(0, space);
  removed = ImGui::Button("x", {square, 0});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Remove this look");

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

void LookRows::draw(const SceneFacts& facts) {
  bool rows_changed = false;
  std::optional<std::size_t> to_remove;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    bool removed = false;
    rows_changed = draw_row(facts, i, removed) || rows_changed;
    if (removed) to_remove = i;
  }
  if (to_remove) rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(*to_remove));
  if (ImGui::Button("Add a look for a selection", {-1, 0})) begin("");
  changed_ = changed_ || rows_changed || to_remove;
}

std::optional<std::string> LookRows::value(const std::string& select, const std::string& action) const {
  for (const EditedRow& one : rows_)
    if (same_selection(one.row.select, select) && one.row.action == action) return one.row.value;
  return std::nullopt;
}

void LookRows::set(const std::string& select, const std::string& action, const std::optional<std::string>& value) {
  const auto same = [&](const EditedRow& one) {
    return same_selection(one.row.select, select) && one.row.action == action;
  };
  changed_ = true;
  if (!value) {
    std::erase_if(rows_, same);
    return;
  }
  const auto at = std::find_if(rows_.begin(), rows_.end(), same);
  if (at == rows_.end())
    rows_.push_back({{select, action, *value}, "", false});
  else
    at->row.value = *value;
}

void LookRows::put_into(ViewerLook& look) {
  rows_sent_ = std::exchange(changed_, false);
  if (!rows_sent_) return;
  look.rows.clear();
  sent_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].words.clear();
    if (!rows_[i].complete()) continue;
    sent_.push_back(i);
    look.rows.push_back(rows_[i].row);
  }
}

}  // namespace bihive::window
