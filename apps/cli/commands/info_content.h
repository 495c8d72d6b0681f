// Chains, residues and molecules of an input, for `bihive info`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive::cli {

struct CountedName {
  std::string name;
  std::int64_t residues = 0, spheres = 0;
};

/// Residues are runs of spheres that agree in chain, number, insertion code and name.
struct InfoContent {
  std::vector<CountedName> chains;        ///< in order of appearance
  std::vector<CountedName> kinds;         ///< "protein", "nucleic", "water", "ion", "ligand": those that there are
  std::vector<CountedName> ligands;       ///< by name of the residue, in order of appearance; ions too
  std::optional<std::int64_t> molecules;  ///< distinct numbers of a column mol
};
InfoContent content_of(const SphereSet& spheres);

/// The bonds that `--bonds auto` draws, by origin.
struct InfoBonds {
  std::int64_t stated = 0;
  /// "single", "double", "triple" and "aromatic" with their counts: those that there are.
  std::vector<std::pair<std::string, std::int64_t>> orders;
  /// Those that are not stated. Nothing: the file states all or no element, or there are more than 2^20 spheres.
  std::optional<std::int64_t> by_distance;
};
InfoBonds bonds_of(const SphereSet& spheres);

}  // namespace bihive::cli
