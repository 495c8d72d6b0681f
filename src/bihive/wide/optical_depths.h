// What the spheres along rays let through, as the sum of their optical depths: a query for all hits that need not say
// which, nor where, and so takes a fraction of the time of all_hits().
#pragma once

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

  void add(std::int64_t ray, const SphereDepths& depths, std::int64_t sphere_id) const {
    const OpticalDepth* const row = depths.row(sphere_id);
    for (int c = 0; c < depths.columns; ++c) columns[c][ray] = sum_of_depths(columns[c][ray], row[c]);
  }
};

/// The sum over all spheres that a ray's segment hits (those of all_hits()), for each ray. Threads, memory and speed as
/// in wide/queries.h; neighbouring rays that are close in origin and direction are fast.
void optical_depths(const WideTree& tree, const RaySpan& rays, const SphereDepths& depths, const DepthSums& sums);

}  // namespace bihive
