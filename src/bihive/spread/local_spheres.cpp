#include "bihive/spread/local_spheres.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace bihive {
namespace {

bool is_to_eye(WhichSpheres which) {
  return which == WhichSpheres::opaque_to_eye || which == WhichSpheres::clear_to_eye;
}

}  // namespace

Result<std::shared_ptr<const LocalSpheres>> LocalSpheres::make(Scene spheres, std::vector<std::int64_t> whole_ids,
                                                               std::int64_t count, const SphereColumns& has,
                                                               OpacityRule rule, const TreeParameters& parameters,
                                                               int threads) {
  if (spheres.spheres.size() >= static_cast<std::int64_t>(kNoPlace))
    return Error{"a rank cannot hold " + std::to_string(spheres.spheres.size()) + " spheres", "", 0, 0,
                 "use more ranks: each holds up to 2^32"};
  auto made = std::make_shared<LocalSpheres>();
  made->count_ = count;
  made->scene_ = std::move(spheres);
  made->whole_ids_ = std::move(whole_ids);
  made->has_ = has;
  Result<Tracer> tracer = Tracer::build(made->scene_, Engine::wide, parameters, threads, count);
  if (!tracer) return tracer.error();
  made->tracer_.emplace(std::move(*tracer));
  Result<Transparency> transparency = Transparency::of(made->scene_, rule, Engine::wide, threads, count);
  if (!transparency) return transparency.error();
  made->transparency_ = std::move(*transparency);
  return std::shared_ptr<const LocalSpheres>(std::move(made));
}

// A rank without clear spheres has no division: all its spheres are opaque.
void LocalSpheres::closest_hits(WhichSpheres which, const RaySpan& rays, RayOrder order,
                                std::vector<FoundSphere>& found) const {
  found.clear();
  static thread_local HitBatch hits;
  hits.resize(rays.count);
  const auto& divided = is_to_eye(which) ? transparency_.to_eye : transparency_.to_light;
  if (which == WhichSpheres::all || divided == nullptr)
    tracer_->closest_hits(rays, order, hits.span());
  else
    divided->closest_opaque(rays, order, hits.span());
  for (std::int64_t i = 0; i < rays.count; ++i)
    if (const Hit hit = hits.at(i); hit.found()) found.push_back(found_sphere(i, hit.t, hit.sphere_id));
}

void LocalSpheres::occluded(WhichSpheres which, const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  const auto& divided = is_to_eye(which) ? transparency_.to_eye : transparency_.to_light;
  if (which == WhichSpheres::all || divided == nullptr)
    tracer_->occluded(rays, order, is_occluded);
  else
    divided->hides(rays, order, is_occluded);
}

void LocalSpheres::all_hits(WhichSpheres which, const RaySpan& rays, RayOrder order,
                            std::vector<FoundSphere>& found) const {
  found.clear();
  const auto& divided = is_to_eye(which) ? transparency_.to_eye : transparency_.to_light;
  if (divided == nullptr) return;
  static thread_local std::vector<RayHit> hits;
  divided->find_crossings(rays, order, hits);
  for (const RayHit& hit : hits) found.push_back(found_sphere(hit.ray, hit.t, hit.sphere_id));
}

void LocalSpheres::pack(const std::vector<std::int64_t>& places, Bytes& bytes) const {
  pack_spheres(scene_, has_, whole_ids_, places, bytes);
}

std::int64_t LocalSpheres::place_of_ghost(std::int64_t whole_id) const {
  const auto first = whole_ids_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::lower_bound(first, whole_ids_.end(), whole_id);
  return found != whole_ids_.end() && *found == whole_id ? found - whole_ids_.begin() : kNothing;
}

Bytes LocalSpheres::answer(const Bytes& question) const {
  ByteReader in(question);
  Bytes bytes;
  const auto kind = in.take<QuestionKind>();
  if (kind == QuestionKind::spheres) {
    std::vector<Place> asked(static_cast<std::size_t>(in.take<std::int64_t>()));
    in.take_array(asked.data(), asked.size());
    pack({asked.begin(), asked.end()}, bytes);
    return bytes;
  }
  static thread_local RaysAsked asked;
  take_rays(in, asked);
  for (std::size_t i = 0; i < asked.ghosts.size(); ++i)
    if (asked.ghosts[i] != kNothing) asked.rays.leaves[i] = place_of_ghost(asked.ghosts[i]);
  const RaySpan rays = asked.rays.span();
  if (kind == QuestionKind::occluded) {
    static thread_local std::vector<std::uint8_t> is_occluded;
    is_occluded.resize(static_cast<std::size_t>(rays.count));
    occluded(asked.which, rays, asked.order, is_occluded.data());
    put_occluded(is_occluded, bytes);
    return bytes;
  }
  static thread_local std::vector<FoundSphere> found;
  if (kind == QuestionKind::closest)
    closest_hits(asked.which, rays, asked.order, found);
  else
    all_hits(asked.which, rays, asked.order, found);
  put_found(found, bytes);
  return bytes;
}

}  // namespace bihive
