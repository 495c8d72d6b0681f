// The CSV files of bihive measure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/measure/buried_area.h"
#include "bihive/measure/union_measures.h"

namespace bihive::cli {

/// A row for each sphere that the mask keeps; null: each sphere of the set.
std::string table_of_spheres(const SphereSet& spheres, double probe, const UnionMeasures& measures,
                             const std::uint8_t* mask);
/// With the residues that line each, as "A:LEU23", if the set knows names and numbers of residues.
std::string table_of_cavities(const SphereSet& spheres, const std::vector<Cavity>& cavities);
std::string table_of_contacts(const std::vector<Contact>& contacts, bool periodic);
/// A matrix; on the diagonal the area of each group alone.
std::string table_of_buried(const std::vector<std::string>& groups, const BuriedAreas& areas);

}  // namespace bihive::cli
