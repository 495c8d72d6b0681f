// Radii for the spheres of a file that gives none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Whether there is a sphere with neither radius nor known element.
bool lacks_radii(const RawSpheres& spheres);

/// Half the lower median of the distance from a centre to the nearest centre at another place; nothing if all centres
/// are at one place. Images count as places where the set has a cell, `cell`. Exact, but for at most 65,536 centres,
/// evenly by id; their neighbours are searched among all. A million spheres take a third of a second on one core.
std::optional<double> radius_from_neighbours(const RawSpheres& spheres, const std::optional<Cell>& cell);

/// The steps of radius_from_neighbours(), for a set whose spheres lie in several chunks. The centres of `chunk` from
/// which neighbours are searched; `first` spheres of the whole set, which has `all`, lie before the chunk.
std::vector<Vec3d> search_origins(const RawSpheres& chunk, std::int64_t first, std::int64_t all);
/// From each origin the distance to the nearest centre of the chunk at another place; infinite where there is none.
std::vector<double> nearest_distances(const RawSpheres& chunk, const std::optional<Cell>& cell,
                                      const std::vector<Vec3d>& origins);
/// The radius by the distances of all origins in the whole set, at least one.
std::optional<double> radius_from_distances(std::vector<double> distances);

/// The spheres whose radius neither the file nor their element tells, and all; the radius that they get, if one is
/// known. Of the whole set, where the spheres are a chunk of it.
struct UnknownRadii {
  std::int64_t unknown = 0, all = 0;
  std::optional<double> radius;
};
/// Of spheres without `r`.
std::int64_t count_unknown_radii(const RawSpheres& spheres);

/// Fills `r`, which is empty: by element, else RawSpheres::unknown_radius, else `whole.radius`, else 0.5. Adds the
/// rules, and a warning where a radius is a guess.
void fill_radii(RawSpheres& spheres, const UnknownRadii& whole);

}  // namespace bihive
