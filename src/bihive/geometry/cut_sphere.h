// The scalar truth of the intersection of a ray and a cut sphere or stick: what clips leave of the body, closed by
// caps.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/geometry/clip.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/geometry/stored_clip.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The hit of a ray and a cut sphere.
struct CutHit {
  double t = std::numeric_limits<double>::infinity();
  int clip = -1;  ///< whose cap it is; -1: the sphere's own surface
  int face = 0;   ///< of a box
};

/// The same for a stick; `s` is the position along its axis.
struct CutStickHit {
  CutHit hit;
  double s = 0;
};

/// An interval of a line that clips leave of a body.
struct RemainingPart {
  double in, out;
};

/// The spheres of a set, and the sticks between them, with the clips that act on them: on a stick those that act on
/// both of its spheres. Const; any number of threads may ask.
class CutSet {
 public:
  /// `clips_of_sphere`: of each sphere a bit for each clip; empty: no clip acts. All but `clips` must outlive this.
  /// Spheres added later are examined on every query. `sticks` may be null.
  CutSet(const SphereSet& spheres, const std::vector<Clip>& clips, const std::vector<std::uint64_t>& clips_of_sphere,
         const StickSet* sticks = nullptr);

  Remainder remainder(std::int64_t id) const { return of_sphere(id).remainder; }
  /// Some sticks that no clip meets count as cut.
  Remainder remainder_of_stick(std::int64_t stick) const {
    return of_sticks_[static_cast<std::size_t>(stick)].remainder;
  }
  /// Whether this is the id of half a stick.
  bool is_of_stick(std::int64_t id) const {
    return !of_sticks_.empty() && id >= spheres_->size() &&
           id < spheres_->size() + 2 * static_cast<std::int64_t>(of_sticks_.size());
  }
  /// Of a sphere, or half a stick.
  bool is_cut(std::int64_t id) const {
    if (is_of_stick(id)) return remainder_of_stick((id - spheres_->size()) / 2) == Remainder::cut;
    return id >= 0 && id < static_cast<std::int64_t>(clips_of_sphere_->size()) && remainder(id) == Remainder::cut;
  }

  /// A valid ray as the cut spheres meet it. If it starts on a cut sphere or stick, it exits the surface to which its
  /// origin is nearest: of the body, or of one of its clips; of equally near ones the body, then the first clip. It
  /// knows what the clips of `clips`, a bit each, remove from it.
  CutRay entering(const Ray& ray, std::uint64_t clips) const;
  /// The same, overwriting another ray, which is faster.
  void enter(const Ray& ray, std::uint64_t clips, CutRay& entered) const;

  /// The clips whose border meets the sphere, a bit each.
  std::uint64_t cutting(std::int64_t id) const { return of_sphere(id).cutting; }

  /// All clips that cut some stick.
  std::uint64_t cutting_sticks() const { return cutting_sticks_; }

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

  /// The same for a cut stick. `of`: stick_ray_of(). The ray must know cutting_sticks().
  CutStickHit stick_hit(const CutRay& ray, const StickRay& of, std::int64_t stick) const;
  /// A ray that enter() has made, as the sticks meet it.
  StickRay stick_ray_of(const Ray& ray, const CutRay& entered) const {
    return entered.leaves_clip ? StickRay{entered.ray} : stick_ray(ray, *spheres_, *sticks_);
  }

  /// Appends all intervals of the line of a valid ray that are left of a cut sphere, or of the stick of which this is
  /// half, in their order: also those outside of the segment. The first begins at -inf where the ray starts on the
  /// body's surface and goes inside; there is none where it exits it outward.
  void find_remaining(const Ray& ray, std::int64_t id, std::vector<RemainingPart>& found) const;

  /// The outward normal, of length 1, at the cap where the ray hits the sphere or the half of a stick. False: it hits
  /// the body's own surface, or the body is not cut.
  bool cap_normal(const Ray& ray, std::int64_t id, Vec3d& normal) const;

 private:
  struct CutSphere {
    Remainder remainder = Remainder::whole;
    std::uint64_t cutting = 0;  // the clips whose border meets the sphere
  };
  CutSphere look_at(std::int64_t id) const;
  CutSphere look_at_stick(std::int64_t stick) const;
  CutSphere of_sphere(std::int64_t id) const {
    const auto i = static_cast<std::size_t>(id);
    return i < known_.size() ? known_[i] : look_at(id);
  }
  std::uint64_t clips_on(std::int64_t sphere) const {
    const auto i = static_cast<std::size_t>(sphere);
    return i < clips_of_sphere_->size() ? (*clips_of_sphere_)[i] & all_clips_ : 0;
  }
  void leave_nearest(const Ray& ray, CutRay& entered) const;

  const SphereSet* spheres_;
  const std::vector<std::uint64_t>* clips_of_sphere_;
  std::vector<StoredClip> clips_;
  bool has_round_clips_ = false;
  std::uint64_t all_clips_ = 0;   // a bit each
  std::vector<CutSphere> known_;  // of each sphere that was there at first
  const StickSet* sticks_;        // may be null
  std::vector<CutSphere> of_sticks_;
  std::uint64_t cutting_sticks_ = 0;
};

}  // namespace bihive
