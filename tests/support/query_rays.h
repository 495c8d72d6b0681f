// Rays that are hard for the queries for many rays: those of edge_rays.h, and numbers at the ends of their ranges.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/math/rng.h"
#include "support/edge_rays.h"
#include "support/world.h"

namespace bihive::test {

/// One ray at a time, for a set with spheres. `closest` (any callable Hit(Ray)) tells the hit at which a segment is to
/// end.
template <class Closest>
class QueryRays {
 public:
  QueryRays(const World& world, std::uint64_t seed, Closest closest)
      : world_(&world), edge_rays_(world, seed), rng_(seed ^ 0x5DEECE66Du), closest_(closest) {
    for (std::size_t i = 0; i < world.size(); ++i)
      for (const float c : {world.x[i], world.y[i], world.z[i]})
        extent_ = std::max(extent_, double(std::abs(c)) + double(world.r[i]));
    if (!(extent_ > 0)) extent_ = 1;
  }

  Ray next() {
    Ray ray = edge_rays_.next();
    switch (rng_.next_below(16)) {
      case 0:  // Components of 0, of either sign.
        for (int axis = 0; axis < 3; ++axis)
          if (rng_.next_below(2) == 0) ray.direction[axis] = rng_.next_below(2) == 0 ? 0.0f : -0.0f;
        break;
      case 1:  // Components that are nearly 0, or have no normal exponent.
        ray.direction[axis()] = static_cast<float>(signed_one() * std::ldexp(1, -static_cast<int>(below(150))));
        break;
      case 2:
        end_at_hit(ray);
        break;
      case 3:
        strange_segment(ray);
        break;
      case 4:
        strange_surface(ray);
        break;
      case 5:
        if (rng_.next_below(4) == 0) spoil(ray);
        break;
      case 6: {  // Directions as long and as short as they can be.
        const int exponent =
            rng_.next_below(2) == 0 ? 100 + static_cast<int>(below(28)) : -149 + static_cast<int>(below(60));
        const float largest =
            std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
        for (int k = 0; k < 3; ++k)
          ray.direction[k] = static_cast<float>(std::ldexp(double(ray.direction[k]) / double(largest), exponent));
        break;
      }
      case 7:
        from_afar(ray);
        break;
      case 8: {  // In the tangent plane of a sphere, where its neighbour may touch it.
        const std::size_t target = sphere();
        const int across = axis();
        ray.origin = centre(target);
        ray.origin[across] += rng_.next_below(2) == 0 ? world_->r[target] : -world_->r[target];
        ray.direction = {signed_one(), signed_one(), signed_one()};
        ray.direction[across] = rng_.next_below(2) == 0 ? 0.0f : -0.0f;
        if (rng_.next_below(2) == 0) ray.direction[(across + 1) % 3] = 0;
        for (int k = 0; k < 3; ++k) ray.origin[k] -= ray.direction[k] * static_cast<float>(extent_);
        break;
      }
      case 9:  // From a centre, or a surface along an axis.
        ray.origin = centre(sphere());
        if (rng_.next_below(2) == 0) {
          const std::size_t target = sphere();
          ray.origin = centre(target);
          ray.origin[axis()] += signed_one() * world_->r[target];
          ray.leaves = static_cast<std::int64_t>(target);
          ray.inside = rng_.next_below(2) == 0;
        }
        break;
      default:
        break;
    }
    return ray;
  }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  const World* world_;
  EdgeRays edge_rays_;
  SplitMix64 rng_;
  Closest closest_;
  double extent_ = 0;

  std::uint64_t below(std::uint64_t n) { return rng_.next_below(n); }
  int axis() { return static_cast<int>(below(3)); }
  std::size_t sphere() { return static_cast<std::size_t>(below(world_->size())); }
  float signed_one() { return below(2) == 0 ? 1.0f : -1.0f; }
  Vec3f centre(std::size_t i) const { return {world_->x[i], world_->y[i], world_->z[i]}; }

