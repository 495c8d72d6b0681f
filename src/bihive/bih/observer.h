// Hooks into a traversal: one call for each node, leaf, gap and test. A hook that does nothing costs nothing.
#pragma once

#include <cstdint>

namespace bihive {

/// The observer for a traversal without an observer. Any class with these members will do.
struct NoObserver {
  void node_visit() {}   ///< an inner node is entered
  void leaf_visit() {}   ///< a leaf is entered (empty leaves are not stored and never entered)
  void empty_gap() {}    ///< the ray's interval in a split node overlaps the gap between its children
  void sphere_test() {}  ///< a ray is tested against a sphere
};

/// Counts.
struct CountingObserver {
  std::int64_t node_visits = 0, leaf_visits = 0, empty_gaps = 0, sphere_tests = 0;

  void node_visit() { ++node_visits; }
  void leaf_visit() { ++leaf_visits; }
  void empty_gap() { ++empty_gaps; }
  void sphere_test() { ++sphere_tests; }
};

}  // namespace bihive
