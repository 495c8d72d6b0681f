// Sums over the nodes of a tree, level by level: the part of StructureFacts that all trees share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bihive/compare/boxes.h"
#include "bihive/compare/structure.h"

namespace bihive::workbench {

class LevelSums {
 public:
  /// `root`: the root's box.
  explicit LevelSums(const Aabb& root) : whole_(half_surface(root)) {}

  /// A node on a level, from 1, and the number of spheres that it lists.
  void add(std::int64_t level, const Aabb& box, bool is_leaf, std::int64_t spheres) {
    add(level, box, is_leaf, spheres, spheres);
  }
  /// The same where the spheres take fewer steps to test.
  void add(std::int64_t level, const Aabb& box, bool is_leaf, std::int64_t spheres, std::int64_t test_steps) {
    test_steps_ += half_surface(box) * static_cast<double>(test_steps);
    LevelFacts& at = level_at(level).facts;
    ++at.nodes;
    at.leaves += is_leaf ? 1 : 0;
    at.references += spheres;
    at.expected_nodes += half_surface(box);
    at.expected_spheres += half_surface(box) * static_cast<double>(spheres);
  }

  /// The children of a node on a level.
  void add_children(std::int64_t level, const Aabb& parent, std::span<const Aabb> children) {
    Level& at = level_at(level);
    at.surface += half_surface(parent);
    for (std::size_t i = 0; i < children.size(); ++i) {
      at.of_children += half_surface(children[i]);
      for (std::size_t k = 0; k < i; ++k) at.shared += half_surface(common_part(children[i], children[k]));
    }
  }

  /// Sets leaves, references, depth, levels and the expected numbers.
  void put(StructureFacts& facts) const {
    facts.depth = std::ssize(levels_);
    if (whole_ > 0) {
      facts.expected_nodes = facts.expected_spheres = 0;
      facts.expected_test_steps = test_steps_ / whole_;
    }
    for (const Level& level : levels_) {
      LevelFacts made = level.facts;
      made.expected_nodes /= whole_;
      made.expected_spheres /= whole_;
      made.children = level.of_children / level.surface;
      made.overlap = level.shared / level.surface;
      facts.levels.push_back(made);
      facts.leaves += made.leaves;
      facts.references += made.references;
      if (!(whole_ > 0)) continue;
      facts.expected_nodes += made.expected_nodes;
      facts.expected_spheres += made.expected_spheres;
    }
  }

 private:
  struct Level {
    LevelFacts facts;
    double surface = 0, of_children = 0, shared = 0;  // of its inner nodes
  };

  Level& level_at(std::int64_t level) {
    if (std::ssize(levels_) < level) levels_.resize(static_cast<std::size_t>(level));
    return levels_[static_cast<std::size_t>(level - 1)];
  }
  // Boxes that touch share nothing.
  static Aabb common_part(const Aabb& a, const Aabb& b) {
    Aabb part;
    for (int axis = 0; axis < 3; ++axis) {
      part.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
      part.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
      if (!(part.lo[axis] < part.hi[axis])) return {};
    }
    return part;
  }

  double whole_;
  double test_steps_ = 0;
  std::vector<Level> levels_;
};

}  // namespace bihive::workbench
