// The ranks that a ray may meet, the nearest first.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// A box around spheres, in stored units; empty at first.
struct RankBox {
  Vec3d lo{1, 1, 1}, hi{-1, -1, -1};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void add(const RankBox& other);
};

/// The box of a set's spheres, those of radius 0 left out.
RankBox box_of(const SphereSet& spheres);

/// A rank that a ray may meet.
struct RankOnWay {
  double t;  ///< no hit on a sphere of the rank is nearer
  std::int32_t rank;
};

/// The boxes of all ranks, and a tree over them: ranks with neighbouring numbers are neighbours in space
/// (spread/sphere_keys.h).
class RankBoxes {
 public:
  /// `scale`: stored units from world units.
  RankBoxes(std::vector<RankBox> boxes, double scale);

  /// Appends the ranks whose spheres the ray may meet, by t. They never leave out a rank whose tree would find a hit.
  /// The ray must be valid.
  void find(const Ray& ray, std::vector<RankOnWay>& found) const;

  int ranks() const { return static_cast<int>(boxes_.size()); }
  const RankBox& box(int rank) const { return boxes_[static_cast<std::size_t>(rank)]; }

 private:
  struct Node {
    RankBox box;
    std::int32_t first, last;    // ranks
    std::int32_t lower, higher;  // nodes; -1: a single rank
  };
  std::int32_t make(std::int32_t first, std::int32_t last);

  std::vector<RankBox> boxes_;
  double scale_;
  std::vector<Node> nodes_;
};

}  // namespace bihive
