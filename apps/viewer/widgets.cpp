#include "widgets.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "bihive/image/colour_text.h"

namespace bihive::window {

std::string sentence(std::string_view text) {
  std::string written(text);
  if (!written.empty() && written[0] >= 'a' && written[0] <= 'z')
    written[0] = static_cast<char>(written[0] - 'a' + 'A');
  return written;
}

std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

void heading(const char* text) {
  ImGui::Dummy({0, ImGui::GetStyle().ItemSpacing.y * 0.4F});
  ImGui::Separator();
  ImGui::TextColored(kDim, "%s", text);
}

void label(const std::string& text) {
  ImGui::AlignTextToFramePadding();
  const float begin = ImGui::GetWindowContentRegionMin().x + 0.38F * ImGui::GetWindowWidth();
  const std::string shown = elided(text, begin - ImGui::GetCursorPosX() - ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::SameLine(begin);
  ImGui::SetNextItemWidth(-1);
}

void hint(const std::string& text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(kDim, "%s", text.c_str());
  ImGui::PopTextWrapPos();
}

bool group(const char* name) {
  return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_None);
}

bool choice(const char* name, const char* otherwise, const std::vector<std::string>& names, std::string& chosen) {
  label(name);
  const std::string before = chosen, id = std::string("##") + name;
  if (!ImGui::BeginCombo(id.c_str(), chosen.empty() ? otherwise : chosen.c_str(), ImGuiComboFlags_HeightLarge))
    return false;
  if (ImGui::Selectable(otherwise, before.empty())) chosen.clear();
  for (const std::string& one : names)
    if (ImGui::Selectable(one.c_str(), one == before)) chosen = one;
  ImGui::EndCombo();
  return chosen != before;
}

bool check(const char* name, bool& value) {
  label(name);
  return ImGui::Checkbox((std::string("##") + name).c_str(), &value);
}

bool colour_edit(const char* id, std::string& colour) {
  constexpr double kGrey = 0.5;
  const Vec3d now = colour_from_text(colour, Transfer::none).value_or(Vec3d{kGrey, kGrey, kGrey});
  std::array<float, 3> rgb{static_cast<float>(now.x), static_cast<float>(now.y), static_cast<float>(now.z)};
  if (!ImGui::ColorEdit3(id, rgb.data(), ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel)) return false;
  const auto byte = [&](std::size_t i) { return std::lround(255 * rgb[i]); };
  colour = fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
  return true;
}

std::string elided(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string shorter = text;
  while (!shorter.empty() && ImGui::CalcTextSize((shorter + "...").c_str()).x > width) {
    // A character of UTF-8 begins at the last byte that is not a continuation.
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0) == 0x80) shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
  }
  return shorter + "...";
}

void Covered::add_window() {
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  areas_.emplace_back(corner.x, corner.y, corner.x + size.x, corner.y + size.y);
}

bool Covered::has(double x, double y) const {
  for (const ImVec4& area : areas_)
    if (x >= area.x && x < area.z && y >= area.y && y < area.w) return true;
  return false;
}

bool Fields::text(const std::string& name, const char* hint, std::string& value) {
  label(name);
  std::string shown = edited_ == name ? text_ : value;
  ImGui::InputTextWithHint(("##" + name).c_str(), hint, &shown);
  if (ImGui::IsItemActive()) {
    edited_ = name;
    text_ = shown;
  } else if (edited_ == name) {
    edited_.clear();
  }
  if (!ImGui::IsItemDeactivatedAfterEdit() || shown == value) return false;
  value = shown;
  return true;
}

bool Fields::number(const std::string& name, const char* hint, double otherwise, double& value) {
  std::string shown = value == otherwise ? "" : fmt::format("{:g}", value);
  if (!text(name, hint, shown)) return false;
  char* end = nullptr;
  const double given = std::strtod(shown.c_str(), &end);
  const bool is_number = !shown.empty() && *end == '\0' && std::isfinite(given) && given >= 0;
  value = is_number ? given : otherwise;
  return true;
}

void Fields::forget() {
  edited_.clear();
  text_.clear();
}

}  // namespace bihive::window
