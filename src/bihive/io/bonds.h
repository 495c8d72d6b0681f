// Bonds between atoms: those that their file states, and those by distance.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"

namespace bihive {

/// The factor of covalent radii for bonds by distance, where nobody has chosen another one.
constexpr double kUsualBondReach = 1.2;

/// An Error where no element is known, so that there are no bonds by distance.
Status check_bond_elements(const SphereSet& spheres);

/// The pairs of atoms that are at most `reach` times the sum of their covalent radii apart [Cordero2008]; of coincident
/// atoms none. A hydrogen atom has one bond, to the nearest of these atoms that is not hydrogen, or else to the nearest
/// one that is; of equally near ones the first. Distances are in Å, and know the images of a periodic cell
/// (geometry/lattice.h): an atom may have several bonds to images of another one, and to its own. The ids of each pair
/// ascend, and so do the pairs. Spheres of unknown element have no bonds. Error: none has an element; a periodic cell
/// so small that an atom is near more than 1,000 of its images. The same on any number of threads (0: all).
Result<std::vector<ImagePair>> bonds_by_distance(const SphereSet& spheres, double reach, int threads = 0);

/// The bonds that the file states (SphereAttributes::bonds), each to the nearest image of its second atom in a periodic
/// cell. Order as above.
std::vector<ImagePair> bonds_of_file(const SphereSet& spheres);

/// Bonds::automatic: those of the file, and those by distance unless the file states all. An Error as
/// bonds_by_distance().
Result<std::vector<ImagePair>> automatic_bonds(const SphereSet& spheres, double reach, int threads = 0);

/// Makes automatic_bonds() what the spheres state (SphereAttributes::bonds), of several to images of an atom one. Those
/// by distance have no order, and there are none where no element is known. Returns the number of bonds that are new.
/// An Error: a cell as small as bonds_by_distance() says.
Result<std::int64_t> state_bonds(SphereSet& spheres, double reach, int threads = 0);

}  // namespace bihive
