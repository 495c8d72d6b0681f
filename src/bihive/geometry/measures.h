// Distances and angles of positions, for measuring. In binary64, the same bits on every machine.
#pragma once

#include <optional>

#include "bihive/geometry/lattice.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The angle a-b-c at `b` in degrees, 0 to 180. NaN where an arm has length 0.
double angle_deg(Vec3d a, Vec3d b, Vec3d c);

/// The dihedral angle of the chain a-b-c-d in degrees, above -180 to 180: seen along b-c, the turn from a to d,
/// clockwise positive [IUPAC1970]. NaN where three positions in turn lie on a line.
double dihedral_deg(Vec3d a, Vec3d b, Vec3d c, Vec3d d);

/// Of the vectors that differ from this one by vectors of the lattice, a shortest one; itself without a lattice, or
/// where it is so long that binary64 cannot tell.
Vec3d shortest_image(Vec3d vector, const std::optional<Lattice>& lattice);

}  // namespace bihive
