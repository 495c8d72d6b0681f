// Groups of things that are numbered from 0, joined two by two.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace bihive::measure {

template <class Id>
class UnionFind {
 public:
  /// Each of them is a group of its own.
  explicit UnionFind(Id count) : parent_(static_cast<std::size_t>(count)), groups_(count) {
    std::iota(parent_.begin(), parent_.end(), Id{0});
  }

  /// The least of the group.
  Id group_of(Id i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Id i, Id j) {
    i = group_of(i);
    j = group_of(j);
    if (i == j) return;
    parent_[std::max(i, j)] = std::min(i, j);
    --groups_;
  }
  Id groups() const { return groups_; }

 private:
  std::vector<Id> parent_;
  Id groups_;
};

}  // namespace bihive::measure
