#include "bihive/select/residues.h"

#include "bihive/select/attribute_names.h"

namespace bihive {

Result<std::vector<std::int32_t>> residue_of_spheres(const SphereSet& spheres) {
  const FoundAttribute number = find_attribute(spheres, "resid");
  if (!number.has_numbers())
    return Error{"residues need their numbers, and the input has no 'resid'", "", 0, 0,
                 "PDB, mmCIF and GRO files have it; 'same mol as' takes a column mol"};
  std::vector<const NamedTexts*> texts;
  for (const char* const name : {"chain", "entity", "insertion", "resname"})
    if (const NamedTexts* const column = spheres.attributes().find_texts(name)) texts.push_back(column);
  const auto same_residue = [&](std::size_t i) {
    for (const NamedTexts* const column : texts)
      if (column->text_of_sphere[i] != column->text_of_sphere[i - 1]) return false;
    const auto id = static_cast<std::int64_t>(i);
    return number.number_of(spheres, id) == number.number_of(spheres, id - 1);
  };
  std::vector<std::int32_t> residues(static_cast<std::size_t>(spheres.size()));
  for (std::size_t i = 1; i < residues.size(); ++i) residues[i] = residues[i - 1] + (same_residue(i) ? 0 : 1);
  return residues;
}

}  // namespace bihive