  // A segment with one or both ends at the hit, or next to it.
  void end_at_hit(Ray& ray) {
    const Hit hit = closest_(ray);
    if (!hit.found()) return;
    const double ends[] = {hit.t, std::nextafter(hit.t, -kInf), std::nextafter(hit.t, kInf)};
    switch (below(4)) {
      case 0:
        ray.t_min = ends[below(3)];
        break;
      case 1:
        ray.t_max = ends[below(3)];
        break;
      case 2:
        ray.t_min = ray.t_max = ends[below(3)];
        break;
      default:
        ray.t_min = ends[1];
        ray.t_max = ends[2];
    }
  }

  void strange_segment(Ray& ray) {
    constexpr double kEnds[] = {-kInf, -1e300, -1e30, -1, -1e-300, -0.0, 0.0, 1e-300, 1e-9, 0.25, 1, 1e30, 1e300, kInf};
    constexpr std::size_t kCount = sizeof(kEnds) / sizeof(kEnds[0]);
    ray.t_min = kEnds[below(kCount)];
    ray.t_max = kEnds[below(kCount)];
    if (below(8) == 0) ray.t_min = std::numeric_limits<double>::quiet_NaN();
    if (below(8) == 0) ray.t_max = std::numeric_limits<double>::quiet_NaN();
    // One in four keeps t_min > t_max.
    if (below(2) == 0 && ray.t_min > ray.t_max) std::swap(ray.t_min, ray.t_max);
  }

  // The ray leaves a sphere on which it does not start, or a sphere that does not exist.
  void strange_surface(Ray& ray) {
    const auto size = static_cast<std::int64_t>(world_->size());
    const auto some = static_cast<std::int64_t>(below(static_cast<std::uint64_t>(size)));
    const std::int64_t surfaces[] = {some,
                                     size,
                                     size + 5,
                                     some + (std::int64_t{1} << 27),
                                     some + (std::int64_t{1} << 32),
                                     some - (std::int64_t{1} << 32),
                                     kPlane,
                                     -3,
                                     std::numeric_limits<std::int64_t>::max(),
                                     std::numeric_limits<std::int64_t>::min()};
    ray.leaves = surfaces[below(sizeof(surfaces) / sizeof(surfaces[0]))];
    ray.inside = below(2) == 0;
    if (below(2) != 0) return;
    // The sphere that the ray would have hit.
    const Hit hit = closest_(ray);
    if (hit.found()) ray.leaves = hit.sphere_id;
  }

  // Makes the ray invalid.
  void spoil(Ray& ray) {
    const float inf = std::numeric_limits<float>::infinity();
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), inf, -inf};
    switch (below(3)) {
      case 0:
        ray.origin[axis()] = bad[below(3)];
        break;
      case 1:
        ray.direction[axis()] = bad[below(3)];
        break;
      default:
        ray.direction = {0.0f, -0.0f, 0.0f};
    }
  }

  // From up to 1e30 times the extent away, aimed beside a sphere by up to 2 radii. More often from the distances at
  // which the library changes its method (a few extents and 2^20 extents).
  void from_afar(Ray& ray) {
    const std::size_t target = sphere();
    const double exponents[] = {uniform(rng_, 0, 30), uniform(rng_, 0.8, 1.1), uniform(rng_, 5.9, 6.2)};
    const double away = std::min(extent_ * std::pow(10, exponents[below(3)]), 3e38);
    Vec3d ahead{uniform(rng_, -1, 1), uniform(rng_, -1, 1), uniform(rng_, -1, 1)};
    if (below(4) == 0) ahead = Vec3d{0, 0, 0};
    if (below(4) == 0 || dot(ahead, ahead) == 0) ahead[axis()] = signed_one();
    const double radius = world_->r[target];
    Vec3d at = to_double(centre(target));
    for (int k = 0; k < 3; ++k) at[k] += radius * uniform(rng_, -1.2, 1.2);
    const double length_of = std::max({std::abs(ahead.x), std::abs(ahead.y), std::abs(ahead.z)});
    ahead = ahead / length_of;
    for (int k = 0; k < 3; ++k) {
      const double place = at[k] - ahead[k] * away;
      ray.origin[k] = static_cast<float>(std::min(std::max(place, -3.4e38), 3.4e38));
    }
    ray.direction = to_float(below(2) == 0 ? ahead : ahead * std::min(away, 1e38));
  }
};

