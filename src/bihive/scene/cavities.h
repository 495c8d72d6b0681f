// Pictures of the cavities that a union of spheres encloses.
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct ShownCavities {
  int cavities = 0;                    ///< 0: nothing is left to be seen
  std::int64_t undecided_spheres = 0;  ///< UnionMeasures::undecided_spheres
};

/// Grows all spheres by the probe, rounded to binary32, and leaves of their union the walls of its cavities alone
/// (Scene::cavity_walls); the spheres that line none are hidden. Those that are hidden before do not count. The spheres
/// get the column `cavity`: the number of the largest cavity that they line, from 1 on by descending volume. Errors:
/// clips, sticks or copies; a column `cavity`; those of measure_union() (measure/union_measures.h). The scene is then
/// as it was, or its spheres have grown.
Result<ShownCavities> show_cavities(Scene& scene, double probe, int threads = 0);

}  // namespace bihive
