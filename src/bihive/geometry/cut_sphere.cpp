#include "bihive/geometry/cut_sphere.h"

#include <cmath>
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
};

}  // namespace

CutSet::CutSet(const SphereSet& spheres, const std::vector<Clip>& clips,
               const std::vector<std::uint64_t>& clips_of_sphere)
    : spheres_(&spheres), clips_of_sphere_(&clips_of_sphere) {
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
}

CutSet::CutSphere CutSet::look_at(std::int64_t id) const {
  CutSphere found;
  const auto i = static_cast<std::size_t>(id);
  if (i >= clips_of_sphere_->size()) return found;
  for_each_clip((*clips_of_sphere_)[i] & all_clips_, [&](int k) {
    const Remainder left =
        clips_[static_cast<std::size_t>(k)].remainder(spheres_->stored_centre(id), spheres_->stored_radius(id));
    if (left == Remainder::whole || found.remainder == Remainder::nothing) return;
    found.remainder = left;
    if (left == Remainder::cut) found.cutting |= std::uint64_t{1} << k;
  });
  return found;
}

// Finds the surface of a cut sphere on which the ray starts.
void CutSet::leave_nearest(const Ray& ray, CutRay& entered) const {
  const Vec3d origin = entered.ray.origin;
  const double height = length(origin - spheres_->stored_centre(ray.leaves)) - spheres_->stored_radius(ray.leaves);
  StoredClip::Place nearest{std::abs(height), 0};
  int nearest_clip = -1;
  for_each_clip(cutting(ray.leaves), [&](int k) {
    const StoredClip::Place place = clips_[static_cast<std::size_t>(k)].place(origin);
    if (!(place.distance < nearest.distance)) return;
    nearest = place;
    nearest_clip = k;
  });
  if (nearest_clip < 0) return;
  entered.ray.left_radius = -1;
  clips_[static_cast<std::size_t>(nearest_clip)].leave(nearest.face, !ray.inside, entered);
}

CutRay CutSet::entering(const Ray& ray, std::uint64_t clips) const {
  CutRay entered{ScaledRay(ray, spheres_->scale())};
  enter(ray, clips, entered);
  return entered;
}

void CutSet::enter(const Ray& ray, std::uint64_t clips, CutRay& entered) const {
  entered.ray = ScaledRay(ray, *spheres_);
  entered.leaves_plane = false;
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
  const TakenParts taken{cut_ray, cutting(id)};

  // Step along the line, from one remaining interval to the next.
  CutHit place{own ? -kEndOfLine : roots.t_near, -1, 0};
  for (;;) {
    taken.leave(place);
    if (place.t > roots.t_far || (place.t == roots.t_far && place.clip >= 0)) return {};
    if (place.t > ray.t_max) return {};
    if (place.t >= ray.t_min) return place;
    place = taken.next_end(place.t, {roots.t_far, -1, 0});
    if (place.t >= ray.t_min) return place.t <= ray.t_max ? place : CutHit();
    if (place.clip < 0) return {};
  }
}

bool CutSet::cap_normal(const Ray& ray, std::int64_t id, Vec3d& normal) const {
  if (!is_cut(id)) return false;
  const CutRay entered = entering(ray, cutting(id));
  const CutHit met = hit(entered, id);
  if (met.clip < 0) return false;
  const StoredClip& clip = clips_[static_cast<std::size_t>(met.clip)];
  const Vec3d along = met.t * entered.ray.direction;
  normal = clip.outward(met.face, entered.ray.origin, along);
  return true;
}

}  // namespace bihive
