// Finds equal spheres among a few, or among many duplicates, and puts them into the tree.
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
void find_equal(const SphereArrays& spheres, const float* palette, std::int64_t first, std::int64_t count,
                std::vector<EqualSphere>& equal);

/// Makes equal spheres neighbours, by id.
void sort_equal(std::vector<EqualSphere>& equal);

/// The groups of duplicates among all equal spheres of a set, sorted: more than kWidth equal ones, ordered by their
/// lowest ids. The others of each group are ordered by id.
void find_piles(const std::vector<EqualSphere>& equal, std::vector<Pile>& piles, std::vector<std::uint32_t>& others);

/// Sets WideTree::repeated and its filter: the sorted spheres that have an equal in the leaves, themselves included.
void place_repeated(const std::vector<EqualSphere>& equal, WideTree& tree);

}  // namespace bihive
