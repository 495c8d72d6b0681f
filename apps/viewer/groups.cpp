#include "groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/image/colour_text.h"
#include "bihive/scene/named_materials.h"

namespace bihive::window {
namespace {

constexpr std::size_t kMostInLegend = 8;
constexpr std::array kActions{"hide", "colour", "opacity", "material"};

std::string all_but(const std::string& selection) {
  return "not (" + selection + ")";
}

ImVec4 colour_of(const std::string& text) {
  const Vec3d colour = colour_from_text(text, Transfer::none).value_or(Vec3d{0.5, 0.5, 0.5});
  return {static_cast<float>(colour.x), static_cast<float>(colour.y), static_cast<float>(colour.z), 1};
}

std::string heading_of(const std::string& attribute) {
  static const std::map<std::string, std::string> kTitles{
      {"kind", "Kinds"}, {"ligand", "Ligands"}, {"chain", "Chains"}, {"element", "Elements"}, {"type", "Types"}};
  const auto at = kTitles.find(attribute);
  return at == kTitles.end() ? attribute : at->second;
}

}  // namespace

void Groups::forget() {
  has_groups_ = has_legend_ = false;
}

void Groups::update(const Viewer& viewer) {
  if (!has_groups_) groups_ = contents_of(viewer.input_spheres());
  has_groups_ = true;
}

void Groups::update_legend(const Viewer& viewer) {
  if (has_legend_) return;
  has_legend_ = true;
  legend_.clear();
  colours_.clear();
  const auto keys = *json_from_text<nlohmann::json>(legend_to_json(viewer.scene()));
  for (const nlohmann::json& key : keys) {
    Key one;
    one.title = key.at("title").get<std::string>();
    if (const nlohmann::json& scale = key.at("scale"); scale.is_object()) {
      one.least = fmt::format("{:.3g}", scale.at("least").get<double>());
      one.most = fmt::format("{:.3g}", scale.at("most").get<double>());
      one.scale = scale.at("colours").get<std::vector<std::string>>();
    }
    for (const nlohmann::json& entry : key.at("entries")) {
      const std::string selection = entry.at("select").get<std::string>(),
                        colour = entry.at("colour").get<std::string>();
      if (selection.empty()) continue;
      one.entries.push_back({entry.at("name").get<std::string>(), selection, colour});
      colours_[selection] = colour;
    }
    if (!one.scale.empty() || !one.entries.empty()) legend_.push_back(std::move(one));
  }
}

bool Groups::is_only(const LookRows& rows, const std::string& selection) const {
  return rows.value(all_but(selection), "hide").has_value();
}

// Of all groups at most one is alone.
void Groups::show_only(LookRows& rows, const std::string& selection, bool only) const {
  for (const ContentGroup& other : groups_)
    if (is_only(rows, other.selection)) rows.set(all_but(other.selection), "hide", std::nullopt);
  for (const auto& [other, colour] : colours_)
    if (is_only(rows, other)) rows.set(all_but(other), "hide", std::nullopt);
  if (is_only(rows, selection)) rows.set(all_but(selection), "hide", std::nullopt);
  if (!only) return;
  if (rows.value(selection, "hide")) rows.set(selection, "hide", std::nullopt);
  rows.set(all_but(selection), "hide", "");
}

void Groups::draw_details(const Entry& entry, LookRows& rows) const {
  const std::string& selection = entry.selection;
  ImGui::TextUnformatted(entry.name.c_str());
  const bool only = is_only(rows, selection);
  if (ImGui::Button(only ? "All again" : "Only this")) show_only(rows, selection, !only);
  ImGui::SameLine();
  if (ImGui::Button("As it was")) {
    for (const char* const action : kActions)
      if (rows.value(selection, action)) rows.set(selection, action, std::nullopt);
    if (only) show_only(rows, selection, false);
  }
  std::string colour = rows.value(selection, "colour").value_or(entry.colour);
  if (colour_edit("Colour", colour)) rows.set(selection, "colour", colour);
  ImGui::SameLine();
  ImGui::TextUnformatted("Colour");
  auto opacity = static_cast<float>(std::atof(rows.value(selection, "opacity").value_or("1").c_str()));
  ImGui::SetNextItemWidth(10 * ImGui::GetFontSize());
  if (ImGui::SliderFloat("Opacity", &opacity, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
    const bool is_usual = opacity >= 0.995F;
    rows.set(selection, "opacity", is_usual ? std::nullopt : std::optional(fmt::format("{:.2f}", opacity)));
  }
  const std::string material = rows.value(selection, "material").value_or("");
  ImGui::SetNextItemWidth(10 * ImGui::GetFontSize());
  if (!ImGui::BeginCombo("Material", material.empty() ? "the style's" : material.c_str())) return;
  if (ImGui::Selectable("the style's", material.empty())) rows.set(selection, "material", std::nullopt);
  for (const auto& [name, unused] : named_materials())
    if (ImGui::Selectable(name.c_str(), name == material)) rows.set(selection, "material", name);
  ImGui::EndCombo();
}

// A check box that shows and hides, the colour, and the name, which opens the rest.
void Groups::draw_entry(const Entry& entry, LookRows& rows, const std::string& count) {
  ImGui::PushID(entry.selection.c_str());
  bool shown = !rows.value(entry.selection, "hide");
  if (ImGui::Checkbox("##shown", &shown)) rows.set(entry.selection, "hide", shown ? std::nullopt : std::optional(""));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Show %s", entry.name.c_str());
  ImGui::SameLine();
  const float side = ImGui::GetTextLineHeight();
  const std::string colour = rows.value(entry.selection, "colour").value_or(entry.colour);
  if (!colour.empty()) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float lower = (ImGui::GetFrameHeight() - side) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + lower}, {corner.x + side, corner.y + lower + side},
                                              ImGui::ColorConvertFloat4ToU32(colour_of(colour)), side / 4);
  }
  ImGui::Dummy({side, side});
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const float wide = ImGui::CalcTextSize(count.c_str()).x;
  const float room =
      count.empty() ? ImGui::CalcTextSize(entry.name.c_str()).x : ImGui::GetContentRegionAvail().x - wide;
  if (ImGui::Selectable(entry.name.c_str(), false, 0, {room, 0})) ImGui::OpenPopup("details");
  if (!count.empty()) {
    ImGui::SameLine(0, 0);
    ImGui::TextColored(kDim, "%s", count.c_str());
  }
  if (ImGui::BeginPopup("details")) {
    draw_details(entry, rows);
    ImGui::EndPopup();
  }
  ImGui::PopID();
}

