// Orders rays by their cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace bihive::wide {

/// The stable order of `count` rays by their cells, which are below cell_count: order[k] is the number of the k-th ray.
/// count: below 2^32. `ends` is working memory.
inline void order_by_cells(const std::uint32_t* cells, std::size_t count, std::size_t cell_count,
                           std::vector<std::uint32_t>& ends, std::vector<std::uint32_t>& order) {
  // Count, then place.
  ends.assign(cell_count, 0);
  for (std::size_t i = 0; i < count; ++i) ++ends[cells[i]];
  std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0U);
  order.resize(count);
  for (std::size_t i = 0; i < count; ++i) order[ends[cells[i]]++] = static_cast<std::uint32_t>(i);
}

}  // namespace bihive::wide
