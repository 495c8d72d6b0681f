// Order by light: for rays that all lead to one point, as shadow rays to a light do, but start on scattered surfaces,
// such as those seen in mirrors and glass. Sorted by direction, 64 neighbours are a narrow beam.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// Are there enough rays, and do all of them lead to one point at t = 1, within rounding? A few rays nearly always
/// decide.
bool converge(const RaySpan& rays);

/// Finds the order; keeps its working memory.
class LightOrder {
 public:
  /// order[k] is the number of the k-th ray; rays that go into a sphere come last. False: the rays are too far apart
  /// for beams, and no order was found.
  bool find(const WideTree& tree, const RaySpan& rays, std::vector<std::uint32_t>& order);

 private:
  std::vector<float> u_, v_;
  std::vector<std::uint32_t> cells_, ends_;
};

}  // namespace bihive::wide
