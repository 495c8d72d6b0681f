// Points against every sphere of a set: the definition of the answers of wide/point_queries.h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/geometry/sphere_distance.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Distance in world units, and id. `mask`: as in PointOptions.
using SphereAtDistance = std::pair<double, std::int64_t>;

/// The spheres at a distance of at most `limit` from the point, by id. A valid point, world units. `most` is not
/// negative: the nearest of them, by distance and id. They are ordered in stored units, because world units may round
/// two distances to one number.
inline std::vector<SphereAtDistance> every_sphere_within(const SphereSet& spheres, Vec3d point, double limit,
                                                         DistanceTo to, const std::uint8_t* mask = nullptr,
                                                         std::int64_t most = -1) {
  std::vector<SphereAtDistance> found;
  for (std::int64_t id = 0; id < spheres.total_size(); ++id) {
    if (mask != nullptr && mask[id] == 0) continue;
    const double distance = sphere_distance(spheres.to_local(point) * spheres.scale(), spheres.stored_centre(id),
                                            spheres.stored_radius(id), to);
    if (distance <= limit * spheres.scale()) found.emplace_back(distance, id);
  }
  if (most >= 0) {
    const auto kept = std::min(most, static_cast<std::int64_t>(found.size()));
    std::partial_sort(found.begin(), found.begin() + kept, found.end());
    found.resize(static_cast<std::size_t>(kept));
  }
  for (SphereAtDistance& one : found) one.first *= spheres.inverse_scale();
  return found;
}

/// The `most` nearest of them.
inline std::vector<SphereAtDistance> nearest_of_every_sphere(const SphereSet& spheres, Vec3d point, std::int64_t most,
                                                             double limit, DistanceTo to,
                                                             const std::uint8_t* mask = nullptr) {
  return every_sphere_within(spheres, point, limit, to, mask, most);
}

}  // namespace bihive
