// Classifies residues by name: names of the Protein Data Bank and of force fields.
#pragma once

#include <string_view>

namespace bihive {

/// bead: of a coarse-grained model. modified_*: not one of the standard residues.
enum class ResidueClass { unknown, protein, nucleic, water, sugar, modified_protein, modified_nucleic, bead };

constexpr bool is_modified(ResidueClass one) {
  return one == ResidueClass::modified_protein || one == ResidueClass::modified_nucleic;
}

/// Upper and lower case count the same. UNK, which is any molecule in many programs, is unknown.
ResidueClass class_of_residue(std::string_view name);

}  // namespace bihive
