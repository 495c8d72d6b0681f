#include "bihive/wide/build/repeated.h"

#include <algorithm>
#include <tuple>
#include <utility>

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

void find_piles(const std::vector<RepeatedSphere>& repeated, std::vector<Pile>& piles,
                std::vector<std::uint32_t>& others) {
  piles.clear();
  others.clear();
  if (repeated.size() <= std::size_t{kWidth}) return;
  // Equal spheres become neighbours, by id.
  const auto key = [](const RepeatedSphere& s) { return std::tie(s.x, s.y, s.z, s.r); };
  std::vector<RepeatedSphere> sorted = repeated;
  std::sort(sorted.begin(), sorted.end(), [&](const RepeatedSphere& a, const RepeatedSphere& b) {
    return key(a) != key(b) ? key(a) < key(b) : a.id < b.id;
  });
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t first = 0, end = 0; first < sorted.size(); first = end) {
    for (end = first + 1; end < sorted.size() && key(sorted[end]) == key(sorted[first]);) ++end;
    if (end - first > std::size_t{kWidth}) groups.emplace_back(first, end);
  }
  std::sort(groups.begin(), groups.end(),
            [&](const auto& a, const auto& b) { return sorted[a.first].id < sorted[b.first].id; });
  for (const auto& [first, end] : groups) {
    const std::size_t from = others.size();
    for (std::size_t k = first + 1; k < end; ++k) others.push_back(sorted[k].id);
    piles.push_back({sorted[first].id, from, others.size()});
  }
}

}  // namespace bihive
