// The direction of view along the shortest axis of a set.
#pragma once

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/framing.h"

namespace bihive {

/// The principal axes of the spheres' centres (all spheres count alike, images too) as a direction of view: the longest
/// one across the picture, or up where `is_upright`, the second one along the other side, the shortest one along the
/// view. Of the directions with these axes it is the one nearest to the front: its vertical points to +y rather than
/// -y, and the eye is on the side of +z rather than -z.
///
/// Axes whose variances differ by less than a millionth of the longest one's count as equal, and the direction among
/// them is free: one sphere, or a ball, is seen from the front; a line from as near to the front as can be, or from the
/// right if it runs within 8 degrees of z; a disc by upright_side(). The same bits everywhere.
Side principal_side(const SphereSet& spheres, bool is_upright);

/// The direction of view towards a unit vector with +y up; -z up within 8 degrees of the vertical above, +z below.
Side upright_side(Vec3d back);

}  // namespace bihive
