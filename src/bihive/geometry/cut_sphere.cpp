#include "bihive/geometry/cut_sphere.h"

#include <array>
#include <cmath>

#include "bihive/geometry/sphere.h"

namespace bihive {
namespace {

constexpr double kEndOfLine = std::numeric_limits<double>::infinity();

// Calls use(k) for each bit k that is set, from the lowest on.
template <class Use>
void for_each_clip(std::uint64_t mask, const Use& use) {
  for (int k = 0; mask != 0; ++k, mask >>= 1)
    if ((mask & 1) != 0) use(k);
}

// What the clips of one sphere take of a line.
struct TakenParts {
  struct Part {
    double t_in, t_out;
    int face_in, face_out, clip;
  };
  // At most kMostClips; the array is written before it is read.
  std::array<Part, kMostClips> parts;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  int count = 0;

  void add(const TakenPart& taken, int clip) {
    if (!taken.empty())
      parts[static_cast<std::size_t>(count++)] = {taken.t_in, taken.t_out, taken.face_in, taken.face_out, clip};
  }

  // Goes from a place inside taken parts to their end.
  void leave_taken(CutHit& place) const {
    for (int i = 0; i < count; ++i) {
      const Part& part = parts[static_cast<std::size_t>(i)];
      if (!(part.t_in <= place.t && place.t < part.t_out)) continue;
      place = {part.t_out, part.clip, part.face_out};
      i = -1;
    }
  }

  // The end of what is left, from a place on that no part takes: `end`, or where a part begins before it.
  CutHit next_end(double place, CutHit end) const {
    for (int i = 0; i < count; ++i) {
      const Part& part = parts[static_cast<std::size_t>(i)];
      if (part.t_in > place && part.t_in < end.t) end = {part.t_in, part.clip, part.face_in};
    }
    return end;
  }
};

}  // namespace

CutSet::CutSet(const SphereSet& spheres, const std::vector<Clip>& clips,
               const std::vector<std::uint64_t>& clips_of_sphere)
    : spheres_(&spheres),
      remainders_(static_cast<std::size_t>(spheres.size()), Remainder::whole),
      cutting_(remainders_.size(), 0) {
  clips_.reserve(clips.size());
  for (const Clip& clip : clips) clips_.emplace_back(clip, spheres.scale());
  const std::uint64_t known = clips.size() < kMostClips ? (std::uint64_t{1} << clips.size()) - 1 : ~std::uint64_t{0};
  for (std::size_t i = 0; i < clips_of_sphere.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    for_each_clip(clips_of_sphere[i] & known, [&](int k) {
      const Remainder left =
          clips_[static_cast<std::size_t>(k)].remainder(spheres.stored_centre(id), spheres.stored_radius(id));
      if (left == Remainder::whole || remainders_[i] == Remainder::nothing) return;
      remainders_[i] = left;
      if (left == Remainder::cut) cutting_[i] |= std::uint64_t{1} << k;
    });
  }
}

CutRay CutSet::entering(const Ray& ray) const {
  if (!is_cut(ray.leaves)) return {ScaledRay(ray, *spheres_), false, {}, false};
  const Vec3d origin = to_double(ray.origin) * spheres_->scale();
  const double height = length(origin - spheres_->stored_centre(ray.leaves)) - spheres_->stored_radius(ray.leaves);
  StoredClip::Place nearest{std::abs(height), 0};
  int nearest_clip = -1;
  for_each_clip(cutting_[static_cast<std::size_t>(ray.leaves)], [&](int k) {
    const StoredClip::Place place = clips_[static_cast<std::size_t>(k)].place(origin);
    if (!(place.distance < nearest.distance)) return;
    nearest = place;
    nearest_clip = k;
  });
  if (nearest_clip < 0) return {ScaledRay(ray, *spheres_), false, {}, false};
  CutRay entered{ScaledRay(ray, spheres_->scale()), false, {}, false};
  clips_[static_cast<std::size_t>(nearest_clip)].leave(nearest.face, !ray.inside, entered);
  return entered;
}

CutHit CutSet::hit(const CutRay& cut_ray, std::int64_t id) const {
  const ScaledRay& ray = cut_ray.ray;
  const Vec3d centre = spheres_->stored_centre(id);
  const double radius = spheres_->stored_radius(id);
  const bool own = ray.leaves(centre, radius);
  if (own && !ray.inside) return {};
  const SphereRoots roots = sphere_roots(ray, centre, radius);
  if (!(roots.t_far >= ray.t_min)) return {};
  TakenParts taken;
  for_each_clip(cutting_[static_cast<std::size_t>(id)],
                [&](int k) { taken.add(clips_[static_cast<std::size_t>(k)].taken(cut_ray), k); });

  // Go along the line, from one part that is left to the next.
  CutHit place{own ? -kEndOfLine : roots.t_near, -1, 0};
  for (;;) {
    taken.leave_taken(place);
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
  const CutRay entered = entering(ray);
  const CutHit met = hit(entered, id);
  if (met.clip < 0) return false;
  const StoredClip& clip = clips_[static_cast<std::size_t>(met.clip)];
  const Vec3d along = met.t * entered.ray.direction;
  normal = clip.outward(met.face, entered.ray.origin, along);
  return true;
}

}  // namespace bihive
