// The panel's groups for what a picture gets beyond plain rays: colours, light, lines, lens, labels and cell. Each is
// closed until somebody opens it.
#pragma once

#include <string>
#include <vector>

#include "bihive/viewer/viewer.h"

namespace bihive::window {

class EffectsPanel {
 public:
  /// Draws the groups and changes what the user changes. `look_changed`: the look is another one.
  void draw(const Viewer& viewer, ViewerSettings& settings, ViewerLook& look, bool& look_changed);

  /// Another scene is on show: forgets what is being written and chosen.
  void start_anew();

  /// A field of text, also for other parts of the panel. True when the user has finished another text; until then
  /// `value` stays.
  bool text(const char* name, const char* hint, std::string& value);
  /// The same for a number; an empty text, or one that is no number from 0, gives `otherwise`, which is shown as empty.
  bool number(const char* name, const char* hint, double otherwise, double& value);

  /// The controls of a group, one for each row of settings/parameter.h with a label.
  void parameters(ParameterGroup group, ViewerSettings& settings);

 private:
  void parameter(const Parameter& parameter, LayeredSettings& picture);
  bool draw_colours(const SceneFacts& facts, ViewerLook& look);
  bool draw_light(ViewerSettings& settings, ViewerLook& look);
  bool draw_lines(const SceneFacts& facts, ViewerSettings& settings, ViewerLook& look);
  void draw_lens(ViewerSettings& settings);
  void draw_cell(const SceneFacts& facts, ViewerSettings& settings);

  std::string edited_field_, edited_text_;  // what is being written, and where
  bool own_lights_ = false;                 // chosen, although there are none yet
  int focus_kind_ = -1;                     // chosen, although its distance or selection is not given yet
};

}  // namespace bihive::window
