// Periodic cells of every kind, and all images of spheres as a loop that anybody can check.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/math/rng.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/wide_builder.h"

namespace bihive::test {

/// Orthogonal, skewed, left-handed, periodic along two vectors and along one, and a slab.
inline const std::vector<Cell>& periodic_cells() {
  static const std::vector<Cell> cells{{{}, {Vec3d{4, 0, 0}, Vec3d{0, 3, 0}, Vec3d{0, 0, 5}}},
                                       {{}, {Vec3d{4, 0, 0}, Vec3d{1.9, 3, 0}, Vec3d{-1.5, 1.2, 5}}},
                                       {{}, {Vec3d{-2, 1, 0.5}, Vec3d{1.9, 3, 0}, Vec3d{0.25, 1.2, -2}}},
                                       {{}, {Vec3d{4, 0, 0}, Vec3d{}, Vec3d{1, 0, 3}}},
                                       {{}, {Vec3d{}, Vec3d{0, 2, 0.5}, Vec3d{}}},
                                       {{}, {Vec3d{4, 0, 0}, Vec3d{0, 3, 0}, Vec3d{0, 0, 5}}, {true, true, false}}};
  return cells;
}

/// Spheres in a cell, their tree and their images.
struct PeriodicSet {
  SphereSet spheres;
  std::shared_ptr<const WideTree> tree;
  std::optional<PeriodicImages> images;

  PeriodicSet(const std::vector<Vec3d>& centres, const std::vector<double>& radii, const Cell& cell) {
    std::vector<double> x, y, z;
    for (const Vec3d& p : centres) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    spheres = SphereSet::from_world(x, y, z, radii).value();
    spheres.cell() = cell;
    WideBuilder builder;
    tree = builder.build(spheres).value();
    images = PeriodicImages::of(spheres).value();
  }
};

/// A random point of the cell at the origin.
inline Vec3d point_in(const Cell& cell, SplitMix64& random) {
  return random.next_double() * cell.vectors[0] + random.next_double() * cell.vectors[1] +
         random.next_double() * cell.vectors[2];
}

/// Calls visit(shift) for the translations of images from -reach to reach along each periodic vector of the set's cell,
/// in stored units.
template <class Visit>
void for_each_shift(const SphereSet& spheres, int reach, const Visit& visit) {
  std::array<Vec3d, 3> vectors = spheres.cell()->vectors;
  std::array<int, 3> most{};
  for (std::size_t k = 0; k < 3; ++k) {
    most[k] = spheres.cell()->periodic[k] && vectors[k] != Vec3d{} ? reach : 0;
    vectors[k] = vectors[k] * spheres.scale();
  }
  for (int i = -most[0]; i <= most[0]; ++i)
    for (int j = -most[1]; j <= most[1]; ++j)
      for (int k = -most[2]; k <= most[2]; ++k)
        visit(double(i) * vectors[0] + double(j) * vectors[1] + double(k) * vectors[2]);
}

}  // namespace bihive::test
