// The controls of the sections of cards (viewer/cards.h): one for each parameter with a label, and those of look and
// camera that belong beside them.
#pragma once

#include <string>

#include "bihive/viewer/cards.h"
#include "bihive/viewer/viewer.h"
#include "colour_ranges.h"
#include "widgets.h"

namespace bihive::window {

class SectionControls {
 public:
  /// Draws a section, which the user opens and closes, and applies changes. True: the look has changed.
  bool draw(const CardSection& section, const SceneFacts& facts, ViewerSettings& settings, ViewerLook& look);
  /// What colours all spheres. True: the look has changed.
  bool draw_colours(const SceneFacts& facts, ViewerLook& look, ColourRanges& ranges);

  /// Another scene is shown: discards unfinished input and choices.
  void start_anew();

 private:
  void parameters(ParameterGroup group, ViewerSettings& settings);
  void parameter(const Parameter& parameter, LayeredSettings& picture);
  bool draw_light(ViewerSettings& settings, ViewerLook& look);
  bool draw_lines(const SceneFacts& facts, ViewerSettings& settings, ViewerLook& look);
  void draw_lens(ViewerSettings& settings);
  void draw_cell(const SceneFacts& facts, ViewerSettings& settings);

  Fields fields_;
  bool own_lights_ = false;  // chosen, but still without lights
  int focus_kind_ = -1;      // chosen, but still without distance or selection
};

}  // namespace bihive::window
