// The scalar truth of the distance between a point and a sphere: one fixed sequence of binary64 operations.
//
// Every engine must give exactly these numbers. The file is compiled without fused multiply-add (-ffp-contract=off).
#pragma once

#include <cmath>

#include "bihive/math/vec3.h"

namespace bihive {

/// The end point of a distance: the surface of a sphere (negative for a point inside it), or its centre.
enum class DistanceTo { surface, centre };

/// All in one unit (the engines: stored units of a set). sqrt(x * x + y * y + z * z) of the vector between the two
/// points, summed from left to right; for the surface the radius is subtracted last. So it is 0 or below exactly where
/// the sphere contains the point, its surface included.
inline double sphere_distance(Vec3d point, Vec3d centre, double radius, DistanceTo to) {
  const Vec3d between = centre - point;
  const double to_centre = std::sqrt(dot(between, between));
  return to == DistanceTo::centre ? to_centre : to_centre - radius;
}

/// The same to the image of the sphere that is moved by `shift`: the sum of the vector between the two points and the
/// shift. So it is the same from either end, and that of the sphere itself for a shift of 0.
inline double image_distance(Vec3d point, Vec3d centre, Vec3d shift, double radius, DistanceTo to) {
  const Vec3d between = (centre - point) + shift;
  const double to_centre = std::sqrt(dot(between, between));
  return to == DistanceTo::centre ? to_centre : to_centre - radius;
}

}  // namespace bihive
