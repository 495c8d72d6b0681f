// Colours for spheres that come without: by element (CPK) or by type.
#pragma once

#include <cstdint>

#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Linear RGB of a chemical element by atomic number (0 or unknown: pink).
Vec3f element_colour(int atomic_number);

/// Linear RGB of a particle type, distinct for neighbouring numbers and repeating after eight. Any integer.
Vec3f type_colour(std::int32_t type);

/// Fills the colour attribute where it is empty: from elements where there are any, else from types, else left empty.
void colour_spheres(SphereSet& spheres);

}  // namespace bihive
