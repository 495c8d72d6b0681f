#include "bihive/io/alternates.h"

namespace bihive {
namespace {

template <class T>
void keep_only(std::vector<T>& values, const std::vector<bool>& kept) {
  if (values.empty()) return;
  std::size_t to = 0;
  for (std::size_t from = 0; from < values.size(); ++from)
    if (kept[from]) values[to++] = values[from];
  values.resize(to);
}

}  // namespace

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
  std::vector<bool> kept(spheres.size(), true);
  for (const std::size_t index : removed_) kept[index] = false;
  for (auto* values : {&spheres.x, &spheres.y, &spheres.z, &spheres.r}) keep_only(*values, kept);
  SphereAttributes& attributes = spheres.attributes;
  keep_only(attributes.element, kept);
  keep_only(attributes.type, kept);
  keep_only(attributes.colour, kept);
  keep_only(attributes.opacity, kept);
  for (NamedNumbers& column : attributes.numbers) keep_only(column.values, kept);
  spheres.rules.push_back("alternate locations: the highest occupancy, of equal ones the first; " +
                          std::to_string(removed_.size()) + " atoms left out");
}

}  // namespace bihive
