// Groups of things that repeat along a lattice: joined two by two, each at some image.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "bihive/geometry/lattice.h"

namespace bihive::measure {

/// Vectors of a lattice as counts: whole multiples of some of them, in Hermite's normal form. So equal sets have equal
/// rows; their number is the dimension of what they extend over.
class Translations {
 public:
  void add(ImageCounts counts) {
    for (std::size_t k = 0; k < 3; ++k) {
      ImageCounts& row = rows_[k];
      // Euclid's algorithm on this coordinate.
      while (counts[k] != 0) {
        const std::int64_t factor = row[k] / counts[k];
        for (std::size_t m = k; m < 3; ++m) row[m] -= factor * counts[m];
        std::swap(row, counts);
      }
      if (row[k] < 0) row = ImageCounts{} - row;
    }
    for (std::size_t k = 1; k < 3; ++k)
      for (std::size_t above = 0; above < k && rows_[k][k] != 0; ++above) {
        const std::int64_t over = rows_[above][k], by = rows_[k][k];
        const std::int64_t factor = over >= 0 ? over / by : -((by - 1 - over) / by);
        for (std::size_t m = k; m < 3; ++m) rows_[above][m] -= factor * rows_[k][m];
      }
  }
  std::vector<ImageCounts> rows() const {
    std::vector<ImageCounts> some;
    for (std::size_t k = 0; k < 3; ++k)
      if (rows_[k][k] != 0) some.push_back(rows_[k]);
    return some;
  }

 private:
  std::array<ImageCounts, 3> rows_{};  // row k begins with k zeros; all of it is 0 where [k][k] is
};

/// Each thing is in a group, at an image of its own relative to the group's others.
class LatticeUnionFind {
 public:
  struct Member {
    std::int64_t group;  ///< the least of it
    ImageCounts image;   ///< relative to that one
  };

  explicit LatticeUnionFind(std::int64_t count)
      : parent_(static_cast<std::size_t>(count)), image_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), std::int64_t{0});
  }

  Member member(std::int64_t i) {
    // The group first, then every image on the way relative to it.
    std::int64_t group = i;
    ImageCounts image{};
    for (; parent_[group] != group; group = parent_[group]) image = image + counts_of(group);
    ImageCounts rest = image;
    while (parent_[i] != i) {
      const std::int64_t next = parent_[i];
      const ImageCounts own = counts_of(i);
      parent_[i] = group;
      set_counts(i, rest);
      rest = rest - own;
      i = next;
    }
    return {group, image};
  }

  /// i at image `of_i` and j at image `of_j` touch each other.
  void join(std::int64_t i, ImageCounts of_i, std::int64_t j, ImageCounts of_j) {
    const Member first = member(i), second = member(j);
    // The image of group `second` relative to that of `first`.
    const ImageCounts between = (of_i - first.image) - (of_j - second.image);
    if (first.group == second.group) {
      if (between != ImageCounts{}) loops_.push_back({i, between});
    } else if (first.group < second.group) {
      parent_[second.group] = first.group;
      set_counts(second.group, ImageCounts{} - between);
    } else {
      parent_[first.group] = second.group;
      set_counts(first.group, between);
    }
  }

  /// Of each group that meets images of itself, by its number: the translations that bring it to itself.
  std::map<std::int64_t, Translations> loops() {
    std::map<std::int64_t, Translations> of_group;
    for (const Loop& loop : loops_) of_group[member(loop.member).group].add(loop.counts);
    return of_group;
  }

 private:
  struct Loop {
    std::int64_t member;
    ImageCounts counts;
  };
  std::vector<std::int64_t> parent_;
  std::vector<std::array<std::int32_t, 3>> image_;  // relative to the parent
  std::vector<Loop> loops_;

  ImageCounts counts_of(std::int64_t i) const { return {image_[i][0], image_[i][1], image_[i][2]}; }
  void set_counts(std::int64_t i, const ImageCounts& counts) {
    for (std::size_t k = 0; k < 3; ++k) image_[i][k] = static_cast<std::int32_t>(counts[k]);
  }
};

}  // namespace bihive::measure
