#include "bihive/render/query/stick_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "bihive/base/watch.h"

namespace bihive {
namespace {

struct BoxOfStick {
  Aabb box;
  std::int32_t stick;

  float twice_middle(int axis) const { return box.lo[axis] + box.hi[axis]; }
};

// Sticks that lie side by side in the array.
struct Range {
  std::size_t begin = 0, end = 0;
  Aabb box;

  std::size_t size() const { return end - begin; }
};

double half_surface(const Aabb& box) {
  const Vec3d size = to_double(box.hi) - to_double(box.lo);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

constexpr std::size_t kWatchedRange = 1024;  // takes some 0.1 ms

class Builder {
 public:
  Builder(const std::vector<Aabb>& boxes, std::vector<StickNode>& nodes) : nodes_(nodes) {
    sticks_.reserve(boxes.size());
    for (const Aabb& box : boxes) sticks_.push_back({box, static_cast<std::int32_t>(sticks_.size())});
  }

  // Returns the number of levels.
  int run(const Aabb& whole) {
    struct Pending {
      std::size_t number;
      int level;
      Range range;
    };
    int levels = 0;
    WatchedWork* const work = WatchedWork::current();
    nodes_.emplace_back();
    std::vector<Pending> pending{{0, 1, {0, sticks_.size(), whole}}};
    while (!pending.empty()) {
      const auto [number, level, range] = pending.back();
      pending.pop_back();
      levels = std::max(levels, level);
      if (work != nullptr && range.size() >= kWatchedRange) work->stop_if_cancelled();
      divide(range);
      StickNode made;
      for (std::size_t slot = 0; slot < kStickWidth; ++slot) {
        const Aabb box = slot < count_ ? children_[slot].box : Aabb();
        for (int axis = 0; axis < 3; ++axis) {
          made.lo[axis][slot] = box.lo[axis];
          made.hi[axis][slot] = box.hi[axis];
        }
        made.child[slot] = 0;
        if (slot >= count_) continue;
        const Range& child = children_[slot];
        if (child.size() == 1) {
          made.child[slot] = ~sticks_[child.begin].stick;
        } else {
          made.child[slot] = static_cast<std::int32_t>(nodes_.size());
          pending.push_back({nodes_.size(), level + 1, child});
          nodes_.emplace_back();
        }
      }
      nodes_[number] = made;
    }
    return levels;
  }

 private:
  // The children of a node: the range with the largest surface is halved until all slots are full.
  void divide(const Range& range) {
    children_[0] = range;
    count_ = 1;
    while (count_ < kStickWidth) {
      std::size_t largest = count_;
      double most = -1;
      for (std::size_t i = 0; i < count_; ++i) {
        if (children_[i].size() == 1) continue;
        const double surface = half_surface(children_[i].box);
        if (surface > most) most = surface, largest = i;
      }
      if (largest == count_) return;
      children_[count_++] = halve(children_[largest]);
    }
  }

  // In space, between the middles of the sticks, or by count where they share one. Returns the upper half; `range`
  // becomes the lower one.
  Range halve(Range& range) {
    const auto begin = sticks_.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto end = sticks_.begin() + static_cast<std::ptrdiff_t>(range.end);
    Vec3f low, high;
    low.x = low.y = low.z = std::numeric_limits<float>::infinity();
    high = -low;
    for (auto one = begin; one != end; ++one)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], one->twice_middle(axis));
        high[axis] = std::max(high[axis], one->twice_middle(axis));
      }
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    const float middle = 0.5F * low[longest] + 0.5F * high[longest];
    auto split = std::partition(begin, end, [&](const BoxOfStick& one) { return one.twice_middle(longest) < middle; });
    if (split == begin || split == end) split = begin + (end - begin) / 2;

    const auto box_of = [](auto first, auto last) {
      Aabb box;
      for (; first != last; ++first) box.add(first->box);
      return box;
    };
    const Range upper{static_cast<std::size_t>(split - sticks_.begin()), range.end, box_of(split, end)};
    range = {range.begin, upper.begin, box_of(begin, split)};
    return upper;
  }

  std::vector<BoxOfStick> sticks_;
  std::vector<StickNode>& nodes_;
  std::array<Range, kStickWidth> children_;
  std::size_t count_ = 0;
};

}  // namespace

StickTree::StickTree(const std::vector<Aabb>& boxes) {
  if (boxes.empty()) return;
  double sum = 0;
  for (const Aabb& box : boxes) {
    box_.add(box);
    const Vec3d size = to_double(box.hi) - to_double(box.lo);
    sum += std::max({size.x, size.y, size.z});
  }
  mean_extent_ = sum / static_cast<double>(boxes.size());
  levels_ = Builder(boxes, nodes_).run(box_);
}

}  // namespace bihive
