#include "bihive/render/query/subset_engine.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {
namespace {

constexpr std::int64_t kNotSearched = -2;
static_assert(kNotSearched != kNothing);

// Spheres are equal if centre and radius are.
using Place = std::array<float, 4>;
Place place_in(const SphereSet& spheres, std::int64_t id) {
  const auto i = static_cast<std::size_t>(id);
  return {spheres.x()[i], spheres.y()[i], spheres.z()[i], spheres.r()[i]};
}

}  // namespace

Subset::Subset(const SphereSet& whole, std::vector<std::int64_t> ids)
    : spheres_(whole.part(ids)), ids_(std::move(ids)) {
  // Sort by x first: numbers beside their ids are compared much faster than spheres in their arrays.
  std::vector<std::pair<float, std::int64_t>> by_x(ids_.size());
  for (std::size_t i = 0; i < by_x.size(); ++i) by_x[i] = {spheres_.x()[i], static_cast<std::int64_t>(i)};
  std::sort(by_x.begin(), by_x.end());
  by_place_.resize(by_x.size());
  for (std::size_t begin = 0, end = 0; begin < by_x.size(); begin = end) {
    for (end = begin; end < by_x.size() && by_x[end].first == by_x[begin].first; ++end)
      by_place_[end] = by_x[end].second;
    if (end - begin == 1) continue;
    std::sort(by_place_.begin() + static_cast<std::ptrdiff_t>(begin),
              by_place_.begin() + static_cast<std::ptrdiff_t>(end), [this](std::int64_t a, std::int64_t b) {
                const Place one = place_in(spheres_, a);
                const Place other = place_in(spheres_, b);
                return one != other ? one < other : a < b;
              });
  }

  // The spheres of the subset equal the first one of their place; others are searched for.
  equal_.assign(static_cast<std::size_t>(whole.size()), kNotSearched);
  for (std::size_t i = 0, first = 0; i < by_place_.size(); ++i) {
    if (place_in(spheres_, by_place_[i]) != place_in(spheres_, by_place_[first])) first = i;
    equal_[static_cast<std::size_t>(ids_[static_cast<std::size_t>(by_place_[i])])] = by_place_[first];
  }
  for (std::int64_t id = 0; id < whole.size(); ++id)
    if (std::int64_t& equal = equal_[static_cast<std::size_t>(id)]; equal == kNotSearched)
      equal = find(whole.stored_centre(id), whole.stored_radius(id));
}

std::int64_t Subset::find(Vec3d stored_centre, double stored_radius) const {
  const Vec3f at = to_float(stored_centre);
  const Place wanted{at.x, at.y, at.z, static_cast<float>(stored_radius)};
  const auto equal =
      std::lower_bound(by_place_.begin(), by_place_.end(), wanted,
                       [this](std::int64_t id, const Place& place) { return place_in(spheres_, id) < place; });
  return equal != by_place_.end() && place_in(spheres_, *equal) == wanted ? *equal : kNothing;
}

std::int64_t Subset::equal_of(const CutRay& entered) const {
  return entered.ray.left_radius >= 0 ? find(entered.ray.left_centre, entered.ray.left_radius) : kNothing;
}

SubsetEngine::SubsetEngine(std::shared_ptr<const Subset> subset, std::shared_ptr<const RayEngine> of_subset,
                           std::shared_ptr<const CutSet> cuts)
    : subset_(std::move(subset)), of_subset_(std::move(of_subset)), cuts_(std::move(cuts)) {}

Ray SubsetEngine::translated(const Ray& ray) const {
  Ray here = ray;
  here.leaves = subset_->equal_of(ray.leaves);
  if (cuts_ == nullptr || !cuts_->is_cut(ray.leaves)) return here;
  if (here.leaves == kNothing && !cuts_->has_round_clips() && !cuts_->is_of_stick(ray.leaves)) return here;
  const CutRay entered = cuts_->entering(ray, 0);
  here.leaves = subset_->equal_of(entered);
  here.inside = entered.ray.inside;
  return here;
}

RaySpan SubsetEngine::translated(const RaySpan& rays) const {
  RaySpan here = rays;
  if (rays.leaves == nullptr) return here;
  static thread_local std::vector<std::int64_t> all_leaves;
  static thread_local std::vector<std::uint8_t> all_inside;
  all_leaves.resize(static_cast<std::size_t>(rays.count));
  here.leaves = all_leaves.data();
  all_inside.resize(all_leaves.size());
  if (cuts_ != nullptr) here.inside = all_inside.data();
  for (std::size_t i = 0; i < all_leaves.size(); ++i) {
    all_leaves[i] = subset_->equal_of(rays.leaves[i]);
    if (cuts_ == nullptr) continue;
    all_inside[i] = rays.inside != nullptr ? rays.inside[i] : 0;
    if (!cuts_->is_cut(rays.leaves[i])) continue;
    if (all_leaves[i] == kNothing && !cuts_->has_round_clips() && !cuts_->is_of_stick(rays.leaves[i])) continue;
    const Ray ray = translated(rays.at(static_cast<std::int64_t>(i)));
    all_leaves[i] = ray.leaves;
    all_inside[i] = ray.inside ? 1 : 0;
  }
  return here;
}

Hit SubsetEngine::closest_hit(const Ray& ray) const {
  Hit hit = of_subset_->closest_hit(translated(ray));
  if (hit.found()) hit.sphere_id = subset_->whole_id(hit.sphere_id);
  return hit;
}

bool SubsetEngine::occluded(const Ray& ray) const {
  return of_subset_->occluded(translated(ray));
}

void SubsetEngine::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  of_subset_->closest_hits(translated(rays), order, hits);
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (hits.sphere_id[i] >= 0) hits.sphere_id[i] = subset_->whole_id(hits.sphere_id[i]);
}

void SubsetEngine::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  of_subset_->occluded(translated(rays), order, is_occluded);
}

void SubsetEngine::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  of_subset_->all_hits(translated(rays), order, found);
  for (RayHit& hit : found) hit.sphere_id = subset_->whole_id(hit.sphere_id);
}

void SubsetEngine::optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                                  const DepthSums& sums) const {
  BIHIVE_CHECK(depths.number_of == nullptr);  // rows are indexed by ids of the whole set
  of_subset_->optical_depths(translated(rays), order, {depths.rows, depths.columns, subset_->whole_ids()}, sums);
}

}  // namespace bihive
