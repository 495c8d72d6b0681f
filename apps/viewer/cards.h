// The cards of controls over the picture (viewer/cards.h): one at a time, at the right of a wide window, in a sheet at
// the bottom of a narrow one, where the picture takes what is left.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/io/reading_settings.h"
#include "bihive/scene/framing.h"
#include "bihive/viewer/cards.h"
#include "bihive/viewer/command_text.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/viewer.h"
#include "colour_ranges.h"
#include "cut_plane.h"
#include "groups.h"
#include "look_rows.h"
#include "open_card.h"
#include "pins.h"
#include "save_card.h"
#include "section_controls.h"
#include "tree_table.h"

namespace bihive::window {

/// Requests of one frame.
struct CardRequests {
  std::optional<ViewerSettings> settings;
  std::optional<ViewerLook> look;
  std::optional<ViewFrom> side;
  OpenRequests open;
  std::optional<GivenReading> reading;  ///< the same input, read like this
  std::optional<CommandOf> copy;
  bool home = false, save = false, tune = false, help = false;
  double zoom = 1;
  int undo = 0;  ///< -1: goes one state back; 1: goes on
};

/// Where things are in a display of some size, in ImGui's units.
struct Layout {
  ImVec2 display;
  float scale = 1;    ///< of letters
  float bar = 0;      ///< height of the buttons at the bottom of a narrow window; 0: it is wide
  float sheet = 0;    ///< height of the open card there
  ImVec2 picture;     ///< its size; it begins at the upper left corner
  ImVec2 picture_px;  ///< the same in pixels
  float lower = 0;    ///< the lower border for what lies over the picture: the player's bar may be below

  float per_unit() const { return picture_px.x / picture.x; }
  bool is_narrow() const { return bar > 0; }
};

class Cards {
 public:
  /// The id of the open card; empty: none.
  const std::string& open() const { return open_; }
  /// Opens a card of viewer/cards.h.
  void show(const std::string& id, const std::string& shown_input);
  void close();
  /// A click on the picture: closes a card beside which the picture is not clicked. True if it did.
  bool dismiss(const Layout& layout);

  /// `per_unit`: pixels for one of ImGui's units. `shown`: the controls are.
  Layout layout(ImVec2 display, double text_scale, float per_unit, bool shown) const;

  /// Draws everything but the picture, the player and messages. `input`: a built-in name or a file.
  CardRequests draw(const Viewer& viewer, const FrameReport& report, const Layout& layout, const std::string& input,
                    Covered& covered);

  /// Another scene.
  void begin(const Viewer& viewer);
  /// Another frame.
  void moved(const Viewer& viewer);
  /// Another look of it, or other spheres.
  void changed(const Viewer& viewer, bool other_spheres);

  TreeTable table;
  LookRows rows;
  OpenCard file;
  Pins pins;
  SaveCard save;
  GivenReading reading;  ///< of the shown input
  std::string command;   ///< of the kind that is chosen in "Share"
  CommandOf command_of = CommandOf::picture;
  std::string undoes, redoes;  ///< what undo and redo would change; empty: there is nothing
  bool searches = false;       ///< a search of the tree's limits is running

 private:
  void draw_bar(const Layout& layout, const std::string& input, Covered& covered);
  void draw_chip(const Viewer& viewer, const Layout& layout, const std::string& input, Covered& covered);
  void draw_zoom(const Viewer& viewer, const Layout& layout, CardRequests& requests, Covered& covered);
  void draw_card(const Viewer& viewer, const FrameReport& report, const Layout& layout, const std::string& input,
                 CardRequests& requests, Covered& covered);
  bool card_button(const Card& card, float width, const std::string& input);

  // The content of the cards. True: the look has changed.
  void draw_scene(const Viewer& viewer, const std::string& input, CardRequests& requests);
  bool draw_style(const Viewer& viewer, ViewerSettings& settings, ViewerLook& look);
  void draw_show(const Viewer& viewer);
  void draw_measure(const Viewer& viewer, const std::string& input);
  void draw_share(CardRequests& requests);
  void draw_more(const Viewer& viewer, const FrameReport& report, ViewerSettings& settings, ViewerLook& look,
                 const Layout& layout, const std::string& input, CardRequests& requests);
  void draw_laboratory(const Viewer& viewer, const FrameReport& report, ViewerSettings& settings,
                       CardRequests& requests);
  bool draw_sections(std::string_view card, const Viewer& viewer, ViewerSettings& settings, ViewerLook& look);

  std::string open_;
  int closes_in_ = 0;     // frames, above 0: after that many the open card closes
  bool is_tall_ = false;  // the sheet takes the whole window
  SectionControls controls_;
  Fields fields_;
  ColourRanges ranges_;
  Groups groups_;
  CutPlane cut_;
  UnionMeasures union_;
};

}  // namespace bihive::window
