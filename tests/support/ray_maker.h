// Rays that are hard for a set of spheres.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/geometry/ray.h"
#include "bihive/math/rng.h"
#include "support/scenes.h"
#include "support/world.h"

namespace bihive::test {

/// Half of the rays are aimed within 1.5 radii of a random sphere, and a tenth graze one (0.99 to 1.01 radii). The rest
/// are a tenth each along an axis (two zero components), in a plane of two axes (one zero), starting inside a sphere,
/// and anywhere through the set. A fifth of all are segments; some of them end at the hit, as exactly as binary32 can
/// say. The lengths of directions span twelve orders of magnitude. Ray i depends on the seed and i alone.
class RayMaker {
 public:
  RayMaker(const World& world, std::uint64_t seed) : world_(&world), seed_(seed) {
    for (std::size_t i = 0; i < world.size(); ++i) {
      const double c[3] = {world.x[i], world.y[i], world.z[i]};
      for (int axis = 0; axis < 3; ++axis) {
        lo_[axis] = std::min(lo_[axis], c[axis] - world.r[i]);
        hi_[axis] = std::max(hi_[axis], c[axis] + world.r[i]);
      }
    }
    middle_ = (lo_ + hi_) * 0.5;
    size_ = std::max({hi_.x - lo_.x, hi_.y - lo_.y, hi_.z - lo_.z});
    if (!(size_ > 0)) size_ = 1;
  }

  Ray operator()(std::uint64_t i) const {
    SplitMix64 rng(seed_ ^ (i * 0xD1342543DE82EF95u + 0x632BE59BD9B4E019u));
    rng.next();
    const std::size_t target = static_cast<std::size_t>(rng.next_below(world_->size()));
    const Vec3d centre{double(world_->x[target]), double(world_->y[target]), double(world_->z[target])};
    const double radius = world_->r[target];
    Ray ray;
    switch (i % 10) {
      case 5:
        aim(rng, ray, centre, radius * uniform(rng, 0.99, 1.01));
        break;
      case 6:
        along_axes(rng, ray, centre, radius, 1);
        break;
      case 7:
        along_axes(rng, ray, centre, radius, 2);
        break;
      case 8:
        ray.origin = to_float(centre + unit(rng) * (radius * uniform(rng, 0, 1.05)));
        ray.direction = to_float(unit(rng));
        break;
      case 9:
        aim(rng, ray, somewhere(rng, 0.6), 0);
        break;
      default:
        aim(rng, ray, centre, radius * 1.5 * std::sqrt(rng.next_double()));
    }
    rescale(rng, ray);
    if (rng.next_below(5) == 0) cut(rng, ray, centre, radius);
    return ray;
  }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  const World* world_;
  std::uint64_t seed_;
  Vec3d lo_{kInf, kInf, kInf}, hi_{-kInf, -kInf, -kInf}, middle_;
  double size_ = 0;

  static Vec3d unit(SplitMix64& rng) {
    for (;;) {
      const Vec3d v{uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)};
      if (dot(v, v) <= 1 && dot(v, v) > 1e-4) return normalized(v);
    }
  }

  /// In the box around the middle, `share` times as large as the set.
  Vec3d somewhere(SplitMix64& rng, double share) const {
    const double half = size_ * 0.5 * share;
    return middle_ + Vec3d{uniform(rng, -half, half), uniform(rng, -half, half), uniform(rng, -half, half)};
  }

  /// Mostly outside the set, sometimes in it.
  Vec3d eye(SplitMix64& rng) const {
    if (world_->view_distance > 0) return middle_ + unit(rng) * world_->view_distance;
    if (rng.next_below(8) == 0) return somewhere(rng, 1);
    return middle_ + unit(rng) * (size_ * uniform(rng, 0.9, 3));
  }

