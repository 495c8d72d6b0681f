// The panel beside the picture: it shows the settings and reports clicks.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "bihive/io/read_spheres.h"
#include "bihive/scene/framing.h"
#include "bihive/viewer/orbit.h"
#include "bihive/viewer/viewer.h"
#include "effects_panel.h"
#include "look_panel.h"
#include "tree_table.h"

namespace bihive::window {

/// The panel's edge of the window: the right one, or in a tall, narrow window the lower one.
struct PanelPlace {
  bool below = false;
  float extent = 0;  ///< its width, or below its height, in ImGui's units
};

/// Requests of one frame.
struct PanelRequests {
  std::optional<ViewerSettings> settings;
  std::optional<ViewerLook> look;
  std::optional<ViewFrom> side;
  std::optional<std::string> built_in;  ///< a scene to be opened
  std::optional<ReadOptions> reading;   ///< the same input with these radii
  bool home = false, save = false;
};

class Panel {
 public:
  /// In a display of that size, in ImGui's units.
  static PanelPlace place(ImVec2 display, double text_scale);

  /// Draws the panel there.
  PanelRequests draw(const Viewer& viewer, const FrameReport& report, ImVec2 display, double text_scale);

  TreeTable table;
  LookPanel look;
  EffectsPanel effects;
  ReadOptions reading;                   ///< reading options of the shown input
  bool can_scale_radii = true;           ///< the input is a file, or the demo
  std::string file_name = "bihive.png";  ///< where pictures are saved
  PictureSizePx save_size{0, 0};         ///< 0: as on the screen

 private:
  void draw_scene(const Viewer& viewer, PanelRequests& requests);
  void draw_picture(const Viewer& viewer, ViewerSettings& settings);
  void draw_tree(ViewerSettings& settings) const;
  void draw_camera(ViewerSettings& settings, PanelRequests& requests) const;
  void draw_speed(const Viewer& viewer, const FrameReport& report) const;
  void draw_saving(PanelRequests& requests);
  void draw_keys() const;
};

}  // namespace bihive::window
