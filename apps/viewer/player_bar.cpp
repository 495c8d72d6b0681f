#include "player_bar.h"

#include <fmt/format.h>

#include <algorithm>

namespace bihive::window {
namespace {

constexpr float kBarMargin = 8;
constexpr float kBeside = 210, kLeastBar = 420, kMostBar = 760;  // of the width

bool is_small_bar(float picture_width, double text_scale) {
  return static_cast<double>(picture_width) / text_scale < kLeastBar;
}

}  // namespace

float player_bar_height(float picture_width, double text_scale) {
  const float row = ImGui::GetFrameHeight();
  const float rows = is_small_bar(picture_width, text_scale) ? 2 * row + ImGui::GetStyle().ItemSpacing.y : row;
  return rows + 2 * kBarMargin * static_cast<float>(text_scale);
}

bool player_bar_is_wide(float picture_width, double text_scale) {
  return static_cast<double>(picture_width) / text_scale - 2 * kBeside < kLeastBar;
}

PlayerRequests draw_player_bar(const Player& player, const SceneFacts& facts, ImVec2 picture, double text_scale,
                               Covered& covered) {
  PlayerRequests requests;
  const auto scale = static_cast<float>(text_scale);
  const float height = player_bar_height(picture.x, text_scale);
  // Between the legend and the buttons for zoom, or over all of a small picture.
  const float width = player_bar_is_wide(picture.x, text_scale)
                          ? picture.x
                          : std::min(picture.x - 2 * kBeside * scale, kMostBar * scale);
  ImGui::SetNextWindowPos({(picture.x - width) / 2, picture.y - height});
  ImGui::SetNextWindowSize({width, height});
  ImGui::SetNextWindowBgAlpha(0.85F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kBarMargin * scale, kBarMargin * scale});
  ImGui::Begin("player", nullptr, kOverlay | ImGuiWindowFlags_NoBringToFrontOnFocus);
  covered.add_window();

  const float wide = 56 * scale;
  if (ImGui::Button(player.playing() ? "Pause" : "Play", {wide, 0})) requests.toggles = true;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("space");
  ImGui::SameLine();
  if (ImGui::Button("<")) requests.step = -1;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("one frame back: the key ,");
  ImGui::SameLine();
  if (ImGui::Button(">")) requests.step = 1;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("one frame on: the key .");

  // The time line fills the remaining space.
  const std::int64_t first = 0, last = player.frames() - 1;
  std::int64_t frame = player.frame();
  const std::string time = facts.time_ps && player.is_shown() ? fmt::format(", {:g} ps", *facts.time_ps) : "";
  const std::string words = fmt::format("{} of 0 to {}{}", frame, last, time);
  const auto time_line = [&](float across) {
    ImGui::SetNextItemWidth(across);
    if (ImGui::SliderScalar("##frame", ImGuiDataType_S64, &frame, &first, &last, words.c_str(),
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput))
      requests.frame = frame;
  };
  const bool is_small = is_small_bar(picture.x, text_scale);
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float after = 76 * scale + ImGui::CalcTextSize("Loop").x + ImGui::GetFrameHeight() + 4 * space;
  ImGui::SameLine();
  if (!is_small) {
    time_line(std::max(40 * scale, ImGui::GetContentRegionAvail().x - after));
    ImGui::SameLine();
  }
  ImGui::SetNextItemWidth(76 * scale);
  auto speed = static_cast<float>(player.frames_per_second());
  if (ImGui::DragFloat("##speed", &speed, 0.2F, static_cast<float>(kSlowestPlay), static_cast<float>(kFastestPlay),
                       "%.4g fps", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    requests.frames_per_second = static_cast<double>(speed);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("frames per second; drag, or double-click to type");
  ImGui::SameLine();
  bool loops = player.loops();
  if (ImGui::Checkbox("Loop", &loops)) requests.loops = loops;
  if (is_small) time_line(-1);
  ImGui::End();
  ImGui::PopStyleVar();
  return requests;
}

}  // namespace bihive::window
