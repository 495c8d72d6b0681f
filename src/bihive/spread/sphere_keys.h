// Divides spheres among ranks: each has those between two keys along a Morton curve, so that a rank's spheres are
// neighbours.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// The position of a centre along the curve through 2^63 cells of [-1, 1]^3, then the centre itself. Equal centres have
/// equal keys, and no others do. So spheres that coincide, which share one surface (geometry/scaled_ray.h), always lie
/// on one rank.
struct SphereKey {
  std::uint64_t cell = 0;
  std::uint32_t x = 0, y = 0, z = 0;

  friend bool operator<(const SphereKey& a, const SphereKey& b) {
    return std::tie(a.cell, a.x, a.y, a.z) < std::tie(b.cell, b.x, b.y, b.z);
  }
};

/// Stored units.
SphereKey key_of(float x, float y, float z);
SphereKey key_of(const SphereSet& spheres, std::int64_t id);

/// The first keys of ranks: rank k has the keys from starts[k - 1] on, and before starts[k]. `samples`: of all spheres,
/// in any order; the ranks get about as many of them each. One key fewer than ranks. With fewer keys than ranks, some
/// ranks get nothing.
std::vector<SphereKey> starts_of_ranks(std::vector<SphereKey> samples, int ranks);
int rank_of(const SphereKey& key, const std::vector<SphereKey>& starts);

}  // namespace bihive
