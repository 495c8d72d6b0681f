// The bar over the picture of a file with frames: time line, play, step, speed and loop.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>

#include "bihive/viewer/player.h"
#include "bihive/viewer/viewer.h"
#include "widgets.h"

namespace bihive::window {

/// Clicks of one frame of the window.
struct PlayerRequests {
  bool toggles = false;  ///< play or pause
  int step = 0;
  std::optional<std::int64_t> frame;
  std::optional<double> frames_per_second;
  std::optional<bool> loops;
};

/// In ImGui's units, over a picture of that width: a small one has the time line in a row of its own.
float player_bar_height(float picture_width, double text_scale);
/// Whether it takes the whole width of a picture, so that nothing else can be at its lower border.
bool player_bar_is_wide(float picture_width, double text_scale);

/// Draws it in the middle of the lower border of a picture of that size.
PlayerRequests draw_player_bar(const Player& player, const SceneFacts& facts, ImVec2 picture, double text_scale,
                               Covered& covered);

}  // namespace bihive::window
