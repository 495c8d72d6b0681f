// The reference builder: the project's definition of "a BIH with MAX_PRIMS and MAX_TREE_DEPTH".
#pragma once

#include "bihive/bih/tree.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Builds the tree of the thesis: midpoint splits of a grid box, clip nodes around empty space, one-sided nodes, and
/// forced leaves where no split makes progress (docs/bih.md). All arithmetic is binary32 without fused multiply-add.
/// Depends on nothing but the spheres and the parameters. Memory: sizeof(Node) a node and 8 bytes a sphere. An empty
/// set gives one leaf.
Tree build_reference_tree(const SphereSet& spheres, const BuildParameters& parameters);

}  // namespace bihive
