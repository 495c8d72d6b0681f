// The traversal of trees whose nodes have any number of children: the nearest one first, the others wait.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace bihive::workbench {

/// Takes a query from `root` on to every node that it enters at limit() or before. `root_entry` and the entries of
/// children are numbers that say where the query enters them, +inf: never. open(node, wait) visits the spheres of a
/// node, and returns true to end there; it calls wait(child, entry) for each child. Of equal entries the child named
/// first is taken first. No more than `kMostWaiting` nodes may wait at a time.
template <std::size_t kMostWaiting, class Node, class Open, class Limit>
void nearest_first(const Node& root, double root_entry, const Open& open, const Limit& limit) {
  struct Waiting {
    Node node;
    double entry;
  };
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before read
  std::array<Waiting, kMostWaiting> waiting;
  std::size_t waiting_count = 0;

  Waiting at{root, root_entry};
  if (at.entry == std::numeric_limits<double>::infinity()) return;
  for (;;) {
    // Keep the children of this node sorted, the nearest on top.
    const std::size_t first = waiting_count;
    const bool ends = open(at.node, [&](const Node& child, double entry) {
      if (entry == std::numeric_limits<double>::infinity()) return;
      std::size_t position = waiting_count++;
      for (; position > first && waiting[position - 1].entry <= entry; --position)
        waiting[position] = waiting[position - 1];
      waiting[position] = {child, entry};
    });
    if (ends) return;

    // Enter the next node that may matter; at the limit itself it may hold a smaller id.
    do {
      if (waiting_count == 0) return;
      at = waiting[--waiting_count];
    } while (at.entry > limit());
  }
}

}  // namespace bihive::workbench
