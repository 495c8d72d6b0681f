#include "bihive/render/query/cavity_engine.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bihive/geometry/sphere.h"

namespace bihive {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

// Rays traced at a time: their hits are in memory together.
constexpr std::int64_t kCavityTile = 1 << 12;

RaySpan span_of_one(const Ray& ray) {
  RaySpan span;
  span.count = 1;
  span.origin[0] = &ray.origin.x;
  span.origin[1] = &ray.origin.y;
  span.origin[2] = &ray.origin.z;
  span.direction[0] = &ray.direction.x;
  span.direction[1] = &ray.direction.y;
  span.direction[2] = &ray.direction.z;
  span.t_min = &ray.t_min;
  span.t_max = &ray.t_max;
  span.leaves = &ray.leaves;
  return span;
}

}  // namespace

CavityEngine::CavityEngine(std::shared_ptr<const CavityWalls> walls, std::shared_ptr<const RayEngine> of_union)
    : walls_(std::move(walls)), of_union_(std::move(of_union)) {
  const std::vector<std::int32_t>& cavities = walls_->cavity_of_sphere();
  lining_id_.assign(cavities.size(), kNothing);
  for (std::size_t id = 0; id < cavities.size(); ++id) {
    if (cavities[id] == 0) continue;
    lining_id_[id] = static_cast<std::int64_t>(of_union_id_.size());
    of_union_id_.push_back(static_cast<std::int64_t>(id));
  }
}

bool CavityEngine::is_wall(const ScaledRay& ray, double t, std::int64_t id) const {
  return walls_->is_wall(id, (ray.origin - walls_->spheres().stored_centre(id)) + t * ray.direction);
}

// `first` to `last`: the spheres that the ray meets from t_min on, by t.
template <class Use>
void CavityEngine::points_of(const Ray& ray, const RayHit* first, const RayHit* last, const Use& use) const {
  const SphereSet& spheres = walls_->spheres();
  const ScaledRay scaled(ray, spheres);
  // The intervals in the spheres, those that begin before t_min first.
  struct Inside {
    double from, to;
    std::int64_t id;
  };
  static thread_local std::vector<Inside> list;
  list.clear();
  for (const RayHit* hit = first; hit != last; ++hit) {
    const Vec3d centre = spheres.stored_centre(hit->sphere_id);
    const double radius = spheres.stored_radius(hit->sphere_id);
    const SphereRoots roots = sphere_roots(scaled, centre, radius);
    const bool starts_inside = scaled.leaves(centre, radius) || roots.t_near < ray.t_min;
    list.push_back({starts_inside ? -kEndless : roots.t_near, roots.t_far, hit->sphere_id});
  }
  std::sort(list.begin(), list.end(),
            [](const Inside& a, const Inside& b) { return a.from != b.from ? a.from < b.from : a.id < b.id; });
  const auto is_used_up = [&](double t, std::int64_t id) {
    const std::int64_t lining = lining_id_[static_cast<std::size_t>(id)];
    return lining != kNothing && t >= ray.t_min && t <= ray.t_max && is_wall(scaled, t, id) && !use(t, lining);
  };
  // From gap to gap: where the spheres before it end, and where the next one begins.
  double end = ray.t_min;
  std::int64_t last_id = kNothing;
  for (const Inside& inside : list) {
    if (inside.from > end) {
      if (last_id != kNothing && is_used_up(end, last_id)) return;
      if (is_used_up(inside.from, inside.id) || inside.from > ray.t_max) return;
    }
    if (last_id != kNothing && inside.to <= end) continue;
    end = inside.to;
    last_id = inside.id;
  }
}

template <class Use>
void CavityEngine::each_point(const RaySpan& rays, RayOrder order, const Use& use) const {
  static thread_local std::vector<double> endless;
  static thread_local std::vector<std::int64_t> leaves;
  static thread_local std::vector<RayHit> found;
  const auto union_id = [&](std::int64_t id) {
    return id >= 0 && id < static_cast<std::int64_t>(of_union_id_.size()) ? of_union_id_[static_cast<std::size_t>(id)]
                                                                          : kNothing;
  };
  for (std::int64_t begin = 0; begin < rays.count; begin += kCavityTile) {
    const RaySpan tile = rays.part(begin, std::min(kCavityTile, rays.count - begin));
    RaySpan whole = tile;
    endless.assign(static_cast<std::size_t>(tile.count), kEndless);
    whole.t_max = endless.data();
    if (tile.leaves != nullptr) {
      leaves.resize(static_cast<std::size_t>(tile.count));
      for (std::int64_t i = 0; i < tile.count; ++i) leaves[static_cast<std::size_t>(i)] = union_id(tile.leaves[i]);
      whole.leaves = leaves.data();
    }
    of_union_->all_hits(whole, order, found);
    const RayHit* hit = found.data();
    const RayHit* const end = hit + found.size();
    while (hit != end) {
      const RayHit* const first = hit;
      while (hit != end && hit->ray == first->ray) ++hit;
      Ray ray = whole.at(first->ray);
      if (tile.t_max != nullptr) ray.t_max = tile.t_max[first->ray];
      if (!is_valid(ray)) continue;
      points_of(ray, first, hit, [&](double t, std::int64_t id) { return use(begin + first->ray, t, id); });
    }
  }
}

Hit CavityEngine::closest_hit(const Ray& ray) const {
  Hit hit;
  RaySpan one = span_of_one(ray);
  const std::uint8_t inside = ray.inside ? 1 : 0;
  one.inside = &inside;
  closest_hits(one, RayOrder::any, {&hit.t, &hit.sphere_id});
  return hit;
}

bool CavityEngine::occluded(const Ray& ray) const {
  return closest_hit(ray).found();
}

void CavityEngine::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  for (std::int64_t i = 0; i < rays.count; ++i) {
    hits.t[i] = kEndless;
    hits.sphere_id[i] = kNothing;
  }
  each_point(rays, order, [&](std::int64_t ray, double t, std::int64_t id) {
    hits.t[ray] = t;
    hits.sphere_id[ray] = id;
    return false;
  });
}

void CavityEngine::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  std::fill_n(is_occluded, rays.count, std::uint8_t{0});
  each_point(rays, order, [&](std::int64_t ray, double, std::int64_t) {
    is_occluded[ray] = 1;
    return false;
  });
}

void CavityEngine::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  found.clear();
  std::size_t first = 0;
  each_point(rays, order, [&](std::int64_t ray, double t, std::int64_t id) {
    if (first < found.size() && found[first].ray != ray) first = found.size();
    const bool is_new = std::none_of(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                                     [id](const RayHit& hit) { return hit.sphere_id == id; });
    if (is_new) found.push_back({ray, t, id});
    return true;
  });
  sort_hits(found);
}

}  // namespace bihive
