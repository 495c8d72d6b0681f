// A clip as rays meet it: in the stored units of one sphere set, in binary64.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "bihive/geometry/clip.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// A plane of a clip, such that equal planes have equal keys: the largest component of `normal` is 1 (of equal ones the
/// first). The plane's front is where normal . p > offset.
struct PlaneKey {
  Vec3d normal;
  double offset = 0;

  friend bool operator==(const PlaneKey& a, const PlaneKey& b) { return a.normal == b.normal && a.offset == b.offset; }
};

/// The open interval of a line that a clip removes: empty unless t_in < t_out. `face_in`, `face_out`: for a box, the
/// faces at both ends: twice the axis, and 1 more for the upper one.
struct TakenPart {
  double t_in, t_out;
  int face_in, face_out;

  static TakenPart between(double in, double out) { return {in, out, 0, 0}; }
  static TakenPart nothing() { return between(0, 0); }
  static TakenPart everything() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return between(-inf, inf);
  }
  bool empty() const { return !(t_in < t_out); }
};

/// A ray that may start on a cap. If it exits a sphere, or the round cap that a sphere of this centre and radius made,
/// the scaled ray says so; `inside` then means that it goes into that sphere.
struct CutRay {
  explicit CutRay(const ScaledRay& entering) : ray(entering) {}

  ScaledRay ray;
  bool leaves_clip = false;   ///< the ray exits the boundary of a clip
  bool leaves_plane = false;  ///< a flat cap
  PlaneKey plane;             ///< of this cap
  bool to_front = false;      ///< the side to which the ray goes
  /// The interval of the line that each clip removes; the entries of the clips that were asked for (CutSet::entering).
  std::array<TakenPart, kMostClips> taken;
};

/// The sphere after a clip: untouched, cut open, or gone.
enum class Remainder { whole, cut, nothing };

class StoredClip {
 public:
  StoredClip(const Clip& clip, const SphereSet& spheres)
      : StoredClip(spheres.has_origin() ? moved(clip, -spheres.origin()) : clip, spheres.scale()) {}
  /// From a clip in local coordinates. `scale` is the scale of the sphere set, a power of two.
  StoredClip(const Clip& clip, double scale);

  bool is_plane() const { return kind_ == Kind::plane; }
  bool is_round() const { return kind_ == Kind::sphere; }
  /// Whether it is a ball with this centre and radius.
  bool is_ball(Vec3d centre, double radius) const { return is_round() && lo_ == centre && radius_ == radius; }

  /// A sphere that the boundary touches is cut. A sphere of radius 0, which no ray meets, remains whole.
  Remainder remainder(Vec3d centre, double radius) const;

  TakenPart taken(const CutRay& cut_ray) const;

  /// The distance of a point on the surface of a cut sphere from this clip's boundary, and the face of a box. The
  /// surface with the smallest distance is the one on which the point lies.
  struct Place {
    double distance;
    int face;
  };
  Place place(Vec3d point) const;

  /// Tells a ray, whose origin lies on this boundary, that it exits there. `into_clip`: it goes to the side that is
  /// removed.
  void leave(int face, bool into_clip, CutRay& ray) const;

  /// The direction, of length 1, from the cap into the removed side. The point is origin + along.
  Vec3d outward(int face, Vec3d origin, Vec3d along) const;

 private:
  enum class Kind { plane, box, sphere };

  Remainder of_plane(Vec3d centre, double radius) const;
  Remainder of_box(Vec3d centre, double radius) const;
  Remainder of_sphere(Vec3d centre, double radius) const;
  TakenPart by_plane(const CutRay& cut_ray) const;
  TakenPart by_box(const CutRay& cut_ray) const;
  TakenPart by_sphere(const CutRay& cut_ray) const;
  PlaneKey key_of_face(int face) const;

  Kind kind_ = Kind::plane;
  Vec3d normal_;  // plane: exact, its largest component between 1/2 and 1
  double offset_ = 0;
  Vec3d lo_, hi_;  // box; sphere: lo_ is the centre
  double radius_ = 0;
  // For a plane.
  PlaneKey key_;
  double length_ = 1;  // of the normal
  bool takes_front_ = false;
};

}  // namespace bihive
