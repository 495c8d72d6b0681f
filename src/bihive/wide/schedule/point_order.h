// Orders scattered points by cell, so that neighbours visit the same nodes one after the other.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/point_queries.h"

namespace bihive::wide {

/// order[k] is the number, in `points`, of the k-th point: in the order of cells where that pays, else unchanged. At
/// most 2^32 - 1 points.
class PointOrder {
 public:
  void find(const WideTree& tree, const PointSpan& points, std::vector<std::uint32_t>& order);

 private:
  std::vector<std::uint32_t> cells_, ends_;
};

}  // namespace bihive::wide
