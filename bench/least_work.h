// The least work of an exact engine that tests each ray by itself against the tree, sixteen boxes or spheres at a time:
// a bound for the rates of bihive-bench. Beams share tests among rays, so they may exceed it.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"
#include "ray_sets.h"

namespace bihive::bench {

/// Means per ray over a sample of a ray set.
struct LeastWork {
  /// An oracle gives the answer: sixteen boxes or sixteen spheres are tested only where the ray must go to prove it.
  /// For an occluded ray that is one path to one leaf.
  double nodes = 0, leaves = 0;
  /// Without the oracle, ray by ray, children near to far; the nearest hit so far ends the search.
  double nodes_in_order = 0, leaves_in_order = 0;
  double candidates = 0;  ///< spheres that the first test of those leaves leaves to the second
  double decisions = 0;   ///< in binary64: the winner of a closest hit
  double bytes = 0;       ///< of distinct nodes and spheres in all the sample's leaves and nodes, of rays and answers

  /// Cycles of two vector ports that do nothing but the arithmetic above; `lanes` of binary32 in a vector.
  double cycles(int lanes) const;
};

/// Beams take primary rays whole.
constexpr bool has_bound(Kind kind) {
  return kind != Kind::primary;
}

LeastWork least_work(const WideTree& tree, const RaySet& set);

/// Cycles per second of a core at work now, by a chain of products that take three each.
double clock_rate();

}  // namespace bihive::bench
