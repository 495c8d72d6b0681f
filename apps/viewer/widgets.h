// Widgets shared by the panel's files.
#pragma once

#include <imgui.h>

#include "theme.h"

namespace bihive::window {

inline void heading(const char* text) {
  ImGui::Dummy({0, ImGui::GetStyle().ItemSpacing.y * 0.4F});
  ImGui::Separator();
  ImGui::TextColored(kDim, "%s", text);
}

/// A label in the left column, and its control in the right one.
inline void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + 0.36F * ImGui::GetWindowWidth());
  ImGui::SetNextItemWidth(-1);
}

}  // namespace bihive::window
