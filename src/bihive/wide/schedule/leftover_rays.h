// Rays of blocks that are not for a beam: answered in one go as lists. Shadow rays that lead to one light are sorted
// first, so that they may be beams after all; pixels side by side are never scattered.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// The mean of the largest extents of some leaves' boxes, stored units: the width at which a beam becomes wide.
float leaf_extent(const WideTree& tree);

class LeftoverRays {
 public:
  explicit LeftoverRays(const RaySpan& rays) : rays_(rays) {}

  /// Rays first to first + count - 1, which were not added before.
  void add(std::int64_t first, std::int64_t count) {
    count_ += count;
    if (!runs_.empty() && runs_.back().first + runs_.back().count == first) {
      runs_.back().count += count;
    } else {
      runs_.push_back({first, count});
    }
  }

  std::int64_t count() const { return count_; }

  void closest_hits(const WideTree& tree, const HitSpan& hits) const;
  /// sorted: the rays are in the best order already.
  void occluded(const WideTree& tree, bool sorted, std::uint8_t* hidden) const;

 private:
  struct Run {
    std::int64_t first, count;
  };
  template <class Tile, class Direct, class Copied>
  void in_tiles(Tile& tile, const Direct& direct, const Copied& copied) const;

  RaySpan rays_;
  std::vector<Run> runs_;
  std::int64_t count_ = 0;
};

}  // namespace bihive
