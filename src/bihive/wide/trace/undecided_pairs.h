// Pairs of a ray and a sphere that binary32 cannot decide: they wait here until binary64 does (exact_decision-inl.h).
#pragma once

#include <cstdint>

namespace bihive {

/// A ray's number in its span, and a sphere's slot.
struct Pair {
  std::uint32_t ray;
  std::uint32_t slot;
};

/// Room for `kRoom` pairs. The caller checks has_room() before it adds one.
template <int kRoom>
class UndecidedPairs {
 public:
  bool empty() const { return count_ == 0; }
  bool has_room(int more) const { return count_ + more <= kRoom; }
  int count() const { return count_; }
  const Pair* data() const { return pairs_; }

  void add(std::int64_t ray, std::uint32_t slot) { pairs_[count_++] = {static_cast<std::uint32_t>(ray), slot}; }
  void clear() { count_ = 0; }

 private:
  int count_ = 0;
  Pair pairs_[kRoom];
};

}  // namespace bihive
