// What a set holds, for lists and legends beside a picture: its groups, the meaning of its colours, and how the numbers
// of an attribute are distributed. As JSON, for the page's worker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Spheres that have a name in common.
struct ContentGroup {
  std::string of;         ///< "kind" (protein, water ...), "ligand", or the attribute: "chain", "element", "type" ...
  std::string name;       ///< "water", "A"
  std::string selection;  ///< means exactly these spheres (select/selection.h)
  std::int64_t count = 0;
};

/// An attribute with more groups than this is left out.
constexpr std::size_t kMostGroups = 60;

/// Kinds of residues and the ligands by name where residues have names, then chains, elements, types, and the input's
/// own columns of texts, each if it tells at least two groups apart. Groups of one attribute are in the order of
/// appearance, elements and types from low to high. Costs a few passes over the spheres.
std::vector<ContentGroup> contents_of(const SphereSet& spheres);

/// {"groups": [{"of", "name", "select", "count"}], "low": [x, y, z], "high": [x, y, z]}: the groups, and the box around
/// the spheres, in world units.
std::string contents_to_json(const SphereSet& spheres);

/// As scene/legend.h: [{"title", "entries": [{"name", "colour": "#rrggbb", "select"}], "scale": null or {"least",
/// "most", "logarithmic", "colours": [from low to high]}}]. "select" is empty where no selection means the entry.
std::string legend_to_json(const Scene& scene);

/// {"least", "most", "counts"}: how many finite numbers of an attribute, or of an expression of some, lie in each of
/// `bins` parts of equal width from the least to the most. Error: there is no such attribute, or it has no finite
/// number.
Result<std::string> histogram_to_json(const SphereSet& spheres, std::string_view attribute, int bins);

}  // namespace bihive
