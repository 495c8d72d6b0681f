// The picture answers: what is under the pointer, spheres that are pinned, and the measures between them.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/viewer/pick.h"
#include "bihive/viewer/viewer.h"
#include "widgets.h"

namespace bihive::window {

/// A sphere in words.
struct NamedSphere {
  std::int64_t id = 0;         ///< in the input
  std::string title, details;  ///< "CA, ALA 28, chain A"
  Vec3d centre;
  /// Selections of more and more spheres around this one: itself, its residue, its chain, all of its kind.
  std::vector<std::pair<std::string, std::string>> selections;
};

class Pins {
 public:
  /// The sphere there, in pixels of the picture; nothing: none.
  static std::optional<NamedSphere> named(const Viewer& viewer, double x_px, double y_px);

  /// Pins a sphere, or takes its pin away; of five the first one goes.
  void toggle(const Viewer& viewer, NamedSphere sphere);
  void clear();
  bool empty() const { return pins_.empty(); }
  /// Another frame, or another look: what is pinned has moved, or is hidden and pinned no longer.
  void moved(const Viewer& viewer);

  /// Numbers and lines over the picture. `per_unit`: pixels for one of ImGui's units.
  void draw_marks(const Viewer& viewer, ImVec2 picture_px, float per_unit) const;
  /// The pins and their measure. Returns the selection for which a row is to begin.
  std::optional<std::string> draw_list();

 private:
  void measure(const Viewer& viewer);

  std::vector<NamedSphere> pins_;
  std::string measure_;
};

/// Area, volume and cavities of what is shown.
class UnionMeasures {
 public:
  void draw(const Viewer& viewer, Fields& fields);
  void forget() { lines_.clear(); }

 private:
  std::string selection_;
  double probe_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace bihive::window
