// The scalar truth of the intersection of a ray and a cut sphere: what clips leave of the ball, closed by caps.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/geometry/clip.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stored_clip.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The hit of a ray and a cut sphere.
struct CutHit {
  double t = std::numeric_limits<double>::infinity();
  int clip = -1;  ///< whose cap it is; -1: the sphere's own surface
  int face = 0;   ///< of a box
};

/// The spheres of a set with the clips that act on them. Const; any number of threads may ask.
class CutSet {
 public:
  /// `clips_of_sphere`: of each sphere a bit for each clip; empty: no clip acts. Both must outlive this. Spheres added
  /// later are examined on every query.
  CutSet(const SphereSet& spheres, const std::vector<Clip>& clips, const std::vector<std::uint64_t>& clips_of_sphere);

  Remainder remainder(std::int64_t id) const { return of_sphere(id).remainder; }
  bool is_cut(std::int64_t id) const {
    return id >= 0 && id < static_cast<std::int64_t>(clips_of_sphere_->size()) && remainder(id) == Remainder::cut;
  }

  /// A valid ray as the cut spheres meet it. If it starts on a cut sphere, it exits the surface to which its origin is
  /// nearest: of the ball, or of one of its clips; of equally near ones the ball, then the first clip. It knows what
  /// the clips of `clips`, a bit each, remove from it.
  CutRay entering(const Ray& ray, std::uint64_t clips) const;
  /// The same, overwriting another ray, which is faster.
  void enter(const Ray& ray, std::uint64_t clips, CutRay& entered) const;

  /// The clips whose border meets the sphere, a bit each.
  std::uint64_t cutting(std::int64_t id) const { return of_sphere(id).cutting; }

  /// Whether some clip is a sphere.
  bool has_round_clips() const { return has_round_clips_; }

  /// Narrows the segment of a ray to the interval in which it may meet spheres that all of these clips cut. False:
  /// empty.
  static bool narrow(std::uint64_t clips, CutRay& ray);

  /// The clips leave one or more intervals of the line in a ball, closed by the ball's surface and by caps. The hit is
  /// the first end of an interval that lies in the segment: where the ray enters, or where it exits if it starts
  /// inside. The surface on which the ray starts counts as the ray says: it is not met again at t = 0. The ray must
  /// know the clips of the sphere.
  CutHit hit(const CutRay& ray, std::int64_t id) const;

  /// The outward normal, of length 1, at the cap where the ray hits the sphere. False: it hits the ball's own surface,
  /// or the sphere is not cut.
  bool cap_normal(const Ray& ray, std::int64_t id, Vec3d& normal) const;

 private:
  struct CutSphere {
    Remainder remainder = Remainder::whole;
    std::uint64_t cutting = 0;  // the clips whose border meets the sphere
  };
  CutSphere look_at(std::int64_t id) const;
  CutSphere of_sphere(std::int64_t id) const {
    const auto i = static_cast<std::size_t>(id);
    return i < known_.size() ? known_[i] : look_at(id);
  }
  void leave_nearest(const Ray& ray, CutRay& entered) const;

  const SphereSet* spheres_;
  const std::vector<std::uint64_t>* clips_of_sphere_;
  std::vector<StoredClip> clips_;
  bool has_round_clips_ = false;
  std::uint64_t all_clips_ = 0;   // a bit each
  std::vector<CutSphere> known_;  // of each sphere that was there at first
};

}  // namespace bihive
