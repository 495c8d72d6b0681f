#include "bihive/io/alternates.h"

namespace bihive {
void Alternates::add(const std::string& site, char mark, double occupancy, std::size_t index) {
  const auto [entry, is_new] = sites_.try_emplace(site, Site{std::string(1, mark), occupancy, index});
  if (is_new) return;
  Site& best = entry->second;
  if (best.marks.find(mark) != std::string::npos) {
    best = {std::string(1, mark), occupancy, index};
    return;
  }
  best.marks += mark;
  if (occupancy > best.occupancy) {
    removed_.push_back(best.index);
    best.occupancy = occupancy;
    best.index = index;
  } else {
    removed_.push_back(index);
  }
}

void Alternates::remove_from(RawSpheres& spheres) const {
  if (removed_.empty()) return;
  std::vector<std::uint8_t> kept(spheres.size(), 1);
  for (const std::size_t index : removed_) kept[index] = 0;
  for (auto* values : {&spheres.x, &spheres.y, &spheres.z, &spheres.r}) keep_entries(*values, kept);
  spheres.attributes.keep_only(kept);
  spheres.rules.push_back("alternate locations: the highest occupancy, of equal ones the first; " +
                          std::to_string(removed_.size()) + " atoms left out");
}

}  // namespace bihive
