// Rays that lie exactly on the edges of decisions: box faces, tangent points, surfaces, far-away origins.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/rng.h"
#include "support/ray_maker.h"
#include "support/world.h"

namespace bihive::test {

/// Text for a failing test that tells the ray bit for bit.
inline std::string text_of(const Ray& ray) {
  char line[400];
  std::snprintf(line, sizeof line, "ray {{%a, %a, %a}, {%a, %a, %a}, %a, %a, %lld, %d}", double(ray.origin.x),
                double(ray.origin.y), double(ray.origin.z), double(ray.direction.x), double(ray.direction.y),
                double(ray.direction.z), ray.t_min, ray.t_max, static_cast<long long>(ray.leaves), int(ray.inside));
  return line;
}

class EdgeRays {
 public:
  EdgeRays(const World& world, std::uint64_t seed) : world_(&world), usual_(world, seed), rng_(seed) {}

  Ray next() {
    const std::uint64_t kind = rng_.next_below(8);
    Ray ray = usual_(number_++);
    const std::size_t target = static_cast<std::size_t>(rng_.next_below(world_->size()));
    const Vec3d centre{double(world_->x[target]), double(world_->y[target]), double(world_->z[target])};
    const double radius = world_->r[target];
    switch (kind) {
      case 0:  // In the plane of a face of a box, or along its edge.
      case 1: {
        ray.direction = {signed_unit(), signed_unit(), signed_unit()};
        for (int axis = 0; axis < 3; ++axis) {
          const double face = centre[axis] + radius * double(static_cast<int>(rng_.next_below(3)) - 1);
          ray.origin[axis] = static_cast<float>(face);
          if (rng_.next_below(3) == 0) ray.direction[axis] = 0;
        }
        if (ray.direction == Vec3f{0, 0, 0}) ray.direction[0] = 1;
        // Step back along the ray, exactly in the axes where it does not move.
        const float back = static_cast<float>(radius * double(rng_.next_below(4)));
        for (int axis = 0; axis < 3; ++axis)
          if (ray.direction[axis] != 0) ray.origin[axis] -= back * ray.direction[axis];
        break;
      }
      case 2: {  // Through the point where the sphere touches its box (and its neighbour, where spheres touch).
        Vec3d touch = centre;
        touch[static_cast<int>(rng_.next_below(3))] += rng_.next_below(2) == 0 ? radius : -radius;
        ray.direction = to_float(touch - to_double(ray.origin));
        break;
      }
      case 3:  // From the surface, outward or inward, with the sphere that it leaves.
      case 4: {
        const Vec3d along = to_double(ray.direction);
        const Vec3d out{double(signed_unit()), double(signed_unit()), double(signed_unit())};
        ray.origin = to_float(centre + out * (radius / length(out)));
        ray.leaves = static_cast<std::int64_t>(target);
        ray.inside = dot(along, out) < 0;
        if (rng_.next_below(8) == 0) ray.inside = !ray.inside;
        break;
      }
      case 5: {  // From very far: binary64 itself is coarse there, and so must the tree be.
        const double far = std::ldexp(1, static_cast<int>(rng_.next_below(60)));
        ray.origin = to_float(to_double(ray.origin) * std::min(far, 1e37 / (1 + largest(ray.origin))));
        ray.direction = to_float((centre - to_double(ray.origin)) * 0.5);
        break;
      }
      default:
        break;
    }
    if (rng_.next_below(8) == 0 && ray.leaves == kNothing) ray.leaves = static_cast<std::int64_t>(target);
    return ray;
  }

 private:
  const World* world_;
  RayMaker usual_;
  SplitMix64 rng_;
  std::uint64_t number_ = 0;

  float signed_unit() {
    const float size = 1.0f / static_cast<float>(1 + rng_.next_below(3));
    return rng_.next_below(2) == 0 ? size : -size;
  }
  static double largest(Vec3f v) { return double(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})); }
};

}  // namespace bihive::test
