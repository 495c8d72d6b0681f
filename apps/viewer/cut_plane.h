// The card "Cut": a plane that removes what is before it, by a slider, and by a handle over the picture.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "bihive/viewer/viewer.h"
#include "look_rows.h"
#include "widgets.h"

namespace bihive::window {

class CutPlane {
 public:
  /// Other spheres.
  void forget() { bounds_.reset(); }
  void draw(const Viewer& viewer, LookRows& rows);
  /// The handle, which moves the plane along its normal. `per_unit`: pixels for one of ImGui's units.
  void draw_handle(const Viewer& viewer, LookRows& rows, ImVec2 picture_px, float per_unit, Covered& covered);

 private:
  const SphereSet::Bounds& bounds_of(const Viewer& viewer);

  std::optional<SphereSet::Bounds> bounds_;  // of all spheres of the input
  double moved_ = 0;                         // from where the handle was taken, along the normal
  std::optional<double> taken_;
};

}  // namespace bihive::window
