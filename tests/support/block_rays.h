// Blocks of 64 neighbouring rays that suit beams (cameras, shadows, parallel light), and blocks that do not.
#pragma once

#include <cmath>
#include <cstdint>

#include "bihive/math/rng.h"
#include "bihive/wide/ray_batch.h"
#include "support/edge_rays.h"
#include "support/scenes.h"
#include "support/world.h"

namespace bihive::test {

class BlockRays {
 public:
  BlockRays(const World& world, std::uint64_t seed) : world_(&world), edge_(world, seed), rng_(seed) {
    Vec3d lo{1e300, 1e300, 1e300}, hi = lo * -1;
    for (std::size_t i = 0; i < world.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], centre(i)[axis] - radius(i));
        hi[axis] = std::max(hi[axis], centre(i)[axis] + radius(i));
      }
    middle_ = (lo + hi) * 0.5;
    size_ = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z, 1e-300});
  }

  /// 64 rays from one eye through a grid around some sphere, from much finer than the sphere to coarser.
  void add_camera(RayBatch& rays) {
    const std::size_t target = some_sphere();
    const Vec3d eye = rng_.next_below(6) == 0 ? centre(target) : middle_ + unit() * (size_ * uniform(rng_, 0.3, 3));
    const Vec3d ahead = silhouette_point(target) - eye;
    const Vec3d right = across(ahead), down = across_both(ahead, right);
    const double step = radius(target) * log_uniform(rng_, 1e-4, 1);
    const bool normalise = rng_.next_below(2) == 0;
    for (int i = 0; i < 64; ++i) {
      const Vec3d d = ahead + right * (step * (i % 8 - 3.5)) + down * (step * (i / 8 - 3.5));
      Ray ray;
      ray.origin = to_float(eye);
      ray.direction = to_float(normalise && dot(d, d) > 0 ? normalized(d) : d);
      rays.push_back(ray);
    }
  }

  /// 64 rays from neighbouring points of some spheres to one light. They know the sphere that they leave.
  void add_shadow(RayBatch& rays) {
    const std::size_t target = some_sphere();
    const Vec3d light = middle_ + unit() * (size_ * uniform(rng_, 0.2, 3));
    const Vec3d out = unit();
    const double spread = log_uniform(rng_, 1e-4, 1);
    for (int i = 0; i < 64; ++i) {
      const std::size_t sphere = rng_.next_below(8) == 0 ? some_sphere() : target;
      const Vec3d normal = normalized(out + unit() * spread);
      Ray ray;
      ray.origin = to_float(centre(sphere) + normal * radius(sphere));
      ray.direction = to_float(light - to_double(ray.origin));
      ray.t_max = 1;
      ray.leaves = static_cast<std::int64_t>(sphere);
      rays.push_back(ray);
    }
  }

  /// 64 parallel rays along an axis or anywhere, side by side over some sphere; some are segments that end near it.
  void add_parallel(RayBatch& rays) {
    const std::size_t target = some_sphere();
    Vec3d ahead = unit();
    if (rng_.next_below(2) == 0) {
      ahead = {0, 0, 0};
      ahead[static_cast<int>(rng_.next_below(3))] = rng_.next_below(2) == 0 ? 1 : -1;
    }
    const Vec3d right = across(ahead), down = across_both(ahead, right);
    const double back = size_ * uniform(rng_, 0, 2), step = radius(target) * log_uniform(rng_, 1e-5, 1);
    const bool cut = rng_.next_below(3) == 0;
    const Vec3d through = rng_.next_below(2) == 0 ? centre(target) : silhouette_point(target);
    for (int i = 0; i < 64; ++i) {
      Ray ray;
      ray.origin = to_float(through - ahead * back + right * (step * (i % 8 - 3.5)) + down * (step * (i / 8 - 3.5)));
      ray.direction = to_float(ahead);
      if (cut) ray.t_max = back + radius(target) * uniform(rng_, -1.01, 1.01);
      rays.push_back(ray);
    }
  }

  /// 64 rays of all kinds.
  void add_any(RayBatch& rays) {
    for (int i = 0; i < 64; ++i) rays.push_back(edge_.next());
  }

 private:
  const World* world_;
  EdgeRays edge_;
  SplitMix64 rng_;
  Vec3d middle_;
  double size_ = 1;

  std::size_t some_sphere() { return static_cast<std::size_t>(rng_.next_below(world_->size())); }
  Vec3d centre(std::size_t i) const { return {double(world_->x[i]), double(world_->y[i]), double(world_->z[i])}; }
  double radius(std::size_t i) const { return double(world_->r[i]); }
  Vec3d unit() {
    for (;;) {
      const Vec3d v{uniform(rng_, -1, 1), uniform(rng_, -1, 1), uniform(rng_, -1, 1)};
      if (dot(v, v) <= 1 && dot(v, v) > 1e-4) return normalized(v);
    }
  }
  Vec3d silhouette_point(std::size_t i) { return centre(i) + unit() * radius(i); }
  Vec3d across(Vec3d ahead) {
    Vec3d side;
    do side = cross(dot(ahead, ahead) > 0 ? normalized(ahead) : Vec3d{1, 0, 0}, unit());
    while (!(dot(side, side) > 1e-4));
    return normalized(side);
  }
  static Vec3d across_both(Vec3d ahead, Vec3d right) {
    return cross(dot(ahead, ahead) > 0 ? normalized(ahead) : Vec3d{1, 0, 0}, right);
  }
};

}  // namespace bihive::test
