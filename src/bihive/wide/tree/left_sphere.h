// The spheres that a ray exits: the one that it names, and all that coincide with it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Whether the spheres of two slots are equal.
inline bool coincide(const WideTree& tree, std::int64_t slot, std::int64_t other) {
  const WideSpheres& spheres = tree.spheres;
  return spheres.x[slot] == spheres.x[other] && spheres.y[slot] == spheres.y[other] &&
         spheres.z[slot] == spheres.z[other] && spheres.radius(slot) == spheres.radius(other);
}

/// The bit of an id in a filter of these many bits.
inline std::uint64_t filter_bit(std::int64_t id, std::uint64_t bits) {
  return (std::uint64_t{static_cast<std::uint32_t>(id) * 2654435769U} * bits) >> 32;
}

/// WideTree::repeated_filter: a bit is set where a repeated sphere has it.
inline std::vector<std::uint32_t> filter_of(const std::vector<RepeatedSphere>& repeated) {
  std::vector<std::uint32_t> filter((repeated.size() + 1) / 2);
  for (const RepeatedSphere& sphere : repeated) {
    const std::uint64_t bit = filter_bit(sphere.id, 32 * filter.size());
    filter[bit / 32] |= 1U << (bit % 32);
  }
  return filter;
}

/// The repeated sphere of this id (not negative), or null.
inline const RepeatedSphere* find_repeated(const WideTree& tree, std::int64_t id) {
  if (tree.repeated.empty()) return nullptr;
  const std::uint64_t bit = filter_bit(id, 32 * tree.repeated_filter.size());
  if ((tree.repeated_filter[bit / 32] >> (bit % 32) & 1) == 0) return nullptr;
  const auto found = std::lower_bound(tree.repeated.begin(), tree.repeated.end(), id,
                                      [](const RepeatedSphere& sphere, std::int64_t of) { return sphere.id < of; });
  return found != tree.repeated.end() && found->id == id ? &*found : nullptr;
}

/// Spheres of equal centre and radius share one surface; a ray that starts on it exits all of them
/// (geometry/scaled_ray.h). If a tree has no repeated spheres, comparing ids is enough.
class LeftSphere {
 public:
  LeftSphere(const WideTree& tree, std::int64_t leaves)
      : id_(leaves), repeated_(leaves < 0 ? nullptr : find_repeated(tree, leaves)) {}

  bool is_repeated() const { return repeated_ != nullptr; }
  /// Null if no other sphere coincides with it.
  const RepeatedSphere* repeated() const { return repeated_; }

  bool is(const WideTree& tree, std::int64_t slot) const {
    return tree.spheres.id(slot) == id_ || (repeated_ != nullptr && coincide(tree, slot, repeated_->slot));
  }

 private:
  std::int64_t id_;
  const RepeatedSphere* repeated_;
};

}  // namespace bihive
