// Bonds between the atoms of a scene, drawn as sticks. io/bonds.h finds them.
#pragma once

#include "bihive/base/result.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/sticks.h"

namespace bihive {

/// Gives the atoms of a scene the radii of Sticks::ball_scale. An Error where no element is known, but for Bonds::file.
Status scale_balls(Scene& scene, const Sticks& sticks);

/// Sets Scene::sticks to the bonds between the scene's spheres, with Sticks::orders as parallel_sticks() has them.
/// Errors: as bonds_by_distance(), StickSet::between() and check_sticks(); Bonds::file where the file states none.
Status find_bonds(Scene& scene, const Sticks& sticks, int threads = 0);

}  // namespace bihive
