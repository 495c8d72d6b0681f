// Error bounds of the binary32 filter, and when it is sure.
//
// The filter works on a *local* ray: an origin o of binary32 in stored units, at most kFarOrigin from 0 in every
// coordinate (a farther one is moved along its ray to the point nearest to 0), a direction n of length 1 rounded to
// binary32, and a distance s along it; s = t |d| - shift, where d is the ray's own direction. Let u = 2^-24, and
// F = max |o_k| + 1 over all rays of a tile, so that no distance between an origin and a sphere exceeds L = sqrt(3) F.
//
// Sphere of centre c, radius r:  oc = c - o,  b = oc . n,  p = oc - b n,  dp = (r + e)^2 - p . p.
//   b: u L for oc, 3 u L for the products and sums, u L for n, u L for a moved origin: 6 u L = 10.4 u F.
//   p: the error along n counts in its square only; across it u L (oc) + u L (n) + u L (b n) + u L (moved origin)
//      + u p (difference), and p . p is right to 3 u: 4 u L + 3 u p. (r + e)^2 is right to 3 u, which is 1.5 u r.
//   So with e = 17 u F both b and the length of p are right to e, and dp < 0 is a certain miss: the truth in binary64
//   is itself wrong by less than 2^-46 of the distance, which is at most 2^21, and 2^-25 is less than half of u F.
//
// A near root lies at s >= lo = b - e - sqrt(dp). It is *sure* to exist and to lie in [lo, lo + W], W = 24 e, where
//   dp >= 0.04 R^2 + 4 e R,   R = r + e:
//   r^2 - p^2 >= dp - 4 e R, so the true half chord is shorter than sqrt(dp) by at most 4 e R / sqrt(dp) <= 20 e.
// With r = 0 that never holds. A far root lies at s <= b + e + sqrt(dp).
//
// Boxes: a plane's distance (plane - o) / n is wrong by less than 7 u F in the plane's position (2 u F for 1 / n, u F
// for the product o / n, u F for the moved plane or offset, u F for the fused sum, u F for n, u F for a moved origin),
// and a hit lies up to 2^-25 + 52 2^-53 F beyond its box (docs/precision.md, "Padding"). All planes are moved outward
// by kBoxUnits u F = 10 u F; single rays move their offsets by as much instead.
//
// Images (WideTree::image): the ray is moved back in binary64, and then rounded like a moved origin. The true centre
// was rounded to binary32 after it had been moved, where no coordinate is beyond 1: it is off by 2^-25 a coordinate,
// 0.87 u in all, which adds to the errors of b and p. So e = 18 u F. Boxes: half a u, for which kBoxUnits has room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bihive {

constexpr float kFilterUnits = 17;
constexpr float kBoxUnits = 10;
constexpr float kImageUnits = 1;  ///< for an image, in e
constexpr float kWidthInErrors = 24;
constexpr float kUnit = 0x1p-24F;

/// Origins farther from 0 than this in some coordinate are moved; stored units.
constexpr double kFarOrigin = 8;
/// Rays that start beyond this go to the scalar traversal.
constexpr double kFarthestOrigin = 0x1p20;
/// Distances from a local origin to anything in the set are below this, so segment ends are cut there.
constexpr float kFarthestEnd = 32;

/// For a tile of rays whose local origins have no coordinate beyond `farthest_origin`.
struct FilterBounds {
  float e;        ///< how far b and |p| may be wrong
  float width;    ///< W
  float box_pad;  ///< distance by which planes are moved

  explicit FilterBounds(float farthest_origin, bool of_image = false) {
    const float reach = (farthest_origin + 1) * 1.0001F;
    e = (of_image ? kFilterUnits + kImageUnits : kFilterUnits) * kUnit * reach;
    width = kWidthInErrors * e;
    box_pad = kBoxUnits * kUnit * reach;
  }
};

/// A t as a distance along a local ray, s = t length - shift, rounded up.
inline float upper_distance(double t, double length, double shift) {
  const double s = std::clamp(t * length, -1e30, 1e30) - shift;
  const double upper = s + std::abs(s) * 0x1p-22 + std::abs(shift) * 0x1p-46;
  return static_cast<float>(std::clamp(upper, -double(kFarthestEnd), double(kFarthestEnd)));
}

/// No sphere's id, and no sphere's slot.
constexpr std::uint32_t kNoSphere = 0xFFFFFFFF;
constexpr std::uint32_t kNoSlot = 0xFFFFFFFF;

/// One local ray, a cache line.
struct alignas(64) LocalRay {
  float origin[3];
  float direction[3];
  float inverse[3];          ///< 1 / direction, finite
  float offset[3];           ///< plane * inverse + offset: the distance to a plane, which was moved outward before
  float s_min;               ///< lower bound of the segment's start, by less than W / 2
  std::uint32_t outward_id;  ///< of the sphere that it exits going outward; kNoSphere if there is none
  std::uint32_t unused[2];
};
static_assert(sizeof(LocalRay) == 64);

}  // namespace bihive
