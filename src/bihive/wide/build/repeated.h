// Finds equal spheres among a few, or among many duplicates.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/build/split.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// One for each bit of the count.
inline std::int64_t passes_of_sorting(std::int64_t count) {
  std::int64_t bits = 0;
  for (; count > 0; count >>= 1) ++bits;
  return bits;
}

/// Adds those of the spheres first to first + count - 1 that have an equal there, in no order. O(n log n).
void find_repeated(const SphereArrays& spheres, const float* palette, std::int64_t first, std::int64_t count,
                   std::vector<RepeatedSphere>& repeated);

/// The groups of duplicates among all repeated spheres of a set: more than kWidth equal ones, ordered by their lowest
/// ids. The others of each group are ordered by id.
void find_piles(const std::vector<RepeatedSphere>& repeated, std::vector<Pile>& piles,
                std::vector<std::uint32_t>& others);

}  // namespace bihive
