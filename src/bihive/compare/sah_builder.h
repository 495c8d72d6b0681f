// A BVH built from the top by the surface area heuristic, with centres in bins [Wald2007]: of anything that has boxes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "bihive/compare/box_tree.h"
#include "bihive/compare/structure.h"

namespace bihive::workbench {

constexpr int kSahBins = 16;
constexpr std::int64_t kSahLeaf = 8;  // unless centres coincide
/// Past this level ranges are halved by count, which takes at most 32 more.
constexpr std::int64_t kLevelsByCost = 80;
constexpr double kNodeCost = 1, kSphereCost = 1;

struct SahRange {
  std::uint32_t node, begin, end;
  std::int64_t level;

  std::uint32_t size() const { return end - begin; }
};

struct SahBin {
  Aabb box;
  std::uint32_t count = 0;

  void add(const SahBin& other) {
    box.add(other.box);
    count += other.count;
  }
  double cost() const { return half_surface(box) * count * kSphereCost; }
};

struct SahSplit {
  double cost = std::numeric_limits<double>::infinity();
  int axis = 0;
  int bin = 0;  // the first on the right
};

/// `Items` has count(), box(i) and centre(i): the bounds of item i, rounded outward, and the middle by which it is
/// sorted; centres of equal items are equal.
template <class Items>
class SahBuilder {
 public:
  SahBuilder(const Items& items, const StructureParameters& parameters)
      : items_(items),
        max_prims_(parameters.max_prims > 0 ? parameters.max_prims : kSahLeaf),
        max_depth_(parameters.max_depth > 0 ? parameters.max_depth : kMostBoxLevels),
        bin_count_(parameters.candidates > 0 ? static_cast<int>(parameters.candidates) + 1 : kSahBins) {
    ids_.resize(static_cast<std::size_t>(items.count()));
    std::iota(ids_.begin(), ids_.end(), 0U);
  }

  BoxTree build() {
    BoxTree tree;
    std::vector<SahRange> pending;
    if (!ids_.empty()) {
      tree.nodes.emplace_back();
      pending.push_back({0, 0, static_cast<std::uint32_t>(ids_.size()), 1});
    }
    while (!pending.empty()) {
      const SahRange range = pending.back();
      pending.pop_back();
      const std::uint32_t middle = split(range);
      if (middle == range.begin) {
        tree.nodes[range.node].first = range.begin;
        tree.nodes[range.node].count = range.size();
        continue;
      }
      const auto left = static_cast<std::uint32_t>(tree.nodes.size());
      tree.nodes[range.node].first = left;
      tree.nodes.resize(tree.nodes.size() + 2);
      pending.push_back({left, range.begin, middle, range.level + 1});
      pending.push_back({left + 1, middle, range.end, range.level + 1});
    }
    tree.sphere_ids = std::move(ids_);
    tree.nodes.shrink_to_fit();
    fit_boxes(tree, [this](std::uint32_t id) { return items_.box(id); });
    return tree;
  }

 private:
  const Items& items_;
  const std::int64_t max_prims_, max_depth_;
  const int bin_count_;
  std::vector<std::uint32_t> ids_;
  std::vector<SahBin> bins_;   // of one decision
  std::vector<double> right_;  // costs of all bins from each one on

  // Orders the range and returns where its right half begins; range.begin: it is a leaf.
  std::uint32_t split(const SahRange& range) {
    // Find the box of the centres, and of the spheres.
    Vec3d lo{1, 1, 1}, hi{-1, -1, -1};
    Aabb all;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Vec3d centre = items_.centre(ids_[i]);
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], centre[axis]);
        hi[axis] = std::max(hi[axis], centre[axis]);
      }
      all.add(items_.box(ids_[i]));
    }
    if (range.size() == 1 || lo == hi || range.level >= max_depth_) return range.begin;

    // Try each plane between two bins along each axis.
    const SahSplit best = range.level < kLevelsByCost ? best_split(range, lo, hi) : SahSplit{};
    const double surface = half_surface(all);
    const bool pays = surface * kNodeCost + best.cost < surface * range.size() * kSphereCost;
    if (!pays && range.size() <= max_prims_) return range.begin;
    if (best.cost == std::numeric_limits<double>::infinity()) return halve(range, lo, hi);
    const auto middle = std::partition(at(range.begin), at(range.end), [&](std::uint32_t id) {
      return bin_of(id, best.axis, lo[best.axis], hi[best.axis]) < best.bin;
    });
    return static_cast<std::uint32_t>(middle - ids_.begin());
  }

  SahSplit best_split(const SahRange& range, Vec3d lo, Vec3d hi) {
    const auto bin_count = static_cast<std::size_t>(bin_count_);
    SahSplit best;
    for (int axis = 0; axis < 3; ++axis) {
      if (lo[axis] == hi[axis]) continue;
      bins_.assign(bin_count, {});
      for (std::uint32_t i = range.begin; i < range.end; ++i)
        bins_[static_cast<std::size_t>(bin_of(ids_[i], axis, lo[axis], hi[axis]))].add({items_.box(ids_[i]), 1});
      // Costs of all bins from each one on; then the same up to each one.
      right_.assign(bin_count, 0);
      SahBin sum;
      for (std::size_t bin = bin_count; bin-- > 1;) {
        sum.add(bins_[bin]);
        right_[bin] = sum.count > 0 ? sum.cost() : std::numeric_limits<double>::infinity();
      }
      sum = {};
      for (std::size_t bin = 1; bin < bin_count; ++bin) {
        sum.add(bins_[bin - 1]);
        if (sum.count == 0) continue;
        const double cost = sum.cost() + right_[bin];
        if (cost < best.cost) best = {cost, axis, static_cast<int>(bin)};
      }
    }
    return best;
  }

  int bin_of(std::uint32_t id, int axis, double lo, double hi) const {
    const double share = (items_.centre(id)[axis] - lo) / (hi - lo);
    return std::min(bin_count_ - 1, static_cast<int>(share * bin_count_));
  }

  // By count along the longest axis of the centres.
  std::uint32_t halve(const SahRange& range, Vec3d lo, Vec3d hi) {
    const Vec3d size = hi - lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = range.begin + range.size() / 2;
    std::nth_element(at(range.begin), at(middle), at(range.end), [&](std::uint32_t a, std::uint32_t b) {
      const double x = items_.centre(a)[axis], y = items_.centre(b)[axis];
      return x != y ? x < y : a < b;
    });
    return middle;
  }

  std::vector<std::uint32_t>::iterator at(std::uint32_t i) { return ids_.begin() + static_cast<std::ptrdiff_t>(i); }
};

}  // namespace bihive::workbench
