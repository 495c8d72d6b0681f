// The optical depth along rays: the sum over all spheres that a ray hits. Neither the hits nor their order are needed,
// so it takes a fraction of the time of all_hits().
#pragma once

#include <algorithm>
#include <cstdint>

#include "bihive/math/optical_depth.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// A row of 1 to 3 depths for each sphere, such as one for each channel. The caller owns the arrays.
struct SphereDepths {
  const OpticalDepth* rows = nullptr;  ///< of sphere `number` in column c: rows[number * columns + c]
  int columns = 1;
  const std::int64_t* number_of = nullptr;  ///< of each id; null: the id itself

  const OpticalDepth* row(std::int64_t id) const {
    return rows + (number_of != nullptr ? number_of[id] : id) * columns;
  }
};

/// The sums of rays, to be written: for each column of the spheres' depths an array with a number for each ray.
struct DepthSums {
  OpticalDepth* columns[3] = {};

  void clear(std::int64_t rays, int count) const {
    for (int c = 0; c < count; ++c) std::fill_n(columns[c], rays, OpticalDepth{0});
  }
  /// Adds a row of `count` depths to the sums of a ray.
  void add(std::int64_t ray, const OpticalDepth* row, int count) const {
    for (int c = 0; c < count; ++c) columns[c][ray] = sum_of_depths(columns[c][ray], row[c]);
  }
};

/// The sum over all spheres that a ray's segment hits (those of all_hits()), for each ray. Threads, memory and speed as
/// in wide/queries.h; neighbouring rays that are close in origin and direction are fast.
void optical_depths(const WideTree& tree, const RaySpan& rays, const SphereDepths& depths, const DepthSums& sums);

}  // namespace bihive
