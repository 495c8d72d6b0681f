// Points and rays against a periodic set: the spheres and all their images.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

struct Interval;
namespace wide {
struct NearSphere;
struct PointQuestion;
}  // namespace wide

/// Makes queries know the images of a set along its cell (geometry/lattice.h), of whatever shape. It belongs to one
/// tree of the set, whose spheres may lie inside of the cell or far from it. Answers have the bits of comparing all
/// images.
///
/// Points (wide/point_queries.h): at whatever distance. The distance to an image is image_distance() of
/// geometry/sphere_distance.h, in stored units: the same from either end, and without a shift that to the sphere
/// itself.
///
/// Rays: the centre of an image is the stored centre plus Lattice::shift(), a sum in binary64.
class PeriodicImages {
 public:
  /// Nothing: the set has no cell, one that is not periodic, or one without extent. Where spheres lie farther apart
  /// than two cells, a second tree of all of them in one cell is built. Error: not enough memory for that. `threads`:
  /// 0: all.
  static Result<std::optional<PeriodicImages>> of(const SphereSet& spheres, int threads = 0);

  /// ---- Rays ----
  ///
  /// As those of wide/queries.h, on the caller's thread. Rays that end in the stored spheres are about as fast; each
  /// other image that a ray meets is traversed on its own. Hits on an image have the id of its sphere, so all_hits()
  /// may return an id several times. A ray exits the image of `leaves` whose surface is nearest to the ray's origin.
  /// Returns kNothing, or the first ray without an answer: ray_without_end().
  ///
  /// `exclude`: null, or for each ray a sphere that does not count, kNothing for none: of its images, the one whose
  /// surface is nearest to the ray's origin. Rays that would hit it are traced again.

  std::int64_t closest_hits(const WideTree& tree, const RaySpan& rays, const HitSpan& hits,
                            const std::int64_t* exclude = nullptr) const;
  std::int64_t occluded(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden,
                        const std::int64_t* exclude = nullptr) const;
  std::int64_t all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits,
                        const std::int64_t* exclude = nullptr) const;

  /// Cells that a ray passes along one vector, at most. Then it must have hit something, or have left the images of a
  /// set that is not periodic along all three vectors, or be at its t_max.
  static constexpr std::int64_t kMostCells = 16384;
  /// The error for a ray that passes more.
  static Error ray_without_end(std::int64_t ray);
  /// Error: the spheres lie so far apart, or are so large, that more than 4096 images overlap.
  Status check_rays() const;
  /// The centre, in stored units, of the image of sphere `id` that gave a hit at `t`. Nothing: none gives it, so the
  /// ray or the sphere is another one.
  std::optional<Vec3d> image_of_hit(const ScaledRay& ray, double t, std::int64_t id) const;

  /// ---- Points, for wide/schedule ----

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

  template <class LookAt>
  void each_image_near(Vec3d point, std::int64_t id, const LookAt& look_at) const;
  std::optional<Vec3d> image_by_surface(Vec3d point, std::int64_t id) const;
  Interval near_spheres(const ScaledRay& ray) const;
  Interval in_image(const ScaledRay& ray, Vec3d share, Vec3d speed, const ImageCounts& counts) const;
  template <class Answer>
  void trace_image(const WideTree& tree, const ScaledRay& ray, const ImageCounts& counts, Answer& answer) const;
  template <class Answer>
  bool trace(const WideTree& tree, const Ray& ray, bool is_stored_known, Answer& answer) const;

  Lattice lattice_;                     // stored units
  Vec3d lowest_share_, highest_share_;  // for points: of in_cell_, if that is there
  Vec3d lowest_own_, highest_own_;      // for rays: shares of the set's centres
  Vec3d lo_, hi_;                       // of these centres
  double largest_ = 0;                  // of all coordinates
  double largest_radius_ = 0;
  std::vector<float> x_, y_, z_, r_;
  // Of a set that extends over several cells: all spheres in one cell.
  std::shared_ptr<const WideTree> in_cell_;
};

/// For rays in chunks on several threads: the first one without an answer, in the order of the rays. Chunks after it
/// need not be traced.
class FirstWithoutEnd {
 public:
  /// Whether it is a ray before this one.
  bool is_before(std::int64_t ray) const { return first_ < ray; }
  /// `in_chunk` is the return value of PeriodicImages for the chunk whose first ray is `first`.
  void take(std::int64_t first, std::int64_t in_chunk) {
    if (in_chunk == kNothing) return;
    std::int64_t known = first_;
    while (first + in_chunk < known && !first_.compare_exchange_weak(known, first + in_chunk)) {
    }
  }
  /// Error: there is one.
  Status status() const { return first_ == kNone ? Status(Done{}) : Status(PeriodicImages::ray_without_end(first_)); }

 private:
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
  std::atomic<std::int64_t> first_{kNone};
};

}  // namespace bihive
