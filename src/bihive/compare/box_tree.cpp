#include "bihive/compare/box_tree.h"

#include <algorithm>

namespace bihive::workbench {

StructureFacts facts_of(const BoxTree& tree) {
  StructureFacts facts;
  facts.bytes = static_cast<std::int64_t>(sizeof(BoxTree) + tree.nodes.capacity() * sizeof(BoxNode) +
                                          tree.sphere_ids.capacity() * sizeof(std::uint32_t));
  facts.nodes = static_cast<std::int64_t>(tree.nodes.size());
  if (tree.nodes.empty()) return facts;
  const double whole = half_surface(tree.nodes[0].box);
  double nodes = 0, spheres = 0;
  std::vector<std::int64_t> level(tree.nodes.size(), 1);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BoxNode& node = tree.nodes[i];
    const double share = half_surface(node.box) / whole;
    nodes += share;
    facts.depth = std::max(facts.depth, level[i]);
    if (node.is_leaf()) {
      ++facts.leaves;
      facts.references += node.count;
      spheres += share * node.count;
    } else {
      level[node.first] = level[node.first + 1] = level[i] + 1;
    }
  }
  if (whole > 0) facts.expected_nodes = nodes, facts.expected_spheres = spheres;
  return facts;
}

}  // namespace bihive::workbench
