// Rays that a traversal returns because it is not made for them. The schedule decides which other one answers them
// (wide/schedule/scheduler.cpp).
#pragma once

#include <cstdint>
#include <vector>

namespace bihive {

/// Numbers of rays of a span, as runs of neighbours.
class RemainingRays {
 public:
  struct Run {
    std::int64_t first, count;
  };

  /// Rays first to first + count - 1, which were not added before.
  void add(std::int64_t first, std::int64_t count) {
    count_ += count;
    if (!runs_.empty() && runs_.back().first + runs_.back().count == first) {
      runs_.back().count += count;
    } else {
      runs_.push_back({first, count});
    }
  }

  std::int64_t count() const { return count_; }
  const std::vector<Run>& runs() const { return runs_; }

 private:
  std::vector<Run> runs_;
  std::int64_t count_ = 0;
};

}  // namespace bihive
