// Checks a wide tree against its spheres.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Done if every sphere is in exactly one leaf, as it is in the set; every box of a child holds the stored boxes of all
/// spheres below it; ranges are neighbours; every node is reached exactly once; slots without a child cannot be hit;
/// each order names every child once; the padding cannot be hit; levels, largest leaf and repeated spheres are as
/// stated. Otherwise an Error with the first fault. O(n log n).
Status validate_wide_tree(const WideTree& tree, const SphereSet& spheres);

}  // namespace bihive
