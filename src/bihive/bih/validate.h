// Checks a tree against its spheres.
#pragma once

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Success if every sphere is in exactly one leaf, every clip plane bounds the boxes of all spheres below it, every
/// node is reached exactly once, inner = leaves - 1 + optimized, no leaf is deeper than max_depth, and no leaf is
/// larger than max_prims unless forced or at max_depth. Otherwise an Error with the first fault.
Status validate_tree(const Tree& tree, const SphereSet& spheres);

}  // namespace bihive
