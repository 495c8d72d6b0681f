#include "bihive/render/tracer.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/memory.h"
#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/query/brute_force.h"
#include "bihive/render/query/image_tracer.h"
#include "bihive/render/query/part_tracer.h"
#include "bihive/render/query/pixel_order.h"
#include "bihive/render/query/wide_brute_force.h"
#include "bihive/render/remote_engine.h"
#include "bihive/render/tree_memory.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

RayBatch one_ray(const Ray& ray) {
  RayBatch batch;
  batch.push_back(ray);
  return batch;
}

}  // namespace

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
  Tracer tracer(spheres, engine == Engine::automatic ? Engine::wide : engine);
  const Timer timer;
  if (spheres.has_images()) {
    Result<std::shared_ptr<const ImageTracer>> images =
        ImageTracer::build(spheres, tracer.engine_, parameters, threads);
    if (!images) return images.error();
    tracer.images_ = std::move(*images);
    tracer.wide_tree_ = tracer.images_->wide_tree();
    if (tracer.engine_ == Engine::reference) tracer.tree_ = tracer.images_->tree();
    tracer.build_ms_ = timer.elapsed_ms();
    return tracer;
  }
  if (tracer.engine_ == Engine::wide) {
    Result<std::shared_ptr<const WideTree>> tree =
        WideBuilder().build(spheres, parameters.for_wide(spheres.size()), threads);
    if (!tree) return tree.error();
    tracer.wide_tree_ = std::move(*tree);
  }
  if (tracer.engine_ == Engine::reference) {
    if (Status status = check_tree_memory(spheres, tracer.engine_, parameters); !status) return status.error();
    try {
      tracer.tree_ = std::make_shared<const Tree>(build_reference_tree(spheres, parameters.for_reference()));
    } catch (const std::bad_alloc&) {
      return no_memory_for("the reference tree of " + std::to_string(spheres.size()) + " spheres");
    }
  }
  if (!is_brute(tracer.engine_)) tracer.build_ms_ = timer.elapsed_ms();
  return tracer;
}

Result<Tracer> Tracer::build(const Scene& scene, Engine engine, const TreeParameters& parameters, int threads,
                             std::int64_t first) {
  if (scene.spheres.has_images() && bihive::has_clips(scene))
    return Error{"clips cannot cut the copies of a replicated set", "", 0, 0, "leave out the clips or the copies"};
  std::shared_ptr<const CutSet> cuts = cut_set_of(scene);
  const std::int64_t count = first < 0 ? scene.spheres.size() : first;
  BIHIVE_CHECK(cuts != nullptr || count == scene.spheres.size());
  if (cuts == nullptr) return build(scene.spheres, engine, parameters, threads);
  Tracer tracer(scene.spheres, engine == Engine::automatic ? Engine::wide : engine);
  const Timer timer;
  std::vector<std::int64_t> all;
  for (std::int64_t id = 0; id < count; ++id) all.push_back(id);
  auto parts = std::make_shared<PartTracer>();
  const PartTracer::Parameters of_parts{tracer.engine_, parameters, threads, false};
  if (Status status = parts->make(scene.spheres, std::move(cuts), all, of_parts); !status) return status.error();
  tracer.parts_ = std::move(parts);
  if (!is_brute(tracer.engine_)) tracer.build_ms_ = timer.elapsed_ms();
  return tracer;
}

Tracer::Tracer(const SphereSet& spheres, std::shared_ptr<const WideTree> tree) : Tracer(spheres, Engine::wide) {
  BIHIVE_CHECK(tree != nullptr);
  BIHIVE_CHECK_EQ(tree->size, spheres.size());
  wide_tree_ = std::move(tree);
}

Tracer::Tracer(const SphereSet& spheres, std::shared_ptr<const Tree> tree) : Tracer(spheres, Engine::reference) {
  BIHIVE_CHECK(tree != nullptr);
  tree_ = std::move(tree);
}

Tracer::Tracer(const SphereSet& seen, std::shared_ptr<RemoteEngine> remote, bool has_clips)
    : Tracer(seen, Engine::wide) {
  BIHIVE_CHECK(remote != nullptr);
  remote_ = std::move(remote);
  has_remote_clips_ = has_clips;
}

Hit Tracer::closest_hit(const Ray& ray) const {
  if (remote_) {
    Hit hit;
    remote_->closest_hits(WhichSpheres::all, one_ray(ray).span(), RayOrder::any, {&hit.t, &hit.sphere_id});
    return hit;
  }
  if (images_) return images_->closest_hit(ray);
  if (parts_) return parts_->closest_hit(ray);
  if (wide_tree_) return bihive::closest_hit(*wide_tree_, ray);
  return tree_ ? bihive::closest_hit(*tree_, *spheres_, ray) : bihive::closest_hit(*spheres_, ray);
}

bool Tracer::occluded(const Ray& ray) const {
  if (remote_) {
    std::uint8_t hidden = 0;
    remote_->occluded(WhichSpheres::all, one_ray(ray).span(), RayOrder::any, &hidden);
    return hidden != 0;
  }
  if (images_) return images_->occluded(ray);
  if (parts_) return parts_->occluded(ray);
  if (wide_tree_) return bihive::occluded(*wide_tree_, ray);
  return tree_ ? bihive::occluded(*tree_, *spheres_, ray) : bihive::occluded(*spheres_, ray);
}

void Tracer::closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const {
  if (remote_) return remote_->closest_hits(WhichSpheres::all, rays, order, hits);
  if (images_) return images_->closest_hits(rays, order, hits);
  if (parts_) return parts_->closest_hits(rays, order, hits);
  if (wide_tree_) return bihive::closest_hits(*wide_tree_, rays, order, hits);
  if (engine_ == Engine::wide_brute) return wide_brute_hits(*spheres_, rays, hits);
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Hit hit = closest_hit(rays.at(i));
    hits.t[i] = hit.t;
    hits.sphere_id[i] = hit.sphere_id;
  }
}

void Tracer::occluded(const RaySpan& rays, RayOrder order, std::uint8_t* hidden) const {
  if (remote_) return remote_->occluded(WhichSpheres::all, rays, order, hidden);
  if (images_) return images_->occluded(rays, order, hidden);
  if (parts_) return parts_->occluded(rays, order, hidden);
  if (wide_tree_) return bihive::occluded(*wide_tree_, rays, order, hidden);
  if (engine_ == Engine::wide_brute) return wide_brute_occluded(*spheres_, rays, hidden);
  for (std::int64_t i = 0; i < rays.count; ++i) hidden[i] = occluded(rays.at(i)) ? 1 : 0;
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
