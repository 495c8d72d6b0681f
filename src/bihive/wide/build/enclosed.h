// Spheres that lie wholly inside others, in such numbers that they slow down rays: shells around one centre, clusters
// of spheres of many sizes. Boxes do not tell such spheres apart, because all of them contain each other.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/wide_tree.h"

namespace bihive {

struct EnclosedSpheres {
  std::vector<Core> cores;              ///< every enclosed sphere lies in one; empty: there are none, or too few
  std::vector<std::int64_t> enclosing;  ///< the spheres around the cores
  std::vector<std::int64_t> others;     ///< of the spheres in leaves, those that are not enclosed, ascending
};

/// Finds enclosed spheres of a finished tree. Takes time in proportion to the nodes, unless there are nodes that are
/// hardly larger than one of their spheres: these take time in proportion to their spheres.
EnclosedSpheres find_enclosed(const WideTree& tree);

}  // namespace bihive
