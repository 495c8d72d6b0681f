// Hits of coincident spheres, of which the tree holds one alone (WideTree::piles).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Calls use(id) for each duplicate of a sphere that the tree holds.
template <class Use>
void for_duplicates(const WideTree& traced, std::int64_t sphere_id, const Use& use) {
  const WideTree& tree = traced.is_image ? *traced.image_of : traced;
  if (tree.piles.empty()) return;
  const auto pile = std::lower_bound(tree.piles.begin(), tree.piles.end(), sphere_id,
                                     [](const Pile& one, std::int64_t id) { return one.id < id; });
  if (pile == tree.piles.end() || pile->id != sphere_id) return;
  for (std::size_t k = pile->first_other; k < pile->end_of_others; ++k) use(tree.others_in_piles[k]);
}

/// Adds, for hits from number `first` on, those of the duplicates of their spheres.
inline void add_duplicates(const WideTree& traced, std::size_t first, std::vector<RayHit>& hits) {
  for (std::size_t i = first, known = hits.size(); i < known; ++i) {
    const RayHit hit = hits[i];
    for_duplicates(traced, hit.sphere_id, [&](std::int64_t id) { hits.push_back({hit.ray, hit.t, id}); });
  }
}

}  // namespace bihive
