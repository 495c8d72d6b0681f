#include "bihive/wide/build/repeated.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "bihive/wide/tree/left_sphere.h"

namespace bihive {
namespace {

constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

auto surface(const EqualSphere& sphere) {
  return std::tie(sphere.x, sphere.y, sphere.z, sphere.r);
}

// Calls use(first, end) for each group of equal spheres.
template <class Use>
void for_groups(const std::vector<EqualSphere>& equal, const Use& use) {
  for (std::size_t first = 0, end = 0; first < equal.size(); first = end) {
    for (end = first + 1; end < equal.size() && surface(equal[end]) == surface(equal[first]);) ++end;
    use(first, end);
  }
}

}  // namespace

void find_equal(const SphereArrays& spheres, const float* palette, std::int64_t first, std::int64_t count,
                std::vector<EqualSphere>& equal) {
  // Sort, so that equal ones are neighbours.
  std::vector<EqualSphere> all(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::int64_t i = first + static_cast<std::int64_t>(k);
    const std::uint32_t word = spheres.word[i];
    const bool has_palette = spheres.r == nullptr;
    all[k] = {has_palette ? word & WideSpheres::kIdMask : word, spheres.x[i], spheres.y[i], spheres.z[i],
              has_palette ? palette[word >> WideSpheres::kIdBits] : spheres.r[i]};
  }
  std::sort(all.begin(), all.end(), [](const EqualSphere& a, const EqualSphere& b) { return surface(a) < surface(b); });
  for_groups(all, [&](std::size_t from, std::size_t end) {
    if (end - from > 1)
      equal.insert(equal.end(), all.begin() + static_cast<std::ptrdiff_t>(from),
                   all.begin() + static_cast<std::ptrdiff_t>(end));
  });
}

void sort_equal(std::vector<EqualSphere>& equal) {
  std::sort(equal.begin(), equal.end(), [](const EqualSphere& a, const EqualSphere& b) {
    return surface(a) != surface(b) ? surface(a) < surface(b) : a.id < b.id;
  });
}

void find_piles(const std::vector<EqualSphere>& equal, std::vector<Pile>& piles, std::vector<std::uint32_t>& others) {
  piles.clear();
  others.clear();
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for_groups(equal, [&](std::size_t first, std::size_t end) {
    if (end - first > std::size_t{kWidth}) groups.emplace_back(first, end);
  });
  std::sort(groups.begin(), groups.end(),
            [&](const auto& a, const auto& b) { return equal[a.first].id < equal[b.first].id; });
  for (const auto& [first, end] : groups) {
    const std::size_t from = others.size();
    for (std::size_t k = first + 1; k < end; ++k) others.push_back(equal[k].id);
    piles.push_back({equal[first].id, from, others.size()});
  }
}

void place_repeated(const std::vector<EqualSphere>& equal, WideTree& tree) {
  tree.repeated.clear();
  tree.repeated_filter.clear();
  if (equal.empty()) return;
  // By id, each with the number of its group instead of a slot.
  std::uint32_t groups = 0;
  tree.repeated.reserve(equal.size());
  for_groups(equal, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) tree.repeated.push_back({equal[k].id, groups});
    ++groups;
  });
  std::sort(tree.repeated.begin(), tree.repeated.end(),
            [](const RepeatedSphere& a, const RepeatedSphere& b) { return a.id < b.id; });
  tree.repeated_filter = filter_of(tree.repeated);

  // Find the first slot of each group.
  std::vector<std::uint32_t> first_slot(groups, kNowhere);
  for (std::int64_t slot = 0; slot < tree.placed; ++slot) {
    const RepeatedSphere* const found = find_repeated(tree, tree.spheres.id(slot));
    if (found != nullptr) first_slot[found->slot] = std::min(first_slot[found->slot], static_cast<std::uint32_t>(slot));
  }
  for (RepeatedSphere& sphere : tree.repeated) sphere.slot = first_slot[sphere.slot];

  // An outer tree has leaves for some of them only.
  const auto is_nowhere = [](const RepeatedSphere& sphere) { return sphere.slot == kNowhere; };
  const auto end = std::remove_if(tree.repeated.begin(), tree.repeated.end(), is_nowhere);
  if (end == tree.repeated.end()) return;
  tree.repeated.erase(end, tree.repeated.end());
  tree.repeated_filter = filter_of(tree.repeated);
}

}  // namespace bihive
