// Spheres at the place of another. The grid of the scenarios makes some where its number of spheres is no cube number.
#pragma once

#include <array>
#include <cstdint>
#include <set>

#include "bihive/geometry/sphere_set.h"

namespace bihive::cli::thesis {

/// How many spheres have exactly the centre of one with a smaller id.
inline std::int64_t coinciding_spheres(const SphereSet& spheres) {
  std::set<std::array<double, 3>> places;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.centre(id);
    places.insert({centre.x, centre.y, centre.z});
  }
  return spheres.size() - static_cast<std::int64_t>(places.size());
}

}  // namespace bihive::cli::thesis
