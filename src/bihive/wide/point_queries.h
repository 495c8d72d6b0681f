// Points against the wide tree: the nearest spheres, and the spheres that contain a point or overlap a ball.
//
// The distance between a point and a sphere is one fixed number (geometry/sphere_distance.h), computed in the tree's
// stored units. Answers have the bits of brute force (tests/support/brute_force_points.h) on every instruction set, for
// any number of threads. Equal distances are ordered by id. A sphere of radius 0 counts as a point: unlike rays, these
// queries find it.
//
// Points, limits and distances are in world units and binary64. A coordinate must be finite and within binary32's range
// (3.4e38), as those of spheres must; an Error names the point. Distances to the surface are below 0 inside a sphere,
// so the nearest sphere is then the one in which the point is deepest. Lengths of arrays are not checked.
//
// The queries make threads themselves (0: all), and may run beside other queries. A tree of a set with images knows the
// stored spheres alone; an image (WideTree::image) is answered as the tree of its moved spheres. With
// PointOptions::images the set is periodic: every image of a sphere counts, under the sphere's id, at its own distance.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_distance.h"
#include "bihive/math/vec3.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// A view of `count` points owned by the caller: coordinate `axis` of point i is axis[axis][i * stride].
struct PointSpan {
  std::int64_t count = 0;
  const double* axis[3] = {};
  std::int64_t stride = 1;

  /// x, y, z of one point after the other. Null only if there is none.
  static PointSpan rows(const double* xyz, std::int64_t count) {
    return count == 0 ? PointSpan{} : PointSpan{count, {xyz, xyz + 1, xyz + 2}, 3};
  }

  Vec3d at(std::int64_t i) const { return {axis[0][i * stride], axis[1][i * stride], axis[2][i * stride]}; }
};

struct PointOptions {
  DistanceTo to = DistanceTo::surface;
  const std::uint8_t* mask = nullptr;      ///< a byte for each sphere of the tree, by id: 0 passes over it. Null: all
  int threads = 0;                         ///< 0: all
  const PeriodicImages* images = nullptr;  ///< of the tree's set (wide/periodic_images.h). Null: the spheres alone
  /// For each point a sphere that does not count, such as the point's own; kNothing: none. Of its images, the nearest.
  /// Null: all count. Not for sphere_pairs(), whose pairs are those of two spheres.
  const std::int64_t* exclude = nullptr;
};

/// `per_point` entries for each point, ordered by distance, then id. With fewer spheres, the rest are +inf and
/// kNothing.
struct NearestSpheres {
  std::int64_t per_point = 0;
  std::vector<double> distance;
  std::vector<std::int64_t> sphere_id;
};

/// The `per_point` nearest spheres of each point, among those at a distance of at most `within`. Error: a bad point,
/// per_point below 1, `within` NaN, or not enough memory. Costs, AVX-512, one thread: 1.6 us per point for the nearest
/// of a million spheres, 4.5 us for the nearest eight (a million random points in one call: docs/library.md, "Points").
Result<NearestSpheres> nearest_spheres(const WideTree& tree, const PointSpan& points, std::int64_t per_point = 1,
                                       double within = std::numeric_limits<double>::infinity(),
                                       const PointOptions& options = {});

/// The spheres of point i are entries begin[i] to before begin[i + 1], by ascending id; images by ascending distance.
struct SphereLists {
  std::vector<std::int64_t> begin;  ///< one more than there are points
  std::vector<std::int64_t> sphere_id;
  std::vector<double> distance;
};

/// Every sphere at a distance of at most limits[i] from point i. To the surface, 0 gives the spheres that contain the
/// point, a radius those that overlap the ball around it, and -radius those that contain this ball; to the centre, a
/// radius gives the centres in the ball. Error: a bad point, a limit that is NaN, one that reaches more than a million
/// images, or not enough memory.
Result<SphereLists> spheres_within(const WideTree& tree, const PointSpan& points, const double* limits,
                                   const PointOptions& options = {});
/// The same limit for all points.
Result<SphereLists> spheres_within(const WideTree& tree, const PointSpan& points, double limit,
                                   const PointOptions& options = {});

/// The lengths of these lists alone. Error: as spheres_within(), but no memory is needed for the lists.
Result<std::vector<std::int64_t>> count_within(const WideTree& tree, const PointSpan& points, const double* limits,
                                               const PointOptions& options = {});

/// Every sphere that contains the point, its surface included. `options.to` does not matter.
Result<SphereLists> spheres_containing(const WideTree& tree, const PointSpan& points, PointOptions options = {});

/// Every sphere that shares a point with the ball of radius radii[i] around point i. `options.to` does not matter.
/// Error: also a radius that is negative or not finite.
Result<SphereLists> spheres_overlapping(const WideTree& tree, const PointSpan& points, const double* radii,
                                        PointOptions options = {});

/// Pairs of spheres, by ascending first, then second; images by ascending distance.
struct SpherePairs {
  std::vector<std::int64_t> first, second;  ///< first < second; equal for a sphere and an image of itself
  std::vector<double> distance;
};

/// Every pair of spheres at a distance of at most `reach`, once: between their centres, or with DistanceTo::surface
/// between their surfaces (below 0 where they overlap; 0 gives the contacts). `spheres`: the set of the tree. With
/// PointOptions::images a sphere and the images of another, or of itself, are pairs too. The distance of a pair is
/// sphere_distance() or image_distance() from the first one's stored centre, less its radius if it is to the surface,
/// where the limit for the sphere is `reach` plus that radius. Error: `reach` NaN, or as spheres_within(). The mask
/// leaves out pairs with a sphere that it passes over.
Result<SpherePairs> sphere_pairs(const WideTree& tree, const SphereSet& spheres, double reach,
                                 const PointOptions& options = {});

}  // namespace bihive
