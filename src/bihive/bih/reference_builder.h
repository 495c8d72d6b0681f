// The reference builder: the project's definition of "a BIH with MAX_PRIMS and MAX_TREE_DEPTH".
#pragma once

#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/aabb.h"

namespace bihive {

/// Builds the tree of the thesis: midpoint splits of a grid box, clip nodes around empty space, one-sided nodes, and
/// forced leaves if no split makes progress (docs/bih.md). All arithmetic is binary32 without fused multiply-add. The
/// tree depends only on the spheres and the parameters. Memory: sizeof(Node) for each node and 8 bytes for each sphere.
/// An empty set gives one leaf. Within a WatchedWork (base/watch.h) it reports, and throws Cancelled. `spheres_read`
/// gets the work, counted: each sphere once for every pass over it.
Tree build_reference_tree(const SphereSet& spheres, const BuildParameters& parameters,
                          std::int64_t* spheres_read = nullptr);

/// The same tree of anything that has boxes: `sphere_ids` are positions in the list.
Tree build_reference_tree(const std::vector<Aabb>& boxes, const BuildParameters& parameters);

}  // namespace bihive
