// Distances and angles of positions, for measuring. In binary64, the same bits on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bihive/geometry/lattice.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The angle a-b-c at `b` in degrees, 0 to 180. NaN where an arm has length 0.
double angle_deg(Vec3d a, Vec3d b, Vec3d c);

/// The dihedral angle of the chain a-b-c-d in degrees, above -180 to 180: seen along b-c, the turn from a to d,
/// clockwise positive [IUPAC1970]. NaN where three positions in turn lie on a line.
double dihedral_deg(Vec3d a, Vec3d b, Vec3d c, Vec3d d);

/// The distance, angle or dihedral angle of two, three or four sphere centres. Each sphere counts at its image nearest
/// to the one before it. `lattice`: of the set's cell; without one, the spheres themselves count.
double measured(const SphereSet& spheres, std::span<const std::int64_t> ids, const std::optional<Lattice>& lattice);

/// Of the vectors that differ from this one by vectors of the lattice, a shortest one; itself without a lattice, or
/// where it is so long that binary64 cannot tell.
Vec3d shortest_image(Vec3d vector, const std::optional<Lattice>& lattice);

}  // namespace bihive
