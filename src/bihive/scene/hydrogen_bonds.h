// Hydrogen bonds, by distance and angle.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/hydrogen_bonds.h"

namespace bihive {

/// With hydrogen atoms [Baker1984]: the farthest acceptor from the hydrogen atom in Å, and the cosine of the least
/// angle there, 120 degrees.
constexpr double kFarthestFromHydrogen = 2.5, kCosineAtHydrogen = -0.5;
/// Without them [McDonald1994]: the farthest acceptor from the donor in Å; no angle with another atom that is bonded to
/// the donor or the acceptor is below 90 degrees.
constexpr double kFarthestFromDonor = 3.5;

/// `from`: the hydrogen atom, or the donor. `image`: of the acceptor, in multiples of the cell's vectors.
struct HydrogenBond {
  std::int32_t from = 0, acceptor = 0;
  ImageCounts image{};
};

/// Between atoms of N, O and F that are neither bonded nor bonded to a common atom (bonds_by_distance()). A donor whose
/// residue has hydrogen atoms (the whole set, where residues are not known) donates those that are bonded to it;
/// another one is judged without them. In proteins and nucleic acids, atoms that can only donate do not accept, and of
/// those judged without hydrogen atoms, atoms that can only accept do not donate. Ascending by donor, hydrogen atom and
/// acceptor; a pair that is judged without hydrogen atoms is there once. Error: no element is known; as
/// bonds_by_distance().
Result<std::vector<HydrogenBond>> find_hydrogen_bonds(const SphereSet& spheres, int threads = 0);

/// Adds to Scene::sticks a dashed line for each. Returns their number. Errors: as find_hydrogen_bonds(),
/// StickSet::add() and check_sticks().
Result<std::int64_t> add_hydrogen_bonds(Scene& scene, const HydrogenBonds& bonds, int threads = 0);

}  // namespace bihive
