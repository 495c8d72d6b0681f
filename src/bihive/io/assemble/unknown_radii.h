// Radii for the spheres of a file that gives none.
#pragma once

#include <optional>

#include "bihive/geometry/set_parts.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Whether there is a sphere with neither radius nor known element.
bool lacks_radii(const RawSpheres& spheres);

/// Half the lower median of the distance from a centre to the nearest centre at another place; nothing if all centres
/// are at one place. Exact, but for at most 65,536 centres, evenly by id; their neighbours are searched among all. A
/// million spheres take a third of a second on one core.
/// `parts`: the spheres are a part of the set, and the radius is that of the whole set.
std::optional<double> radius_from_neighbours(const RawSpheres& spheres, const SetParts* parts = nullptr);

/// Fills `r`, which is empty: by element, else RawSpheres::unknown_radius, else radius_from_neighbours, else 0.5. Adds
/// the rules, and a warning where a radius is a guess.
void fill_radii(RawSpheres& spheres, const SetParts* parts = nullptr);

}  // namespace bihive
