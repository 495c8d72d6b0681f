#include <algorithm>
#include <cstdint>

#include "bihive/kernels/wide_builder.h"

namespace bihive {

WideMemoryPrediction predict_wide_memory(std::int64_t spheres, const WideParameters& parameters) {
  if (spheres <= 0) return {sizeof(WideTree), sizeof(WideTree), sizeof(WideTree)};
  const std::int64_t full_leaf = std::clamp<std::int64_t>(parameters.max_depth == 1  ? spheres
                                                          : parameters.max_prims > 0 ? parameters.max_prims
                                                                                     : kWidth,
                                                          1, spheres);
  // A node for sixteen full leaves at least; on scattered sets leaves are two thirds full, and nodes half.
  const std::int64_t leaves = (spheres + full_leaf - 1) / full_leaf;
  const std::int64_t low_nodes = leaves / kWidth + 1, high_nodes = leaves * 3 / kWidth + 2;
  WideMemoryPrediction prediction;
  prediction.low_bytes = std::int64_t{sizeof(WideTree)} + 16 * (spheres + kWidth) + low_nodes * 512;
  prediction.high_bytes = std::int64_t{sizeof(WideTree)} + 20 * (spheres + kWidth) + high_nodes * 512;
  prediction.peak_bytes = 3 * prediction.high_bytes + 100 * (spheres + 10000);
  return prediction;
}

}  // namespace bihive
