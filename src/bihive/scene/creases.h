// Lines between groups of spheres that touch: molecules, chains, types.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// A number for each sphere, at least 1, that is the same for spheres with the same value of the attribute (a name as
/// selections know it); 0 where a number is unknown. For SphereAttributes::crease. Error: the set lacks the attribute.
Result<std::vector<std::int32_t>> crease_groups(const SphereSet& spheres, const std::string& attribute);

}  // namespace bihive
