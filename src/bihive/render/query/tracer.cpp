#include "bihive/render/tracer.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/memory.h"
#include "bihive/base/timer.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/query/build_engine.h"
#include "bihive/render/query/cavity_engine.h"
#include "bihive/render/query/pixel_order.h"
#include "bihive/render/query/reference_engine.h"
#include "bihive/render/query/remote_rays.h"
#include "bihive/render/query/stick_engine.h"
#include "bihive/render/query/wide_engine.h"
#include "bihive/scene/clips.h"

namespace bihive {

BuildParameters TreeParameters::for_reference() const {
  BuildParameters both;
  both.max_prims = max_prims.value_or(both.max_prims);
  both.max_depth = max_depth.value_or(both.max_depth);
  return both;
}

// 0 is the wide builder's own choice. A leaf cannot hold more than all spheres, and a tree has at most as many levels
// as spheres.
WideParameters TreeParameters::for_wide(std::int64_t spheres) const {
  const auto bounded = [&](std::optional<std::int64_t> value) {
    return value ? std::clamp<std::int64_t>(*value, 1, std::max<std::int64_t>(spheres, 1)) : 0;
  };
  WideParameters wide;
  wide.max_prims = bounded(max_prims);
  if (max_depth && *max_depth != kUnlimited) wide.max_depth = bounded(max_depth);
  return wide;
}

Result<Tracer> Tracer::build(const SphereSet& spheres, Engine engine, const TreeParameters& parameters, int threads) {
  WatchedWork work(WatchedWork::InnerProgress::passed_on);
  const Timer timer;
  const EngineParameters built(engine, parameters, threads);
  Result<std::shared_ptr<const RayEngine>> rays = build_engine(spheres, built);
  if (!rays) return rays.error();
  Tracer tracer(spheres, built.engine, std::move(*rays));
  tracer.has_images_ = spheres.has_images();
  if (!is_brute(built.engine) || tracer.has_images_) tracer.build_ms_ = timer.elapsed_ms();
  work.report(1);
  return tracer;
}

Result<Tracer> Tracer::build(const Scene& scene, Engine engine, const TreeParameters& parameters, int threads,
                             std::int64_t first) {
  if (scene.spheres.has_images() && bihive::has_clips(scene))
    return Error{"clips cannot cut the copies of a replicated set", "", 0, 0, "leave out the clips or the copies"};
  if (Status status = check_sticks(scene); !status) return status.error();
  if (scene.cavity_walls != nullptr) return of_cavities(scene, EngineParameters(engine, parameters, threads));
  std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  const std::int64_t count = first < 0 ? scene.spheres.size() : first;
  BIHIVE_CHECK(cuts != nullptr || count == scene.spheres.size());
  if (cuts == nullptr) {
    Result<Tracer> tracer = build(scene.spheres, engine, parameters, threads);
    if (!tracer || scene.sticks.empty()) return tracer;
    return with_sticks(std::move(*tracer), scene.sticks, nullptr);
  }
  WatchedWork work(WatchedWork::InnerProgress::passed_on);
  const Timer timer;
  const EngineParameters built(engine, parameters, threads);
  std::vector<std::int64_t> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  Result<std::shared_ptr<const RayEngine>> rays = build_engine(scene.spheres, std::move(all), cuts, built);
  if (!rays) return rays.error();
  Tracer tracer(scene.spheres, built.engine, std::move(*rays));
  tracer.has_clips_ = true;
  if (!is_brute(built.engine)) tracer.build_ms_ = timer.elapsed_ms();
  work.report(1);
  if (scene.sticks.empty()) return tracer;
  return with_sticks(std::move(tracer), scene.sticks, std::move(cuts));
}

Result<Tracer> Tracer::of_cavities(const Scene& scene, const EngineParameters& parameters) {
  if (bihive::has_clips(scene) || !scene.sticks.empty())
    return Error{"pictures of cavities show no cut spheres and no sticks", "", 0, 0, "leave them out"};
  WatchedWork work(WatchedWork::InnerProgress::passed_on);
  const Timer timer;
  Result<std::shared_ptr<const RayEngine>> rays = build_engine(scene.cavity_walls->spheres(), parameters);
  if (!rays) return rays.error();
  Tracer tracer(scene.spheres, parameters.engine, std::make_shared<CavityEngine>(scene.cavity_walls, std::move(*rays)));
  tracer.has_cavities_ = true;
  if (!is_brute(parameters.engine)) tracer.build_ms_ = timer.elapsed_ms();
  work.report(1);
  return tracer;
}

Result<Tracer> Tracer::with_sticks(Tracer tracer, const StickSet& sticks, std::shared_ptr<const CutSet> cuts) {
  const Timer timer;
  try {
    tracer.rays_ = std::make_shared<StickEngine>(*tracer.spheres_, sticks, std::move(tracer.rays_), std::move(cuts),
                                                 is_of_vectors(tracer.engine_));
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for("the tree of " + std::to_string(sticks.size()) + " sticks");
  }
  tracer.has_sticks_ = true;
  tracer.build_ms_ += timer.elapsed_ms();
  return tracer;
}

Tracer::Tracer(const SphereSet& spheres, Engine engine, std::shared_ptr<const RayEngine> rays)
    : spheres_(&spheres),
      engine_(engine),
      rays_(std::move(rays)),
      tree_(rays_->tree()),
      wide_tree_(rays_->wide_tree()) {}

Tracer::Tracer(const SphereSet& spheres, std::shared_ptr<const WideTree> tree)
    : Tracer(spheres, Engine::wide, std::make_shared<WideEngine>(std::move(tree))) {
  BIHIVE_CHECK(wide_tree_ != nullptr);
  BIHIVE_CHECK_EQ(wide_tree_->size, spheres.size());
}

Tracer::Tracer(const SphereSet& spheres, std::shared_ptr<const Tree> tree)
    : Tracer(spheres, Engine::reference, std::make_shared<ReferenceEngine>(spheres, std::move(tree))) {
  BIHIVE_CHECK(tree_ != nullptr);
}

Tracer::Tracer(const SphereSet& seen, std::shared_ptr<RemoteEngine> remote, bool has_clips)
    : Tracer(seen, Engine::wide, std::make_shared<RemoteRays>(remote.get(), WhichSpheres::all)) {
  remote_ = std::move(remote);
  has_clips_ = has_clips;
}

Hit Tracer::closest_hit(const Ray& ray) const {
  return rays_->closest_hit(ray);
}

bool Tracer::occluded(const Ray& ray) const {
  return rays_->occluded(ray);
}

void Tracer::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  rays_->closest_hits(rays, order, hits);
}

