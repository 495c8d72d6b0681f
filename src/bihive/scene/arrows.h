// Arrows on spheres: sticks with ends of their own (geometry/stick_set.h).
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/arrows.h"

namespace bihive {

struct AddedArrows {
  std::int64_t count = 0;
  std::int64_t unknown = 0;      ///< selected spheres without an arrow, because a component is unknown or infinite
  std::int64_t inside = 0;       ///< arrows that end inside their sphere
  double longest = 0;            ///< world units
  double radius_of_longest = 0;  ///< of its sphere
};

/// Of a shaft of radius 1; shorter arrows are a smaller head alone.
constexpr double kArrowHeadRadius = 2.2;
constexpr double kArrowHeadLength = 5;

/// Adds to Scene::sticks an arrow for each selected sphere whose vector is not 0: a shaft, and a head that ends in a
/// point. They belong to their sphere. Adds to Scene::sticks_coloured_by how attributes colour them. Errors: a
/// component that is no attribute (with what there is), a selection's, a colour that is neither colour nor attribute,
/// or both; a sphere of radius 0 where Arrows::radius is infinite; as StickSet::add() and check_sticks().
Result<AddedArrows> add_arrows(Scene& scene, const Arrows& arrows);

}  // namespace bihive
