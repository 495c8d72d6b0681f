// The builder's second step: sixteen neighbours of the binary tree become one wide node.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/wide/build/binary_tree.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

struct CollapseParameters {
  int most_levels = kMostLevels;  ///< maximum wide nodes on a path from the root, >= 1; the rest becomes leaves
};

/// Makes the wide nodes of a binary tree, in subtrees that do not depend on the number of threads.
class Collapse {
 public:
  /// Throws std::bad_alloc, and Cancelled if the work is.
  void run(const BinaryNode& root, const CollapseParameters& parameters, int threads, WatchedWork& work);

  std::int64_t node_count() const { return node_count_; }
  int levels() const { return levels_; }
  std::int64_t largest_leaf() const { return largest_leaf_; }

  /// Copies the nodes: node_count() entries starting at `to`.
  void copy_to(WideNode* to, int threads) const;

  std::int64_t allocated_bytes() const;

 private:
  // A wide node to be built: its index in its subtree, the binary node that it replaces, its first sphere, its level
  // from 1.
  struct Job {
    std::int64_t place;
    const BinaryNode* binary;
    std::int64_t first;
    int level;
  };
  // Nodes built by one task. Their indices count from `base` in the tree.
  struct Subtree {
    Job root;  // its index is among the nodes of the top
    WideNode root_node;
    std::vector<WideNode> nodes;
    std::vector<Job> jobs;
    std::int64_t base = 0;
    std::int64_t largest_leaf = 0;
    int levels = 0;
    bool out_of_memory = false;
  };

  void make_subtree(Subtree& subtree) const;
  WideNode make_node(const Job& job, Subtree& subtree, std::vector<Job>& jobs) const;

  CollapseParameters parameters_;
  Subtree top_;
  std::vector<Subtree> subtrees_;
  std::size_t subtree_count_ = 0;
  std::int64_t node_count_ = 0, largest_leaf_ = 0;
  int levels_ = 0;
};

}  // namespace bihive
