// The rays of every kind.
#pragma once

#include <cstdint>
#include <vector>

#include "bench_scene.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"
#include "kinds.h"

namespace bihive::bench {

struct RaySet {
  KindFacts facts;
  RayBatch rays;
  /// For peers that trace packets of 4, 8 or 16: the same rays in an order in which a packet's pixels form a square or
  /// half of one.
  std::vector<std::uint32_t> packet_order;
};

/// Primary rays come in 8 x 8 pixel blocks, row by row inside a block, blocks along a Z-curve; every other kind but
/// random keeps the order of the pixels. A kind without a ray (nothing was hit) is an empty set.
std::vector<RaySet> make_ray_sets(const BenchScene& bench, const WideTree& tree, const BenchOptions& options);

}  // namespace bihive::bench
