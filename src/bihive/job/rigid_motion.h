// Rigid motions of a set: the frames of a film laid over its first one.
#pragma once

#include <array>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// A rotation, whose rows these are, and then a shift; world units.
struct RigidMotion {
  std::array<Vec3d, 3> rows{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Vec3d shift;

  Vec3d turned(Vec3d v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Vec3d operator()(Vec3d point) const { return turned(point) + shift; }
};

/// At least one point.
Vec3d mean_of(const std::vector<Vec3d>& points);

/// The motion that brings points closest to others: the least sum of squared distances between points of the same
/// number, without mirroring [Horn1987]. Both have the same number of points, at least one. Points on a line leave the
/// turn about it open, and get some one. The same bits everywhere.
RigidMotion superposition(const std::vector<Vec3d>& moving, const std::vector<Vec3d>& still);

/// Moves all spheres, and the cell. Centres are rounded once, to the stored units of the new set. The set has no
/// images. Error: a centre is beyond binary32's range.
Status move_spheres(SphereSet& spheres, const RigidMotion& motion);

}  // namespace bihive
