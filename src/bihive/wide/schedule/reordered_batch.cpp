#include "bihive/wide/schedule/reordered_batch.h"

#include <algorithm>
#include <cstddef>

namespace bihive::wide {
namespace {

// to[k] = from[order[k]]; empty if `from` is null. `all`: the order names each of the span's rays.
template <class T>
void reorder(const T* from, const std::vector<std::uint32_t>& order, bool all, std::vector<T>& to) {
  const std::size_t n = order.size();
  to.resize(from == nullptr ? 0 : n);
  if (from == nullptr) return;
  // Prefetch in memory order; then gather from the cache in any order.
  if (all)
    for (std::size_t i = 0; i < n; i += 64 / sizeof(T)) __builtin_prefetch(from + i);
  for (std::size_t k = 0; k < n; ++k) to[k] = from[order[k]];
}

template <class T>
bool all_equal(const T* values, std::size_t n) {
  for (std::size_t i = 0; i < n; i += 256) {
    int off = 0;
    for (std::size_t k = i; k < std::min(n, i + 256); ++k) off |= values[k] != values[0] ? 1 : 0;
    if (off != 0) return false;
  }
  return n > 0;
}

}  // namespace

void ReorderedBatch::gather(const RaySpan& rays) {
  const std::size_t n = order_.size();
  const bool all = static_cast<std::int64_t>(n) == rays.count;
  for (int axis = 0; axis < 3; ++axis) {
    reorder(rays.origin[axis], order_, all, rays_.origin[axis]);
    reorder(rays.direction[axis], order_, all, rays_.direction[axis]);
  }
  reorder(rays.leaves, order_, all, rays_.leaves);
  reorder(rays.t_min, order_, all, rays_.t_min);
  // Usually all rays end at the same t, as at a light, and none goes into a sphere.
  if (all && rays.t_max != nullptr && all_equal(rays.t_max, n)) {
    rays_.t_max.assign(n, rays.t_max[0]);
  } else {
    reorder(rays.t_max, order_, all, rays_.t_max);
  }
  const bool none_inside = all && rays.inside != nullptr && n > 0 && rays.inside[0] == 0 && all_equal(rays.inside, n);
  reorder(none_inside ? nullptr : rays.inside, order_, all, rays_.inside);
}

HitSpan ReorderedBatch::hits(std::int64_t count) {
  if (hits_.size() < count) hits_.resize(count);
  return hits_.span();
}

std::uint8_t* ReorderedBatch::hidden(std::int64_t count) {
  if (static_cast<std::int64_t>(hidden_.size()) < count) hidden_.resize(static_cast<std::size_t>(count));
  return hidden_.data();
}

void ReorderedBatch::put_back(std::int64_t first, std::int64_t count, const HitSpan& to) const {
  const std::uint32_t* const order = order_.data() + first;
  for (std::int64_t i = 0; i < count; ++i) {
    const Hit hit = hits_.at(i);
    to.t[order[i]] = hit.t;
    to.sphere_id[order[i]] = hit.sphere_id;
  }
}

void ReorderedBatch::put_back(std::int64_t first, std::int64_t count, std::uint8_t* to) const {
  const std::uint32_t* const order = order_.data() + first;
  for (std::int64_t i = 0; i < count; ++i) to[order[i]] = hidden_[static_cast<std::size_t>(i)];
}

}  // namespace bihive::wide
