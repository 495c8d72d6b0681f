// Rays in the order of cells: counting sort, and arrays put into that order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bihive::kernels {

/// The stable order of `count` rays by their cells, which are below cell_count: order[k] is the number of the ray that
/// comes k-th. count: below 2^32. `ends` is working memory.
inline void order_by_cells(const std::uint32_t* cells, std::size_t count, std::size_t cell_count,
                           std::vector<std::uint32_t>& ends, std::vector<std::uint32_t>& order) {
  // Count, then place.
  ends.assign(cell_count, 0);
  for (std::size_t i = 0; i < count; ++i) ++ends[cells[i]];
  std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0U);
  order.resize(count);
  for (std::size_t i = 0; i < count; ++i) order[ends[cells[i]]++] = static_cast<std::uint32_t>(i);
}

/// to[k] = from[order[k]], where `order` holds each number below its size once; empty if `from` is null.
template <class T>
void reorder(const T* from, const std::vector<std::uint32_t>& order, std::vector<T>& to) {
  const std::size_t n = order.size();
  to.resize(from == nullptr ? 0 : n);
  if (from == nullptr) return;
  // Into the cache in the order of memory, out of it in any other.
  for (std::size_t i = 0; i < n; i += 64 / sizeof(T)) __builtin_prefetch(from + i);
  for (std::size_t k = 0; k < n; ++k) to[k] = from[order[k]];
}

}  // namespace bihive::kernels
