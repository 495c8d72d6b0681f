// Which spheres belong to one residue.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// A number for each sphere, equal in each residue: a run of spheres of the input, one after the other, that agree in
/// chain, number, insertion code and name. Error: the set has no numbers of residues.
Result<std::vector<std::int32_t>> residue_of_spheres(const SphereSet& spheres);

}  // namespace bihive