  /// From an eye to a point that lies `offset` beside the centre, across the ray.
  void aim(SplitMix64& rng, Ray& ray, Vec3d centre, double offset) const {
    ray.origin = to_float(eye(rng));
    const Vec3d to_centre = centre - to_double(ray.origin);
    const double distance = length(to_centre);
    if (!(distance > offset)) {
      ray.direction = to_float(unit(rng));
      return;
    }
    const Vec3d ahead = to_centre / distance;
    Vec3d beside;
    do beside = cross(ahead, unit(rng));
    while (!(dot(beside, beside) > 1e-4));
    // The foot of the perpendicular is nearer than the centre by offset^2 / distance.
    const double sine = offset / distance, cosine = std::sqrt(1 - sine * sine);
    const Vec3d direction = ahead * cosine + normalized(beside) * sine;
    ray.direction = to_float(direction);
  }

  /// With one or two non-zero components, past the centre within 1.5 radii, or exactly through it or its box's faces.
  void along_axes(SplitMix64& rng, Ray& ray, Vec3d centre, double radius, int components) const {
    const int axis = static_cast<int>(rng.next_below(3)), other = (axis + 1 + static_cast<int>(rng.next_below(2))) % 3;
    Vec3d ahead{0, 0, 0};
    ahead[axis] = rng.next_below(2) == 0 ? 1 : -1;
    if (components == 2) ahead[other] = uniform(rng, -1, 1);
    Vec3d past = centre;
    for (int k = 0; k < 3; ++k) {
      const double choices[4] = {0, uniform(rng, -1.06, 1.06), uniform(rng, -0.7, 0.7),
                                 rng.next_below(2) == 0 ? -1.0 : 1.0};
      if (k != axis) past[k] += radius * choices[rng.next_below(12) == 0 ? 3 : rng.next_below(3)];
    }
    const double back = world_->view_distance > 0 ? world_->view_distance : size_ * uniform(rng, 0.2, 3);
    ray.origin = to_float(past - ahead * back);
    // Keep the other coordinates exactly at their intended values, as far as binary32 allows.
    for (int k = 0; k < 3; ++k)
      if (ahead[k] == 0) ray.origin[k] = static_cast<float>(past[k]);
    ray.direction = to_float(ahead);
  }

  void rescale(SplitMix64& rng, Ray& ray) const {
    const double factor = rng.next_below(2) == 0 ? 1 : log_uniform(rng, 1e-6, 1e6);
    const double world = rng.next_below(2) == 0 ? 1 : size_;
    ray.direction = to_float(to_double(ray.direction) * (factor * world));
  }

  /// Makes a segment of the ray. Its ends are binary32, as a file of rays holds them.
  static void cut(SplitMix64& rng, Ray& ray, Vec3d centre, double radius) {
    const Vec3d d = to_double(ray.direction), oc = centre - to_double(ray.origin);
    const double t_closest = dot(oc, d) / dot(d, d);
    const Vec3d p = oc - d * t_closest;
    const double chord = std::sqrt(std::max(0.0, radius * radius - dot(p, p)) / dot(d, d));
    const double ends[4] = {t_closest - chord, t_closest + chord, t_closest, t_closest * 0.5};
    const float end = static_cast<float>(ends[rng.next_below(4)]);
    const float steps[3] = {end, std::nextafter(end, -HUGE_VALF), std::nextafter(end, HUGE_VALF)};
    const float chosen = steps[rng.next_below(3)];
    switch (rng.next_below(4)) {
      case 0:
        ray.t_min = chosen;
        break;
      case 1:
        ray.t_min = static_cast<float>(t_closest - 2 * std::abs(t_closest));
        ray.t_max = chosen;
        break;
      case 2:
        ray.t_min = std::min(chosen, end);
        ray.t_max = std::max(chosen, end);
        break;
      default:
        ray.t_max = chosen;
    }
    if (!(ray.t_min <= ray.t_max)) std::swap(ray.t_min, ray.t_max);
  }
};

}  // namespace bihive::test
