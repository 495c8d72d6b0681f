// Groups of spheres for bihive measure: by the values of a column, or by selections.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"

namespace bihive::cli {

struct SphereGroups {
  std::vector<std::string> names;
  std::vector<std::int32_t> group_of_sphere;  ///< -1: in none
};

/// A group for each value of a column, in the order in which they occur. Fails where there is no such column. `mask`: a
/// byte for each sphere, 0 for those that are in no group; or null.
SphereGroups groups_by_column(const SphereSet& spheres, const std::string& column, const std::uint8_t* mask);

/// A group for each selection. Fails where one selects nothing, or two the same sphere.
SphereGroups groups_by_selections(const SphereSet& spheres, const std::vector<std::string>& expressions,
                                  const std::uint8_t* mask);

}  // namespace bihive::cli
