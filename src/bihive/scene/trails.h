// Sticks along the paths of spheres through earlier frames (geometry/stick_set.h).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/trails.h"

namespace bihive {

/// Unless Trails::radius states it: this share of the sphere's radius.
constexpr double kTrailRadius = 0.2;

struct AddedTrails {
  std::int64_t trails = 0;  ///< spheres that moved
  std::int64_t frames = 0;  ///< of `earlier` that count
  std::int64_t sticks = 0;
  std::int64_t broken = 0;   ///< steps that leave the periodic cell
  bool other_count = false;  ///< earlier ones were left out, because they have another number of spheres
};

/// Adds to Scene::sticks the path of each selected sphere through `earlier`, the spheres of the frames before this one
/// as they were read, the oldest first. Spheres are the same by their input_id(). Each step is a stick of one radius;
/// the opacity of step k before now, of n = Trails::frames, is that of the sphere times 1 - (k + 1/2) / n. There is no
/// stick for a step of which the nearest image in the periodic cell is another one: the path leaves the cell there.
/// Errors: a selection's; a sphere of radius 0 where the radius is not stated; as StickSet::add().
Result<AddedTrails> add_trails(Scene& scene, const std::vector<std::shared_ptr<const SphereSet>>& earlier,
                               const Trails& trails);

}  // namespace bihive
