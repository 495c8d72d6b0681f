#include "bihive/geometry/stored_clip.h"

#include <algorithm>
#include <cmath>

#include "bihive/geometry/sphere.h"

namespace bihive {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

int largest_axis(Vec3d v) {
  int largest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(v[axis]) > std::abs(v[largest])) largest = axis;
  return largest;
}

// Spheres have binary32 centres and radii. A clip that was written with the numbers of a sphere is on its surface.
Vec3d rounded(Vec3d v) {
  return to_double(to_float(v));
}
double rounded(double v) {
  return double(static_cast<float>(v));
}

}  // namespace

StoredClip::StoredClip(const Clip& clip, double scale) {
  if (const auto* plane = std::get_if<PlaneClip>(&clip)) {
    // A power of two brings the normal near 1, exactly; so products with it stay in range.
    const int axis = largest_axis(plane->normal);
    int exponent = 0;
    std::frexp(plane->normal[axis], &exponent);
    for (int k = 0; k < 3; ++k) normal_[k] = std::ldexp(plane->normal[k], -exponent);
    offset_ = std::ldexp(plane->offset, -exponent) * scale;
    const double largest = normal_[axis];
    key_ = {normal_ / largest, offset_ / largest};
    length_ = length(normal_);
    takes_front_ = largest > 0;
  } else if (const auto* box = std::get_if<BoxClip>(&clip)) {
    kind_ = Kind::box;
    lo_ = box->lo * scale;
    hi_ = box->hi * scale;
  } else {
    const auto& sphere = std::get<SphereClip>(clip);
    kind_ = Kind::sphere;
    lo_ = sphere.centre * scale;
    radius_ = sphere.radius * scale;
  }
}

Remainder StoredClip::remainder(Vec3d centre, double radius) const {
  if (!(radius > 0)) return Remainder::whole;
  if (kind_ == Kind::plane) return of_plane(centre, radius);
  return kind_ == Kind::box ? of_box(centre, radius) : of_sphere(centre, radius);
}

Remainder StoredClip::of_plane(Vec3d centre, double radius) const {
  const double height = dot(normal_, centre) - offset_;
  const double reach = radius * length_;
  if (height > reach) return Remainder::nothing;
  return height < -reach ? Remainder::whole : Remainder::cut;
}

Remainder StoredClip::of_box(Vec3d centre, double radius) const {
  bool within = true;
  Vec3d beyond;
  for (int axis = 0; axis < 3; ++axis) {
    within = within && centre[axis] - radius > lo_[axis] && centre[axis] + radius < hi_[axis];
    beyond[axis] = std::max({lo_[axis] - centre[axis], centre[axis] - hi_[axis], 0.0});
  }
  if (within) return Remainder::nothing;
  return dot(beyond, beyond) > radius * radius ? Remainder::whole : Remainder::cut;
}

Remainder StoredClip::of_sphere(Vec3d centre, double radius) const {
  const double distance = length(centre - lo_);
  if (distance + radius < radius_) return Remainder::nothing;
  return distance > radius_ + radius ? Remainder::whole : Remainder::cut;
}

TakenPart StoredClip::taken(const CutRay& cut_ray) const {
  if (kind_ == Kind::plane) return by_plane(cut_ray);
  return kind_ == Kind::box ? by_box(cut_ray) : by_sphere(cut_ray);
}

TakenPart StoredClip::by_plane(const CutRay& cut_ray) const {
  if (cut_ray.leaves_plane && cut_ray.plane == key_)
    return cut_ray.to_front == takes_front_ ? TakenPart::everything() : TakenPart::nothing();
  const double speed = dot(normal_, cut_ray.ray.direction);
  const double below = offset_ - dot(normal_, cut_ray.ray.origin);
  if (speed == 0) return below < 0 ? TakenPart::everything() : TakenPart::nothing();
  const double t = below / speed;
  return speed > 0 ? TakenPart::between(t, kNever) : TakenPart::between(-kNever, t);
}

