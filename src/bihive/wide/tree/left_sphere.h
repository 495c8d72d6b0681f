// The spheres that a ray exits: the one that it names, and all that coincide with it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Spheres of equal centre and radius share one surface; a ray that starts on it exits all of them
/// (geometry/scaled_ray.h). If a tree has no repeated spheres, comparing ids is enough.
class LeftSphere {
 public:
  LeftSphere(const WideTree& tree, std::int64_t leaves) : id_(leaves) {
    if (tree.repeated.empty() || leaves < 0) return;
    const auto found = std::lower_bound(tree.repeated.begin(), tree.repeated.end(), leaves,
                                        [](const RepeatedSphere& sphere, std::int64_t id) { return sphere.id < id; });
    if (found != tree.repeated.end() && found->id == leaves) repeated_ = &*found;
  }

  bool is_repeated() const { return repeated_ != nullptr; }

  bool is(const WideTree& tree, std::int64_t slot) const {
    if (tree.spheres.id(slot) == id_) return true;
    return repeated_ != nullptr && tree.spheres.x[slot] == repeated_->x && tree.spheres.y[slot] == repeated_->y &&
           tree.spheres.z[slot] == repeated_->z && tree.spheres.radius(slot) == double(repeated_->r);
  }

 private:
  std::int64_t id_;
  const RepeatedSphere* repeated_ = nullptr;
};

}  // namespace bihive
