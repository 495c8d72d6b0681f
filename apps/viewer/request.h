// The request of `bihive view` to the window. `bihive view` has parsed and checked the command line, and starts this
// program with one argument, a JSON object:
//
//   {"input": "demo",                        a built-in name or a file
//    "count": 64, "seed": 1,                 of the scenarios; all but "input" may be missing
//    "reading": {"radius_scale": "2"},       as in io/reading_settings.h
//    "size": [1280, 800], "view_from": "left",
//    "settings": {...}, "look": {...},       as in viewer/viewer_json.h; missing ones are the scene's
//    "tune": true,                           the tree's limits are searched
//    "card": "style",                        is open (viewer/cards.h)
//    "welcome": true,                        nobody has named an input: others are proposed
//    "screenshot": "window.png"}
//
// scripts/shown_frames starts it with {"shown_frames": "frames.json", "seconds": 2}, and nothing else: the window shows
// the configurations of the thesis's Figure 4.4, writes how many frames per second it showed, and ends.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/reading_settings.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"

namespace bihive::window {

struct Request {
  std::string input;
  ScenarioParameters scenario;
  GivenReading reading;
  int width = 1280, height = 800;  ///< of the window, in the screen's units
  std::optional<ViewFrom> side;
  std::string settings = "{}";
  std::string look = "{}";
  bool places_camera = false;  ///< `settings` have a camera of their own
  bool tune = false, welcomes = false;
  std::string card;          ///< id; empty: none
  std::string screenshot;    ///< not empty: a PNG of the settled window is written there, and the program ends
  std::string shown_frames;  ///< not empty: frames shown a second are written there as JSON, and the program ends
  double seconds = 2;        ///< of each such measurement
};

Result<Request> request_from_json(std::string_view text);

}  // namespace bihive::window
