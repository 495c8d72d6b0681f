// How much of the surface of groups of spheres is buried where they meet: interfaces of chains, of a ligand and its
// pocket.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/measure/union_measures.h"

namespace bihive {

/// In world units. k groups.
struct BuriedAreas {
  std::vector<double> alone;  ///< k: the area of each group without all other spheres
  /// k * k, row by row: the area of a group alone plus that of another alone less that of both, which counts both sides
  /// of their interface. Exactly 0 on the diagonal; 0 for groups that do not meet, but for rounding.
  std::vector<double> buried;
  double error = 0;  ///< bounds what rounding adds to any of them
};

/// `group_of_sphere`: for each sphere of the set, by id, the number of its group from 0 on, or -1: it is in none. Of
/// the options, probe, mask, threads and periodic count. The cost is that of the unions of each group, and of each two
/// groups whose boxes meet. Errors: as measure_union(), and a list of another length.
Result<BuriedAreas> buried_areas(const SphereSet& spheres, const std::vector<std::int32_t>& group_of_sphere,
                                 const MeasureOptions& options = {});

}  // namespace bihive