void Groups::draw_list(const Viewer& viewer, LookRows& rows) {
  update(viewer);
  update_legend(viewer);
  std::string of;
  for (const ContentGroup& one : groups_) {
    if (one.of != of) heading(heading_of(one.of).c_str());
    of = one.of;
    const auto colour = colours_.find(one.selection);
    ImGui::PushID(one.of.c_str());
    draw_entry({one.name, one.selection, colour == colours_.end() ? "" : colour->second}, rows, grouped(one.count));
    ImGui::PopID();
  }
}

bool Groups::draw_legend(const Viewer& viewer, LookRows& rows, ImVec2 corner, float most_height, Covered& covered) {
  update_legend(viewer);
  if (legend_.empty()) return false;
  bool more = false;
  const float widest = 16 * ImGui::GetFontSize();
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {widest, most_height});
  ImGui::SetNextWindowBgAlpha(0.88F);
  ImGui::Begin("legend", nullptr, (kOverlay & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize);
  covered.add_window();
  for (std::size_t k = 0; k < legend_.size(); ++k) {
    const Key& key = legend_[k];
    ImGui::PushID(static_cast<int>(k));
    if (!key.title.empty()) ImGui::TextColored(kDim, "%s", key.title.c_str());
    if (!key.scale.empty()) {
      const ImVec2 at = ImGui::GetCursorScreenPos(), size{widest * 0.75F, ImGui::GetTextLineHeight() * 0.7F};
      const float step = size.x / static_cast<float>(key.scale.size() - 1);
      for (std::size_t i = 0; i + 1 < key.scale.size(); ++i) {
        const ImU32 left = ImGui::ColorConvertFloat4ToU32(colour_of(key.scale[i]));
        const ImU32 right = ImGui::ColorConvertFloat4ToU32(colour_of(key.scale[i + 1]));
        const float x = at.x + step * static_cast<float>(i);
        ImGui::GetWindowDrawList()->AddRectFilledMultiColor({x, at.y}, {x + step, at.y + size.y}, left, right, right,
                                                            left);
      }
      ImGui::Dummy(size);
      ImGui::TextUnformatted(key.least.c_str());
      ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + size.x - ImGui::CalcTextSize(key.most.c_str()).x);
      ImGui::TextUnformatted(key.most.c_str());
    }
    const std::size_t all = key.scale.empty() ? key.entries.size() : 0;
    const std::size_t shown = all > kMostInLegend + 1 ? kMostInLegend : all;
    for (std::size_t i = 0; i < shown; ++i) draw_entry(key.entries[i], rows, "");
    if (shown < all) more = ImGui::Button(fmt::format("{} more...", all - shown).c_str()) || more;
    ImGui::PopID();
  }
  ImGui::End();
  return more;
}

}  // namespace bihive::window
