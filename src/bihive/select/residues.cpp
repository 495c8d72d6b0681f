#include "bihive/select/residues.h"

#include "bihive/io/residue_runs.h"
#include "bihive/select/attribute_names.h"

namespace bihive {

Result<std::vector<std::int32_t>> residue_of_spheres(const SphereSet& spheres) {
  const FoundAttribute number = find_attribute(spheres, "resid");
  if (!number.has_numbers())
    return Error{"residues need their numbers, and the input has no 'resid'", "", 0, 0,
                 "PDB, mmCIF and GRO files have it; 'same mol as' takes a column mol"};
  return residue_runs(spheres.attributes(), static_cast<std::size_t>(spheres.size()),
                      [&](std::size_t i) { return number.number_of(spheres, static_cast<std::int64_t>(i)); });
}

}  // namespace bihive
