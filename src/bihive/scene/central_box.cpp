#include "bihive/scene/central_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bihive {

CentralBox central_box(const SphereSet& spheres, double share) {
  const std::size_t count = static_cast<std::size_t>(spheres.size());
  const auto n = static_cast<double>(count);
  const auto left_out = static_cast<std::size_t>(std::floor((n - n * share) / 2));
  const std::size_t first = std::min(left_out, (count - 1) / 2);
  const std::vector<float>* const coordinates[] = {&spheres.x(), &spheres.y(), &spheres.z()};
  CentralBox box;
  std::vector<float> sorted;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sorted = *coordinates[axis];
    const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(first);
    const auto high = sorted.end() - static_cast<std::ptrdiff_t>(first) - 1;
    std::nth_element(sorted.begin(), low, sorted.end());
    box.lo[axis] = *low;
    std::nth_element(low, high, sorted.end());
    box.hi[axis] = *high;
  }
  return box;
}

}  // namespace bihive
