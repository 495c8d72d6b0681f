// Shapes that cut spheres open: no ray meets the inside of a shape.
#pragma once

#include <variant>

#include "bihive/math/vec3.h"

namespace bihive {

/// Removes all points p with normal . p > offset. The normal may have any length above 0. World units.
struct PlaneClip {
  Vec3d normal;
  double offset = 0;
};
/// Removes the inside of the box between two corners, lo < hi along each axis.
struct BoxClip {
  Vec3d lo, hi;
};
/// Removes the inside of a sphere, radius > 0.
struct SphereClip {
  Vec3d centre;
  double radius = 0;
};
/// The boundaries of these shapes are not removed: they become the caps of the spheres.
using Clip = std::variant<PlaneClip, BoxClip, SphereClip>;

inline bool operator==(const PlaneClip& a, const PlaneClip& b) {
  return a.normal == b.normal && a.offset == b.offset;
}
inline bool operator==(const BoxClip& a, const BoxClip& b) {
  return a.lo == b.lo && a.hi == b.hi;
}
inline bool operator==(const SphereClip& a, const SphereClip& b) {
  return a.centre == b.centre && a.radius == b.radius;
}

/// The clip, translated.
inline Clip moved(const Clip& clip, Vec3d by) {
  if (const auto* plane = std::get_if<PlaneClip>(&clip))
    return PlaneClip{plane->normal, plane->offset + dot(plane->normal, by)};
  if (const auto* box = std::get_if<BoxClip>(&clip)) return BoxClip{box->lo + by, box->hi + by};
  const auto& sphere = std::get<SphereClip>(clip);
  return SphereClip{sphere.centre + by, sphere.radius};
}

/// The maximum number of different clips of a scene: each sphere has a bit for each clip (SphereAttributes::clips).
constexpr int kMostClips = 64;

}  // namespace bihive
