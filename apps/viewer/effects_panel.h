// The panel's groups of effects: colours, light, lines, lens, labels and cell. Each is closed until the user opens it.
#pragma once

#include <string>
#include <vector>

#include "bihive/viewer/viewer.h"

namespace bihive::window {

class EffectsPanel {
 public:
  /// Draws the groups and applies the user's changes. `look_changed`: the look has changed.
  void draw(const Viewer& viewer, ViewerSettings& settings, ViewerLook& look, bool& look_changed);

  /// Another scene is shown: discards unfinished input and choices.
  void start_anew();

  /// A text field, also for other groups of the panel. True when the user has finished another text; until then `value`
  /// stays.
  bool text(const char* name, const char* hint, std::string& value);
  /// The same for a number; an empty text, or one that is not a number from 0, gives `otherwise`, which is shown as
  /// empty.
  bool number(const char* name, const char* hint, double otherwise, double& value);

  /// The controls of a group, one per row of settings/parameter.h with a label.
  void parameters(ParameterGroup group, ViewerSettings& settings);

 private:
  void parameter(const Parameter& parameter, LayeredSettings& picture);
  bool draw_colours(const SceneFacts& facts, ViewerLook& look);
  bool draw_light(ViewerSettings& settings, ViewerLook& look);
  bool draw_lines(const SceneFacts& facts, ViewerSettings& settings, ViewerLook& look);
  void draw_lens(ViewerSettings& settings);
  void draw_cell(const SceneFacts& facts, ViewerSettings& settings);

  std::string edited_field_, edited_text_;  // the unfinished text and its field
  bool own_lights_ = false;                 // chosen, but still without lights
  int focus_kind_ = -1;                     // chosen, but still without distance or selection
};

}  // namespace bihive::window
