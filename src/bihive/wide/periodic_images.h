// Points against a periodic set: the spheres and all their images (wide/point_queries.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

namespace wide {
struct NearSphere;
struct PointQuestion;
}  // namespace wide

/// Makes queries about points know the images of a set along its cell (geometry/lattice.h), of whatever shape, and at
/// whatever distance. It belongs to one tree of the set, whose spheres may lie inside of the cell or far from it.
///
/// The distance to an image is image_distance() of geometry/sphere_distance.h, in stored units: the same from either
/// end, and without a shift that to the sphere itself. Answers have the bits of comparing all images.
class PeriodicImages {
 public:
  /// Nothing: the set has no cell, one that is not periodic, or one without extent. Where spheres lie farther apart
  /// than two cells, a second tree of all of them in one cell is built. Error: not enough memory for that. `threads`:
  /// 0: all.
  static Result<std::optional<PeriodicImages>> of(const SphereSet& spheres, int threads = 0);

  /// The number of images that may have a sphere at most `limit` (stored units) from a point, at most.
  double images_within(double limit) const;

  /// As those of wide/trace/points.h, for the tree of the set. An image counts under the id of its sphere, so that ids
  /// may occur several times. The limit of find_within() must be finite.
  std::int64_t find_nearest(const WideTree& tree, const wide::PointQuestion& question, std::int64_t most,
                            wide::NearSphere* nearest) const;
  void find_within(const WideTree& tree, const wide::PointQuestion& question,
                   std::vector<wide::NearSphere>& found) const;

 private:
  explicit PeriodicImages(const Lattice& lattice) : lattice_(lattice) {}

  struct Place;
  Place place_of(const WideTree& tree, const wide::PointQuestion& question) const;
  Lattice::Range range_of(const Place& place, double limit) const;
  double rounding(const Place& place, double reach) const;
  /// Among the images of a range; distances by the tree of the place, which for spheres brought into one cell are
  /// rounded.
  std::int64_t nearest_of(const Place& place, double within, std::int64_t wanted, wide::NearSphere* nearest) const;

  Lattice lattice_;  // stored units
  Vec3d lowest_share_, highest_share_;
  double largest_ = 0;  // of all coordinates
  double largest_radius_ = 0;
  // Of a set that extends over several cells: all spheres in one cell, and centres and radii that they had.
  std::shared_ptr<const WideTree> in_cell_;
  std::vector<float> x_, y_, z_, r_;
};

}  // namespace bihive
