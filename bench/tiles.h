// The rays of a set that are traced: all, or some tiles spread over the set if all would take too long.
#pragma once

#include <algorithm>
#include <cstdint>

namespace bihive::bench {

/// Every step-th tile of `size` rays of `rays`; size is a multiple of 64 or at least `rays`.
class Tiles {
 public:
  struct Range {
    std::int64_t begin, end;
  };

  static Tiles all(std::int64_t rays, std::int64_t size) { return {rays, size, 1}; }
  Tiles(std::int64_t rays, std::int64_t size, std::int64_t step) : rays_(rays), size_(size), step_(step) {
    const std::int64_t tiles = (rays + size - 1) / size;
    first_ = std::min(step / 2, tiles - 1);
    count_ = (tiles - first_ + step - 1) / step;
  }

  std::int64_t count() const { return count_; }
  Range range(std::int64_t i) const {
    const std::int64_t begin = (first_ + i * step_) * size_;
    return {begin, std::min(begin + size_, rays_)};
  }
  /// The number of rays in all these tiles.
  std::int64_t rays() const {
    std::int64_t sum = 0;
    for (std::int64_t i = 0; i < count_; ++i) sum += range(i).end - range(i).begin;
    return sum;
  }

 private:
  std::int64_t rays_, size_, step_;
  std::int64_t first_ = 0, count_ = 0;
};

}  // namespace bihive::bench
