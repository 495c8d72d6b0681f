// Rays of a span copied in another order; their answers are scattered back to the rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"

namespace bihive::wide {

/// Use: fill order(), gather(), answer rays() (or some of them) into hits() or hidden(), put the answers back. Memory
/// is kept for the next use.
class ReorderedBatch {
 public:
  /// order()[k] is the number of the k-th ray: each number at most once.
  std::vector<std::uint32_t>& order() { return order_; }
  const std::vector<std::uint32_t>& order() const { return order_; }

  void gather(const RaySpan& rays);
  RaySpan rays() const { return rays_.span(); }

  /// Room for the answers of `count` rays.
  HitSpan hits(std::int64_t count);
  std::uint8_t* hidden(std::int64_t count);

  /// The answers of rays() from `first` on are the first `count` of hits() or hidden().
  void put_back(std::int64_t first, std::int64_t count, const HitSpan& to) const;
  void put_back(std::int64_t first, std::int64_t count, std::uint8_t* to) const;

 private:
  std::vector<std::uint32_t> order_;
  RayBatch rays_;
  HitBatch hits_;
  std::vector<std::uint8_t> hidden_;
};

}  // namespace bihive::wide