/// Blocks of 64 rays that keep the promise of RayOrder::blocks more or less: 8 x 8 pixels of a camera close or far,
/// their rays towards a point, parallel rays. In some blocks one or two rays are different.
template <class Closest>
std::vector<Ray> blocks_of_rays(const World& world, std::uint64_t seed, std::int64_t blocks, Closest closest) {
  SplitMix64 rng(seed);
  QueryRays<Closest> strangers(world, seed, closest);
  std::vector<Ray> rays;
  const auto some_centre = [&] {
    const std::size_t i = static_cast<std::size_t>(rng.next_below(world.size()));
    return Vec3d{double(world.x[i]), double(world.y[i]), double(world.z[i])};
  };
  double extent = 0;
  for (std::size_t i = 0; i < world.size(); ++i)
    for (const float c : {world.x[i], world.y[i], world.z[i]})
      extent = std::max(extent, double(std::abs(c)) + double(world.r[i]));
  if (!(extent > 0)) extent = 1;
  const auto unit = [&] {
    return normalized(Vec3d{uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1.001)});
  };
  for (std::int64_t block = 0; block < blocks; ++block) {
    const Vec3d target = some_centre();
    const std::size_t big = static_cast<std::size_t>(rng.next_below(world.size()));
    const double distance = extent * log_uniform(rng, 0.01, 30);
    Vec3d ahead = unit();
    if (rng.next_below(4) == 0) ahead = Vec3d{0, 0, 0}, ahead[static_cast<int>(rng.next_below(3))] = 1;
    const Vec3d eye = target - ahead * distance;
    Vec3d right = cross(ahead, unit());
    right = dot(right, right) > 1e-6 ? normalized(right) : Vec3d{ahead.y, ahead.z, ahead.x};
    const Vec3d up = cross(right, ahead);
    // The distance of neighbours at the target: from far below a radius to the whole set.
    const double step = (rng.next_below(2) == 0 ? double(world.r[big]) : extent) * log_uniform(rng, 1e-4, 1);
    const std::uint64_t kind = rng.next_below(6);
    const Vec3d light = target + unit() * (extent * log_uniform(rng, 0.1, 100));
    const std::size_t start = rays.size();
    for (int k = 0; k < 64; ++k) {
      const Vec3d place = target + right * ((k % 8 - 3.37) * step) + up * ((k / 8 - 3.61) * step);
      Ray ray;
      ray.origin = to_float(eye);
      ray.direction = to_float(kind == 5 ? (place - eye) * log_uniform(rng, 1e-3, 1e3) : place - eye);
      if (kind == 1) {  // parallel
        ray.origin = to_float(place - ahead * distance);
        ray.direction = to_float(ahead);
      }
      if (kind == 2 || kind == 3) {  // from the hits of a camera's rays towards a light
        const Hit hit = closest(ray);
        ray.leaves = hit.sphere_id;
        const Vec3d from = hit.found() ? to_double(ray.origin) + to_double(ray.direction) * hit.t : place;
        ray.origin = to_float(from);
        ray.direction = to_float(light - from);
        ray.t_max = 1;
        ray.inside = hit.found() && kind == 3 && rng.next_below(2) == 0;
      }
      if (kind == 4 && k != 0) ray = rays[start];  // the same ray again
      rays.push_back(ray);
    }
    for (std::uint64_t k = rng.next_below(4) == 0 ? rng.next_below(3) : 0; k > 0; --k)
      rays[start + static_cast<std::size_t>(rng.next_below(64))] = strangers.next();
  }
  return rays;
}

}  // namespace bihive::test
