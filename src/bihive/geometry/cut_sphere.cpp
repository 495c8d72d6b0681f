#include "bihive/geometry/cut_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bihive/geometry/sphere.h"

namespace bihive {
namespace {

constexpr double kEndOfLine = std::numeric_limits<double>::infinity();

// Calls use(k) for each bit k that is set, from the lowest on.
template <class Use>
void for_each_clip(std::uint64_t mask, const Use& use) {
  for (; mask != 0; mask &= mask - 1) use(__builtin_ctzll(mask));
}

// The intervals of a line that the clips of one sphere remove.
struct TakenParts {
  const CutRay& ray;
  std::uint64_t clips;

  // Advances from a point inside removed intervals to their end.
  void leave(CutHit& place) const {
    for (bool moved = true; moved;) {
      moved = false;
      for_each_clip(clips, [&](int k) {
        const TakenPart& part = ray.taken[static_cast<std::size_t>(k)];
        if (!(part.t_in <= place.t && place.t < part.t_out)) return;
        place = {part.t_out, k, part.face_out};
        moved = true;
      });
    }
  }

  // The end of the remaining interval, from a point that no clip removes: `end`, or an earlier point where a removed
  // interval begins.
  CutHit next_end(double place, CutHit end) const {
    for_each_clip(clips, [&](int k) {
      const TakenPart& part = ray.taken[static_cast<std::size_t>(k)];
      if (!part.empty() && part.t_in > place && part.t_in < end.t) end = {part.t_in, k, part.face_in};
    });
    return end;
  }

  // The first end of a remaining interval of a body that lies in the segment, of a line that is in the body from
  // `start` on (-inf: the ray starts inside) until `end`. `exits`: whether this end counts.
  CutHit first_end(double start, double end, bool exits) const {
    CutHit place{start, -1, 0};
    for (;;) {
      leave(place);
      if (place.t > end || (place.t == end && place.clip >= 0)) return {};
      if (place.t > ray.ray.t_max) return {};
      if (place.t >= ray.ray.t_min) return place;
      place = next_end(place.t, {end, -1, 0});
      if (place.clip < 0 && !exits) return {};
      if (place.t >= ray.ray.t_min) return place.t <= ray.ray.t_max ? place : CutHit();
      if (place.clip < 0) return {};
    }
  }

