// All spheres of a set one after the other, with its images.
#pragma once

#include <cstdint>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Calls use(id, centre, radius) in the order of ids; world units. Faster than SphereSet::centre() for each id.
template <class Use>
void for_each_sphere(const SphereSet& spheres, const Use& use) {
  for (std::int64_t id = 0; id < spheres.size(); ++id) use(id, spheres.centre(id), spheres.radius(id));
  for (std::int64_t copy = 1; copy < spheres.images().count(); ++copy) {
    const Vec3d shift = spheres.scale() * spheres.images().shift(copy);
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const Vec3f stored = to_float(spheres.stored_centre(id) + shift);
      use(copy * spheres.size() + id, spheres.in_world(spheres.inverse_scale() * to_double(stored)),
          spheres.radius(id));
    }
  }
}

}  // namespace bihive