TakenPart StoredClip::by_box(const CutRay& cut_ray) const {
  TakenPart part = TakenPart::everything();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = cut_ray.ray.origin[axis];
    const double speed = cut_ray.ray.direction[axis];
    const int lower = 2 * axis;
    const bool leaves_lower = cut_ray.leaves_plane && cut_ray.plane == key_of_face(lower);
    const bool leaves_upper = cut_ray.leaves_plane && cut_ray.plane == key_of_face(lower + 1);
    // A ray that starts on a face goes away from the box, or to the opposite face.
    if (leaves_lower || leaves_upper) {
      if (cut_ray.to_front != leaves_lower) return TakenPart::nothing();
      const double t = leaves_lower ? (hi_[axis] - origin) / speed : (lo_[axis] - origin) / speed;
      if (speed != 0 && (speed > 0) == leaves_lower && t < part.t_out) {
        part.t_out = t;
        part.face_out = leaves_lower ? lower + 1 : lower;
      }
      continue;
    }
    if (speed == 0) {
      if (!(origin > lo_[axis] && origin < hi_[axis])) return TakenPart::nothing();
      continue;
    }
    const double t_lower = (lo_[axis] - origin) / speed;
    const double t_upper = (hi_[axis] - origin) / speed;
    const double t_in = speed > 0 ? t_lower : t_upper;
    const double t_out = speed > 0 ? t_upper : t_lower;
    if (t_in > part.t_in) {
      part.t_in = t_in;
      part.face_in = speed > 0 ? lower : lower + 1;
    }
    if (t_out < part.t_out) {
      part.t_out = t_out;
      part.face_out = speed > 0 ? lower + 1 : lower;
    }
  }
  return part;
}

TakenPart StoredClip::by_sphere(const CutRay& cut_ray) const {
  const bool leaves = cut_ray.ray.leaves(rounded(lo_), rounded(radius_));
  if (leaves && !cut_ray.ray.inside) return TakenPart::nothing();
  const SphereRoots roots = sphere_roots(cut_ray.ray, lo_, radius_);
  if (!(roots.t_near < roots.t_far)) return TakenPart::nothing();
  return TakenPart::between(leaves ? -kNever : roots.t_near, roots.t_far);
}

PlaneKey StoredClip::key_of_face(int face) const {
  PlaneKey key;
  key.normal[face / 2] = 1;
  key.offset = face % 2 == 0 ? lo_[face / 2] : hi_[face / 2];
  return key;
}

StoredClip::Place StoredClip::place(Vec3d point) const {
  if (kind_ == Kind::plane) return {std::abs(dot(normal_, point) - offset_) / length_, 0};
  if (kind_ == Kind::sphere) return {std::abs(length(point - lo_) - radius_), 0};
  Place nearest{kNever, 0};
  for (int face = 0; face < 6; ++face) {
    // The largest distance along an axis: across the face, or beside it.
    double distance = std::abs(point[face / 2] - (face % 2 == 0 ? lo_ : hi_)[face / 2]);
    for (int axis = 0; axis < 3; ++axis)
      if (axis != face / 2) distance = std::max({distance, lo_[axis] - point[axis], point[axis] - hi_[axis]});
    if (distance < nearest.distance) nearest = {distance, face};
  }
  return nearest;
}

void StoredClip::leave(int face, bool into_clip, CutRay& ray) const {
  if (kind_ == Kind::sphere) {
    ray.ray.left_centre = rounded(lo_);
    ray.ray.left_radius = rounded(radius_);
    ray.ray.inside = into_clip;
    return;
  }
  ray.leaves_plane = true;
  const bool front_taken = kind_ == Kind::plane ? takes_front_ : face % 2 == 0;
  ray.plane = kind_ == Kind::plane ? key_ : key_of_face(face);
  ray.to_front = into_clip == front_taken;
}

Vec3d StoredClip::outward(int face, Vec3d origin, Vec3d along) const {
  if (kind_ == Kind::plane) return normalized(normal_);
  if (kind_ == Kind::sphere) return -normalized((origin - lo_) + along);
  Vec3d inward;
  inward[face / 2] = face % 2 == 0 ? 1 : -1;
  return inward;
}

}  // namespace bihive
