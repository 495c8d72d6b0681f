// Overlays that come and go: messages, progress of long work, the help, the name of the sphere under the pointer.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app.h"
#include "bihive/scene/load_scene.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

constexpr float kBelowChip = 98;
constexpr float kMostWidth = 440;

// Keys and what they do, as docs/viewer.md has them.
constexpr std::array<std::pair<const char*, const char*>, 19> kKeys{{
    {"drag", "turns the scene"},
    {"drag with Shift, or another button", "shifts it"},
    {"wheel, + and -", "closer, farther"},
    {"arrows, with Shift", "turn, shift"},
    {"rest, click", "names a sphere, pins it"},
    {"double click", "turns to a sphere and comes closer"},
    {"Enter", "pins the sphere in the middle"},
    {"1 to 7", "view: shaded, recursion, traversal, normal, distance, id, tree"},
    {"E", "engine: CPU or GPU"},
    {"R, Home", "shows all"},
    {"O", "opens a file: Tab completes, ~ is your own folder"},
    {"S", "saves the picture"},
    {"Ctrl+Z, Shift+Ctrl+Z", "undo, redo"},
    {"C", "copies the picture as a command"},
    {"space , .", "play, one frame back, one on"},
    {"H", "hides the controls"},
    {"? or F1", "this help"},
    {"Esc", "closes it, a card, ends long work, clears pins"},
    {"Q", "ends"},
}};

}  // namespace

void App::begin_overlay(const char* name, ImVec2 corner, ImVec2 pivot, float width) {
  const auto scale = static_cast<float>(window_->text_scale());
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, ImGui::GetIO().DisplaySize.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * scale);
  ImGui::SetNextWindowBgAlpha(0.94F);
  ImGui::Begin(name, nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize);
  covered_.add_window();
}

void App::end_overlay() {
  ImGui::End();
  ImGui::PopStyleVar();
}

void App::draw_overlays(const Layout& layout, CardRequests& requests) {
  draw_work(layout);
  draw_message(layout);
  if (welcomes_) draw_welcome(layout, requests);
  if (help_shown_) draw_help(layout);
  if (tip_ && !popup_open_) draw_tip(layout);
}

void App::draw_message(const Layout& layout) {
  const std::string text = file_to_open_ ? "opening " + *file_to_open_ : message_;
  if (text.empty()) return;
  const float margin = kMargin * layout.scale;
  const float bar = reader_ ? player_bar_height(layout.picture.x, layout.scale) : 0;
  const float width = std::min(layout.display.x - 2 * margin, 1.6F * kMostWidth * layout.scale);
  begin_overlay("message", {layout.display.x / 2, layout.picture.y - bar - margin}, {0.5F, 1}, width);
  ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextColored(file_to_open_ ? kDim : message_is_bad_ ? kBad : kGood, "%s", text.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) message_.clear();
  end_overlay();
}

void App::draw_work(const Layout& layout) {
  if (!save_ && !search_) return;
  const float margin = kMargin * layout.scale;
  const double done = save_ ? save_->done : search_->done();
  begin_overlay("work", {margin, kBelowChip * layout.scale}, {0, 0}, layout.display.x - 2 * margin);
  ImGui::TextUnformatted(
      fmt::format("{}: {:.0f} %", save_ ? "Drawing the picture" : "Searching the tree's limits", 100 * done).c_str());
  ImGui::ProgressBar(static_cast<float>(done), {14 * ImGui::GetFontSize(), ImGui::GetTextLineHeight() / 3}, "");
  if (ImGui::Button("Cancel (Esc)")) end_work();
  end_overlay();
}

void App::draw_welcome(const Layout& layout, CardRequests& requests) {
  const float margin = kMargin * layout.scale;
  const float width = std::min(layout.display.x - 2 * margin, 1.2F * kMostWidth * layout.scale);
  begin_overlay("welcome", {layout.display.x / 2, layout.picture.y - margin}, {0.5F, 1}, width);
  ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted("Drop a file of atoms or points here, or look at one of these:");
  ImGui::PopTextWrapPos();
  constexpr std::array<std::pair<const char*, const char*>, 3> kSamples{
      {{"A protein with its drug", "demo"}, {"Clusters", "scenario2"}, {"Four spheres", "four-spheres"}}};
  for (const auto& [name, scene] : kSamples) {
    if (ImGui::Button(name)) {
      requests.open.built_in = scene;
      welcomes_ = false;
    }
    const float wide = ImGui::CalcTextSize("A protein with its drug").x;
    ImGui::SameLine();
    if (ImGui::GetCursorPosX() + 0.6F * wide > width) ImGui::NewLine();
  }
  if (ImGui::Button("Open...")) {
    open_card("open");
    welcomes_ = false;
  }
  end_overlay();
}

void App::draw_help(const Layout& layout) {
  const float width = std::min(layout.display.x - 2 * kMargin * layout.scale, 1.3F * kMostWidth * layout.scale);
  ImGui::SetNextWindowFocus();
  begin_overlay("help", {layout.display.x / 2, (layout.display.y - layout.bar) / 2}, {0.5F, 0.5F}, width);
  ImGui::TextUnformatted("Mouse and keys");
  ImGui::SameLine(width - ImGui::GetFrameHeight() - ImGui::GetStyle().WindowPadding.x);
  if (ImGui::SmallButton("×")) help_shown_ = false;
  ImGui::Separator();
  const float column = 0.4F * width;
  for (const auto& [keys, effect] : kKeys) {
    const float y = ImGui::GetCursorPosY();
    ImGui::PushTextWrapPos(column);
    ImGui::TextColored(kAccent, "%s", keys);
    ImGui::PopTextWrapPos();
    const float below = ImGui::GetCursorPosY();
    ImGui::SetCursorPos({column + ImGui::GetStyle().ItemSpacing.x, y});
    ImGui::PushTextWrapPos(width - ImGui::GetStyle().WindowPadding.x);
    ImGui::TextUnformatted(effect);
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPosY(std::max(below, ImGui::GetCursorPosY()));
  }
  end_overlay();
}

void App::draw_tip(const Layout& layout) {
  const float away = kMargin * layout.scale;
  const ImVec2 at{static_cast<float>(x_), static_cast<float>(y_)};
  const bool right = at.x < layout.picture.x / 2, below = at.y < layout.picture.y / 2;
  ImGui::SetNextWindowPos({at.x + (right ? away : -away), at.y + (below ? away : -away)}, ImGuiCond_Always,
                          {right ? 0.0F : 1.0F, below ? 0.0F : 1.0F});
  ImGui::SetNextWindowBgAlpha(0.94F);
  ImGui::Begin("tip", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted(tip_->title.c_str());
  ImGui::TextColored(kDim, "%s", tip_->details.c_str());
  ImGui::End();
}

}  // namespace bihive::window