  // All of them.
  void find_parts(double start, double end, std::vector<RemainingPart>& found) const {
    for (CutHit place{start, -1, 0};;) {
      leave(place);
      if (!(place.t <= end) || (place.t == end && place.clip >= 0)) return;
      const double in = place.t;
      place = next_end(in, {end, -1, 0});
      found.push_back({in, place.t});
      if (place.clip < 0) return;
    }
  }
};

double squared(Vec3d v) {
  return dot(v, v);
}

// The position along the axis of a stick that is nearest to a point, from 0 to 1.
double position_along(const Stick& stick, Vec3d point) {
  const Vec3d axis = stick.b - stick.a;
  const double length_squared = dot(axis, axis);
  return length_squared > 0 ? std::clamp(dot(point - stick.a, axis) / length_squared, 0.0, 1.0) : 0;
}

// How far a point is outside of a stick, below 0: inside.
double height_above(const Stick& stick, Vec3d point) {
  const Vec3d axis = stick.b - stick.a;
  const double widening = stick.radius_b - stick.radius_a;
  const double side_squared = dot(axis, axis) - widening * widening;
  double s = widening > 0 ? 1 : 0;
  if (side_squared > 0) {
    // The nearest ball of a cone is not the one beside the point.
    const double length_squared = dot(axis, axis);
    const double beside = dot(point - stick.a, axis) / length_squared;
    const double apart = std::sqrt(squared(point - stick.a - beside * axis));
    s = std::clamp(beside + apart * widening / std::sqrt(length_squared * side_squared), 0.0, 1.0);
  }
  return std::sqrt(squared(point - (stick.a + s * axis))) - (stick.radius_a + s * widening);
}

}  // namespace

CutSet::CutSet(const SphereSet& spheres, const std::vector<Clip>& clips,
               const std::vector<std::uint64_t>& clips_of_sphere, const StickSet* sticks)
    : spheres_(&spheres), clips_of_sphere_(&clips_of_sphere), sticks_(sticks) {
  clips_.reserve(clips.size());
  for (const Clip& clip : clips) {
    clips_.emplace_back(clip, spheres);
    has_round_clips_ = has_round_clips_ || clips_.back().is_round();
  }
  all_clips_ = clips.size() < kMostClips ? (std::uint64_t{1} << clips.size()) - 1 : ~std::uint64_t{0};
  std::vector<CutSphere> known;
  known.reserve(static_cast<std::size_t>(spheres.size()));
  for (std::int64_t id = 0; id < spheres.size(); ++id) known.push_back(look_at(id));
  known_ = std::move(known);
  if (sticks == nullptr) return;
  of_sticks_.reserve(static_cast<std::size_t>(sticks->size()));
  for (std::int64_t stick = 0; stick < sticks->size(); ++stick) {
    of_sticks_.push_back(look_at_stick(stick));
    cutting_sticks_ |= of_sticks_.back().cutting;
  }
}

CutSet::CutSphere CutSet::look_at(std::int64_t id) const {
  CutSphere found;
  for_each_clip(clips_on(id), [&](int k) {
    const Remainder left =
        clips_[static_cast<std::size_t>(k)].remainder(spheres_->stored_centre(id), spheres_->stored_radius(id));
    if (left == Remainder::whole || found.remainder == Remainder::nothing) return;
    found.remainder = left;
    if (left == Remainder::cut) found.cutting |= std::uint64_t{1} << k;
  });
  return found;
}

// Each clip removes a convex region, so a stick whose ends it removes is gone. A plane also leaves a convex region.
CutSet::CutSphere CutSet::look_at_stick(std::int64_t id) const {
  // A clip leaves spheres of radius 0 whole, but not the point of a cone.
  constexpr double kLeastRadius = std::numeric_limits<double>::min();
  const Stick stick = sticks_->stored(*spheres_, id);
  CutSphere found;
  for_each_clip(clips_on(sticks_->sphere_at(*spheres_, 2 * id)) & clips_on(sticks_->sphere_at(*spheres_, 2 * id + 1)),
                [&](int k) {
                  const StoredClip& clip = clips_[static_cast<std::size_t>(k)];
                  const Remainder a = clip.remainder(stick.a, std::max(stick.radius_a, kLeastRadius));
                  const Remainder b = clip.remainder(stick.b, std::max(stick.radius_b, kLeastRadius));
                  if (a == Remainder::whole && b == Remainder::whole && clip.is_plane()) return;
                  if (found.remainder == Remainder::nothing) return;
                  found.remainder =
                      a == Remainder::nothing && b == Remainder::nothing ? Remainder::nothing : Remainder::cut;
                  found.cutting |= std::uint64_t{1} << k;
                });
  return found;
}

// Finds the surface of a cut body on which the ray starts.
void CutSet::leave_nearest(const Ray& ray, CutRay& entered) const {
  const Vec3d origin = entered.ray.origin;
  const bool of_stick = is_of_stick(ray.leaves);
  std::uint64_t clips = 0;
  double height = 0;
  if (of_stick) {
    const std::int64_t id = (ray.leaves - spheres_->size()) / 2;
    const Stick stick = sticks_->stored(*spheres_, id);
    height = height_above(stick, origin);
    clips = of_sticks_[static_cast<std::size_t>(id)].cutting;
  } else {
    height = length(origin - spheres_->stored_centre(ray.leaves)) - spheres_->stored_radius(ray.leaves);
    clips = cutting(ray.leaves);
  }
  StoredClip::Place nearest{std::abs(height), 0};
  int nearest_clip = -1;
  for_each_clip(clips, [&](int k) {
    const StoredClip::Place place = clips_[static_cast<std::size_t>(k)].place(origin);
    if (!(place.distance < nearest.distance)) return;
    nearest = place;
    nearest_clip = k;
  });
  if (nearest_clip < 0) return;
  entered.leaves_clip = true;
  entered.ray.left_radius = -1;
  clips_[static_cast<std::size_t>(nearest_clip)].leave(nearest.face, !ray.inside, entered);
}

CutRay CutSet::entering(const Ray& ray, std::uint64_t clips) const {
  CutRay entered{ScaledRay(ray, spheres_->scale())};
  enter(ray, clips, entered);
  return entered;
}

void CutSet::enter(const Ray& ray, std::uint64_t clips, CutRay& entered) const {
  Ray on_sphere = ray;
  if (is_of_stick(ray.leaves)) on_sphere.leaves = left_sphere(*spheres_, *sticks_, ray.leaves, ray.inside);
  entered.ray = ScaledRay(on_sphere, *spheres_);
  entered.leaves_clip = entered.leaves_plane = false;
  if (is_cut(ray.leaves)) leave_nearest(ray, entered);
  for_each_clip(clips, [&](int k) {
    entered.taken[static_cast<std::size_t>(k)] = clips_[static_cast<std::size_t>(k)].taken(entered);
  });
}

bool CutSet::narrow(std::uint64_t clips, CutRay& cut_ray) {
  ScaledRay& ray = cut_ray.ray;
  for_each_clip(clips, [&](int k) {
    const TakenPart& part = cut_ray.taken[static_cast<std::size_t>(k)];
    if (part.empty()) return;
    const bool from_start = part.t_in < ray.t_min || part.t_in == -kEndOfLine;
    const bool to_end = part.t_out > ray.t_max || part.t_out == kEndOfLine;
    if (from_start && part.t_out > ray.t_min) ray.t_min = part.t_out;
    if (to_end && part.t_in < ray.t_max) ray.t_max = part.t_in;
  });
  return ray.t_min <= ray.t_max;
}

CutHit CutSet::hit(const CutRay& cut_ray, std::int64_t id) const {
  const ScaledRay& ray = cut_ray.ray;
  const Vec3d centre = spheres_->stored_centre(id);
  const double radius = spheres_->stored_radius(id);
  const bool own = ray.leaves(centre, radius);
  if (own && !ray.inside) return {};
  const SphereRoots roots = sphere_roots(ray, centre, radius);
  if (!(roots.t_far >= ray.t_min)) return {};
  return TakenParts{cut_ray, cutting(id)}.first_end(own ? -kEndOfLine : roots.t_near, roots.t_far, true);
}

CutStickHit CutSet::stick_hit(const CutRay& cut_ray, const StickRay& of, std::int64_t id) const {
  const Stick stick = sticks_->stored(*spheres_, id);
  const auto [roots, enters, exits] = stick_passage(of, stick);
  if (!(roots.t_far >= cut_ray.ray.t_min)) return {};
  const TakenParts taken{cut_ray, of_sticks_[static_cast<std::size_t>(id)].cutting};
  CutStickHit found{taken.first_end(enters ? roots.t_near : -kEndOfLine, roots.t_far, exits)};
  if (found.hit.clip >= 0)
    found.s = position_along(stick, cut_ray.ray.origin + found.hit.t * cut_ray.ray.direction);
  else
    found.s = found.hit.t == roots.t_near ? roots.s_near : roots.s_far;
  return found;
}

void CutSet::find_remaining(const Ray& ray, std::int64_t id, std::vector<RemainingPart>& found) const {
  if (is_of_stick(id)) {
    const std::int64_t stick = (id - spheres_->size()) / 2;
    const CutRay entered = entering(ray, cutting_sticks_);
    const StickPassage passage = stick_passage(stick_ray_of(ray, entered), sticks_->stored(*spheres_, stick));
    const TakenParts taken{entered, of_sticks_[static_cast<std::size_t>(stick)].cutting};
    if (!std::isnan(passage.roots.t_near))
      taken.find_parts(passage.enters ? passage.roots.t_near : -kEndOfLine, passage.roots.t_far, found);
    return;
  }
  const CutRay entered = entering(ray, cutting(id));
  const Vec3d centre = spheres_->stored_centre(id);
  const double radius = spheres_->stored_radius(id);
  const bool own = entered.ray.leaves(centre, radius);
  if (own && !ray.inside) return;
  const SphereRoots roots = sphere_roots(entered.ray, centre, radius);
  if (!std::isnan(roots.t_near))
    TakenParts{entered, cutting(id)}.find_parts(own ? -kEndOfLine : roots.t_near, roots.t_far, found);
}

bool CutSet::cap_normal(const Ray& ray, std::int64_t id, Vec3d& normal) const {
  if (!is_cut(id)) return false;
  const bool of_stick = is_of_stick(id);
  const CutRay entered = entering(ray, of_stick ? cutting_sticks_ : cutting(id));
  const CutHit met =
      of_stick ? stick_hit(entered, stick_ray_of(ray, entered), (id - spheres_->size()) / 2).hit : hit(entered, id);
  if (met.clip < 0) return false;
  const StoredClip& clip = clips_[static_cast<std::size_t>(met.clip)];
  const Vec3d along = met.t * entered.ray.direction;
  normal = clip.outward(met.face, entered.ray.origin, along);
  return true;
}

}  // namespace bihive
