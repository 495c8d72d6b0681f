// The size of a wide tree's leaves.
#pragma once

#include "bihive/wide/wide_tree.h"

namespace bihive {

/// The mean of the largest extents of some leaves' boxes, stored units: the width at which a beam becomes wide.
float leaf_extent(const WideTree& tree);

}  // namespace bihive
