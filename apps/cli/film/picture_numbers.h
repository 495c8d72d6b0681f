// A compact ascending list of picture numbers: those of a film or of its shard, present or missing ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace bihive::cli {

/// Numbers with equal steps are stored as one run.
class PictureNumbers {
 public:
  struct Run {
    std::int64_t first = 0, count = 0;
  };
  class Iterator;

  /// `step`: the usual difference between two, which is the count of shards.
  explicit PictureNumbers(std::int64_t step = 1, std::vector<Run> runs = {}) : step_(step), runs_(std::move(runs)) {
    for (const Run& run : runs_) size_ += run.count;
  }
  /// first, first + step, and so on below `end`.
  static PictureNumbers every(std::int64_t step, std::int64_t first, std::int64_t end) {
    if (first >= end) return PictureNumbers(step);
    return PictureNumbers(step, {{first, (end - first - 1) / step + 1}});
  }

  /// A number above all others.
  void add(std::int64_t number) {
    if (runs_.empty() || runs_.back().first + runs_.back().count * step_ != number) runs_.push_back({number, 0});
    ++runs_.back().count;
    ++size_;
  }
  bool contains(std::int64_t number) const {
    const auto after = std::upper_bound(runs_.begin(), runs_.end(), number,
                                        [](std::int64_t a, const Run& run) { return a < run.first; });
    if (after == runs_.begin()) return false;
    const Run& run = *std::prev(after);
    return (number - run.first) % step_ == 0 && (number - run.first) / step_ < run.count;
  }

  std::int64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::int64_t step() const { return step_; }
  const std::vector<Run>& runs() const { return runs_; }

  Iterator begin() const;
  Iterator end() const;

 private:
  std::int64_t step_;
  std::vector<Run> runs_;
  std::int64_t size_ = 0;
};

class PictureNumbers::Iterator {
 public:
  Iterator(const PictureNumbers& numbers, std::size_t run) : numbers_(&numbers), run_(run) {}

  std::int64_t operator*() const { return numbers_->runs_[run_].first + in_run_ * numbers_->step_; }
  Iterator& operator++() {
    if (++in_run_ == numbers_->runs_[run_].count) {
      ++run_;
      in_run_ = 0;
    }
    return *this;
  }
  bool operator!=(const Iterator& other) const { return run_ != other.run_ || in_run_ != other.in_run_; }

 private:
  const PictureNumbers* numbers_;
  std::size_t run_;
  std::int64_t in_run_ = 0;
};

inline PictureNumbers::Iterator PictureNumbers::begin() const {
  return {*this, 0};
}
inline PictureNumbers::Iterator PictureNumbers::end() const {
  return {*this, runs_.size()};
}

}  // namespace bihive::cli
