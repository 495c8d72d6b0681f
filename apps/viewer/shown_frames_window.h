// Frames shown per second by the window: the thesis's configurations, on a window of the text's size without a panel.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive::window {

/// Opens a window, shows every configuration for `seconds` seconds, and returns ShownFrames::json(). Error: no screen,
/// or the window was closed before the end.
Result<std::string> measure_shown_frames(double seconds);

}  // namespace bihive::window
