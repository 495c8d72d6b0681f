#include "bihive/select/residue_words.h"

#include <algorithm>
#include <gemmi/resinfo.hpp>
#include <iterator>

#include "bihive/io/residue_class.h"

namespace bihive {
namespace {

// Of selections alone: residues that are one of two amino acids.
constexpr std::string_view kEitherProtein[] = {"ASX", "GLX"};
constexpr std::string_view kMoreWater[] = {"OH2"};
// Monatomic ions of the PDB's chemical components, their names in AMBER, CHARMM and GROMACS, and common groups.
constexpr std::string_view kIons[] = {
    "LI",  "NA",  "K",   "RB",  "CS",  "MG",  "CA",  "SR",  "BA",  "MN",  "MN3", "FE",  "FE2", "CO",
    "3CO", "NI",  "CU",  "CU1", "ZN",  "CD",  "HG",  "AG",  "AU",  "PT",  "PB",  "AL",  "TL",  "LA",
    "CE",  "SM",  "EU",  "GD",  "TB",  "YB",  "LU",  "U1",  "F",   "CL",  "BR",  "IOD", "SO4", "PO4",
    "NO3", "CO3", "NH4", "Na+", "K+",  "Cl-", "Br-", "I-",  "F-",  "Li+", "Rb+", "Cs+", "NA+", "CL-",
    "MG2", "CA2", "ZN2", "SOD", "POT", "CLA", "CAL", "CES", "LIT", "RUB", "BAR", "CAD", "CIO", "IB"};
constexpr std::string_view kProteinBackbone[] = {"N", "CA", "C", "O"};
constexpr std::string_view kNucleicBackbone[] = {"P", "O5'", "C5'", "C4'", "C3'", "O3'"};

template <class List>
bool holds(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

bool is_protein_residue(const std::string& residue) {
  const ResidueClass known = class_of_residue(residue);
  return known == ResidueClass::protein || known == ResidueClass::modified_protein || holds(kEitherProtein, residue) ||
         gemmi::find_tabulated_residue(residue).is_amino_acid();
}

bool is_nucleic_residue(const std::string& residue) {
  const ResidueClass known = class_of_residue(residue);
  return known == ResidueClass::nucleic || known == ResidueClass::modified_nucleic;
}

bool is_water_residue(const std::string& residue) {
  return class_of_residue(residue) == ResidueClass::water || holds(kMoreWater, residue);
}

bool is_ion_residue(const std::string& residue) {
  return holds(kIons, residue);
}

bool is_protein_backbone(std::string_view atom) {
  return holds(kProteinBackbone, atom);
}

bool is_nucleic_backbone(std::string_view atom) {
  return holds(kNucleicBackbone, atom);
}

}  // namespace bihive
