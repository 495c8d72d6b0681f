// Spheres in world units as a user gives them, in binary32, without the library's own storage.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive::test {

struct World {
  std::string name;
  std::vector<float> x, y, z, r;
  double view_distance = 0;  ///< distance of rays' starts from the middle; 0: around the set and in it

  std::size_t size() const { return x.size(); }
  void add(double cx, double cy, double cz, double radius) {
    x.push_back(static_cast<float>(cx));
    y.push_back(static_cast<float>(cy));
    z.push_back(static_cast<float>(cz));
    r.push_back(static_cast<float>(radius));
  }
  /// Every coordinate and radius times `factor`, rounded to binary32.
  World scaled(double factor, const std::string& new_name) const {
    World world;
    world.name = new_name;
    for (std::size_t i = 0; i < size(); ++i) world.add(x[i] * factor, y[i] * factor, z[i] * factor, r[i] * factor);
    return world;
  }
};

/// The library's own set of the same spheres; ends the test program if the library refuses them.
inline SphereSet sphere_set(const World& world) {
  Result<SphereSet> set = SphereSet::from_world(world.x, world.y, world.z, world.r);
  BIHIVE_CHECK(set.ok());
  return std::move(*set);
}

/// The inverse: exact, because the scale is a power of two (if nothing underflows).
inline World world_of(const SphereSet& set, const std::string& name) {
  World world;
  world.name = name;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const Vec3d c = set.centre(id);
    world.add(c.x, c.y, c.z, set.radius(id));
  }
  return world;
}

}  // namespace bihive::test
