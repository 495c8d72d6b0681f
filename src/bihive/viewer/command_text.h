// What a window or a page shows, as a command line: "copy as command".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/io/reading_settings.h"
#include "bihive/viewer/viewer_look.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

/// The commands that take the options of a picture.
enum class CommandOf { picture, window, page, scene_file };

struct ShownState {
  std::string input;  ///< a built-in name or a file
  std::optional<std::int64_t> count;
  std::optional<std::uint64_t> seed;  ///< of a scenario
  GivenReading reading;
  ViewerSettings settings;
  ViewerLook look;
  bool own_camera = false;            ///< the scene's own camera or all in view, as drawn without options of a camera
  std::optional<std::string> side{};  ///< with own_camera: the side from which all is seen
  int width_px = 0, height_px = 0;    ///< of the picture
};

/// "bihive render x.pdb -o x.png --size 800x600 --style studio ...", with quotes where a shell needs them. A picture by
/// the CPU has the bits of the one that is shown, but for a camera of parallel rays, whose size is rounded. `output`:
/// the name without its ending.
std::string command_text(CommandOf kind, const ShownState& state, const std::string& output);

/// The same as separate arguments, from "bihive" on.
std::vector<std::string> command_words(CommandOf kind, const ShownState& state, const std::string& output);

/// A word as a shell takes it.
std::string quoted_for_shell(const std::string& word);

}  // namespace bihive