void Tracer::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const {
  rays_->occluded(rays, order, is_occluded);
}

void Tracer::all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const {
  rays_->all_hits(rays, order, found);
}

void Tracer::closest_hits(const PixelRays& pixels, const Tile& tile, const HitSpan& hits) const {
  // Trace a band of blocks at a time, and store the hits at the places of their pixels.
  const int width = tile.x1 - tile.x0;
  RayBatch rays;
  HitBatch band;
  std::vector<PixelPlace> places;
  for (int y0 = tile.y0; y0 < tile.y1; y0 += kBlockPx) {
    const int height = std::min(kBlockPx, tile.y1 - y0);
    order_pixels({0, 0, width, height}, places);
    rays.resize(std::int64_t{width} * height);
    band.resize(rays.size());
    const auto count = static_cast<std::size_t>(rays.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Ray ray = pixels.at(tile.x0 + places[i].x + 0.5, y0 + places[i].y + 0.5);
      for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis][i] = ray.origin[axis];
        rays.direction[axis][i] = ray.direction[axis];
      }
    }
    closest_hits(rays.span(), RayOrder::blocks, band.span());
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t pixel = std::int64_t{y0 - tile.y0 + places[i].y} * width + places[i].x;
      hits.t[pixel] = band.t[i];
      hits.sphere_id[pixel] = band.sphere_id[i];
    }
  }
}

}  // namespace bihive
