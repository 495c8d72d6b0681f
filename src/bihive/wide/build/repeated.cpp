#include "bihive/wide/build/repeated.h"

#include <algorithm>
#include <tuple>

namespace bihive {

void find_repeated(const SphereArrays& spheres, const float* palette, std::int64_t first, std::int64_t count,
                   std::vector<RepeatedSphere>& repeated) {
  // Sort, so that equal ones are neighbours.
  std::vector<RepeatedSphere> all(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::int64_t i = first + static_cast<std::int64_t>(k);
    const std::uint32_t word = spheres.word[i];
    const bool has_palette = spheres.r == nullptr;
    all[k] = {has_palette ? word & WideSpheres::kIdMask : word, spheres.x[i], spheres.y[i], spheres.z[i],
              has_palette ? palette[word >> WideSpheres::kIdBits] : spheres.r[i]};
  }
  const auto key = [](const RepeatedSphere& s) { return std::tie(s.x, s.y, s.z, s.r); };
  std::sort(all.begin(), all.end(), [&](const RepeatedSphere& a, const RepeatedSphere& b) { return key(a) < key(b); });

  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool as_before = k > 0 && key(all[k - 1]) == key(all[k]);
    const bool as_after = k + 1 < all.size() && key(all[k + 1]) == key(all[k]);
    if (as_before || as_after) repeated.push_back(all[k]);
  }
}

}  // namespace bihive
