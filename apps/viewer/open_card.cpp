#include "open_card.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "bihive/io/known_formats.h"
#include "bihive/scene/load_scene.h"

namespace bihive::window {

void OpenCard::begin(const std::string& shown) {
  const std::size_t slash = is_built_in_scene(shown) ? std::string::npos : shown.rfind('/');
  typed_ = slash == std::string::npos ? "" : shown.substr(0, slash + 1);
  list();
}

void OpenCard::list() {
  names_ = matching_files(typed_);
  chosen_ = -1;
  scroll_ = true;
}

void OpenCard::type(const std::string& text) {
  typed_ += text;
  list();
}

void OpenCard::erase() {
  // A UTF-8 character begins at the last byte that is not a continuation.
  while (!typed_.empty() && (static_cast<unsigned char>(typed_.back()) & 0xC0) == 0x80) typed_.pop_back();
  if (!typed_.empty()) typed_.pop_back();
  list();
}

void OpenCard::complete() {
  typed_ = chosen_ >= 0 ? with_last_name(typed_, names_[static_cast<std::size_t>(chosen_)]) : completed(typed_, names_);
  list();
}

void OpenCard::move(int by) {
  if (names_.empty()) return;
  chosen_ = std::clamp(chosen_ + by, -1, static_cast<int>(names_.size()) - 1);
  scroll_ = true;
}

std::optional<std::string> OpenCard::take(const FileName& name) {
  typed_ = with_last_name(typed_, name);
  if (!name.is_folder) return with_home(typed_);
  list();
  return std::nullopt;
}

std::optional<std::string> OpenCard::take() {
  if (chosen_ >= 0) return take(names_[static_cast<std::size_t>(chosen_)]);
  if (typed_.empty()) return std::nullopt;
  const std::string path = with_home(typed_);
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return path;
  if (typed_.back() != '/') typed_ += '/';
  list();
  return std::nullopt;
}

OpenRequests OpenCard::draw(const Viewer& viewer, Fields& fields) {
  OpenRequests requests;
  hint("A file of spheres or a scene file. Tab completes, ~ is your own folder, Enter opens.");
  // The end of a long path is what is being typed.
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImGui::GetStyle().FramePadding);
  ImGui::BeginChild(
      "path", {0, ImGui::GetFrameHeight()}, false,
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::TextUnformatted((typed_ + "_").c_str());
  ImGui::SetScrollX(ImGui::GetScrollMaxX());
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();

  constexpr int kLines = 10;
  ImGui::BeginChild("names", {0, kLines * ImGui::GetTextLineHeightWithSpacing()}, false, ImGuiWindowFlags_NoNavInputs);
  if (names_.empty()) ImGui::TextColored(kDim, "No such file here");
  std::optional<FileName> clicked;
  for (int i = 0; i < static_cast<int>(names_.size()); ++i) {
    const FileName& one = names_[static_cast<std::size_t>(i)];
    ImGui::PushID(i);
    if (ImGui::Selectable((one.name + (one.is_folder ? "/" : "")).c_str(), i == chosen_)) clicked = one;
    if (i == std::max(chosen_, 0) && scroll_) ImGui::SetScrollHereY();
    ImGui::PopID();
  }
  scroll_ = false;
  ImGui::EndChild();
  if (clicked) requests.file = take(*clicked);

  if (!recent.empty()) {
    label("Recent");
    if (ImGui::BeginCombo("##recent", "opened before", ImGuiComboFlags_HeightLarge)) {
      for (const std::string& path : recent)
        if (ImGui::Selectable(path.c_str())) requests.file = path;
      ImGui::Separator();
      if (ImGui::Selectable("Forget these names")) requests.forget = true;
      ImGui::EndCombo();
    }
  }
  const SceneFacts& facts = viewer.facts();
  const BuiltInScene* shown = nullptr;
  for (const BuiltInScene& one : kBuiltInScenes)
    if (facts.name == one.name) shown = &one;
  label("Built-in");
  if (ImGui::BeginCombo("##built_in", shown == nullptr ? "a file" : shown->title, ImGuiComboFlags_HeightLarge)) {
    for (const BuiltInScene& one : kBuiltInScenes)
      if (ImGui::Selectable(one.title, &one == shown)) requests.built_in = one.name;
    ImGui::EndCombo();
  }
  if (shown != nullptr && shown->kind == BuiltInKind::scenario) {
    auto count = static_cast<double>(facts.spheres);
    if (fields.number("Spheres", "4096", 0, count) && count >= 1) requests.count = static_cast<std::int64_t>(count);
  }
  hint(names_of_formats(FormatsThat::hold_spheres) + ", packed or not. Or drop a file anywhere on the window.");
  return requests;
}

}  // namespace bihive::window
