// The children of stick nodes that a traversal has yet to visit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/render/query/stick_tree.h"

namespace bihive {

/// A stack; of the children of one node the nearest lies on top. `Number`: how far away a child is entered.
template <class Number>
class WaitingChildren {
 public:
  struct Child {
    Number entry;
    std::int32_t child;  ///< as in StickNode
  };

  /// Of a tree with this many levels, each of which leaves at most fifteen children waiting. Deep trees are rare.
  explicit WaitingChildren(int levels) {
    if (levels <= kFewLevels) return;
    of_many_.resize(static_cast<std::size_t>(levels) * kStickWidth);
    waiting_ = of_many_.data();
  }
  WaitingChildren(const WaitingChildren&) = delete;
  WaitingChildren& operator=(const WaitingChildren&) = delete;

  bool empty() const { return count_ == 0; }
  Child pop() { return waiting_[--count_]; }
  /// Adds the children of `node` whose bits are set, each with its entry.
  void push(const StickNode& node, std::uint32_t entered, const Number* entries) {
    const int first = count_;
    for (; entered != 0; entered &= entered - 1) {
      const int slot = __builtin_ctz(entered);
      int at = count_++;
      for (; at > first && waiting_[at - 1].entry < entries[slot]; --at) waiting_[at] = waiting_[at - 1];
      waiting_[at] = {entries[slot], node.child[slot]};
    }
  }

 private:
  static constexpr int kFewLevels = 48;

  Child of_few_[kFewLevels * kStickWidth];  // NOLINT: written before read
  std::vector<Child> of_many_;
  Child* waiting_ = of_few_;
  int count_ = 0;
};

}  // namespace bihive
