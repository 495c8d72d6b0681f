#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "bihive/geometry/sphere_attributes.h"

namespace bihive {
namespace {

bool is_before(const StatedBond& a, const StatedBond& b) {
  return std::tie(a.one, a.other) < std::tie(b.one, b.other);
}

}  // namespace

void StatedBonds::add(std::int32_t one, std::int32_t other, BondOrder order) {
  if (one != other) list.push_back({std::min(one, other), std::max(one, other), order});
}

void StatedBonds::put_in_order() {
  const auto not_before = [](const StatedBond& a, const StatedBond& b) { return !is_before(a, b); };
  if (std::adjacent_find(list.begin(), list.end(), not_before) == list.end()) return;
  std::sort(list.begin(), list.end(), [](const StatedBond& a, const StatedBond& b) {
    return std::tie(a.one, a.other, b.order) < std::tie(b.one, b.other, a.order);
  });
  const auto is_same = [](const StatedBond& a, const StatedBond& b) { return a.one == b.one && a.other == b.other; };
  list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
}

void StatedBonds::keep_only(const std::vector<std::uint8_t>& kept) {
  if (list.empty()) return;
  std::vector<std::int32_t> id_of(kept.size(), -1);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] != 0) id_of[i] = count++;
  std::size_t to = 0;
  for (const StatedBond& bond : list) {
    const std::int32_t one = id_of[static_cast<std::size_t>(bond.one)];
    const std::int32_t other = id_of[static_cast<std::size_t>(bond.other)];
    if (one >= 0 && other >= 0) list[to++] = {one, other, bond.order};
  }
  list.resize(to);
}

StatedBonds StatedBonds::part(const std::vector<std::int64_t>& ids) const {
  StatedBonds made;
  made.are_all = are_all;
  if (list.empty()) return made;
  std::unordered_map<std::int64_t, std::vector<std::int32_t>> namings;
  for (std::size_t i = 0; i < ids.size(); ++i) namings[ids[i]].push_back(static_cast<std::int32_t>(i));
  for (const auto& [id, ones] : namings) {
    const StatedBond first{static_cast<std::int32_t>(id), 0, BondOrder::unknown};
    for (auto bond = std::lower_bound(list.begin(), list.end(), first, is_before);
         bond != list.end() && bond->one == first.one; ++bond) {
      const auto others = namings.find(bond->other);
      if (others == namings.end()) continue;
      for (std::size_t k = 0; k < std::min(ones.size(), others->second.size()); ++k)
        made.add(ones[k], others->second[k], bond->order);
    }
  }
  made.put_in_order();
  return made;
}

}  // namespace bihive
