#include "bihive/select/residue_words.h"

#include <algorithm>
#include <gemmi/resinfo.hpp>
#include <iterator>

namespace bihive {
namespace {

// States of protonation and ends of chains in the files of AMBER and CHARMM.
constexpr std::string_view kMoreProtein[] = {"HID", "HIE", "HIP", "HSD", "HSE", "HSP", "CYX", "CYM",
                                             "ASH", "GLH", "LYN", "ASX", "GLX", "ACE", "NME", "NMA"};
constexpr std::string_view kMoreNucleic[] = {"DA5", "DC5", "DG5", "DT5", "DA3", "DC3", "DG3", "DT3", "RA",
                                             "RC",  "RG",  "RU",  "ADE", "CYT", "GUA", "THY", "URA"};
constexpr std::string_view kMoreWater[] = {"WAT", "H2O", "TIP", "TIP2", "TIP3", "TIP4", "TP3",
                                           "T3P", "T4P", "SOL", "SPC",  "SPCE", "OH2",  "DOD"};
constexpr std::string_view kProteinBackbone[] = {"N", "CA", "C", "O"};
constexpr std::string_view kNucleicBackbone[] = {"P", "O5'", "C5'", "C4'", "C3'", "O3'"};

template <class List>
bool holds(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

bool is_protein_residue(const std::string& residue) {
  return gemmi::find_tabulated_residue(residue).is_amino_acid() || holds(kMoreProtein, residue);
}

bool is_nucleic_residue(const std::string& residue) {
  return gemmi::find_tabulated_residue(residue).is_nucleic_acid() || holds(kMoreNucleic, residue);
}

bool is_water_residue(const std::string& residue) {
  return gemmi::find_tabulated_residue(residue).is_water() || holds(kMoreWater, residue);
}

bool is_protein_backbone(std::string_view atom) {
  return holds(kProteinBackbone, atom);
}

bool is_nucleic_backbone(std::string_view atom) {
  return holds(kNucleicBackbone, atom);
}

}  // namespace bihive
