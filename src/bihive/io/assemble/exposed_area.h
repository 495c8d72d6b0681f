// The column exposed_area: how much of each sphere's surface a probe can reach.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Adds the column that ReadOptions::exposed_area asks for, in world units squared, of the set as stored. Without it
/// nothing happens. Errors: `attributes` has a column of that name; those of measure_union()
/// (measure/union_measures.h).
Status add_exposed_area(const SphereSet& spheres, const ReadOptions& options, SphereAttributes& attributes);

}  // namespace bihive
