#include "bihive/compare/box_tree.h"

#include <array>

#include "bihive/compare/level_sums.h"

namespace bihive::workbench {

StructureFacts facts_of(const BoxTree& tree) {
  StructureFacts facts;
  facts.bytes = static_cast<std::int64_t>(sizeof(BoxTree) + tree.nodes.capacity() * sizeof(BoxNode) +
                                          tree.sphere_ids.capacity() * sizeof(std::uint32_t));
  facts.nodes = static_cast<std::int64_t>(tree.nodes.size());
  if (tree.nodes.empty()) return facts;
  LevelSums sums(tree.nodes[0].box);
  std::vector<std::int64_t> level(tree.nodes.size(), 1);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BoxNode& node = tree.nodes[i];
    sums.add(level[i], node.box, node.is_leaf(), node.count);
    if (node.is_leaf()) continue;
    sums.add_children(level[i], node.box, std::array{tree.nodes[node.first].box, tree.nodes[node.first + 1].box});
    level[node.first] = level[node.first + 1] = level[i] + 1;
  }
  sums.put(facts);
  return facts;
}

}  // namespace bihive::workbench
