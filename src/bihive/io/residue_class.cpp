#include "bihive/io/residue_class.h"

#include <algorithm>
#include <gemmi/resinfo.hpp>
#include <iterator>
#include <string>

#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

template <class List>
bool holds_name(const List& sorted, std::string_view name) {
  return std::binary_search(std::begin(sorted), std::end(sorted), name);
}

// Names that force fields give to standard residues; gemmi's table has those of the Protein Data Bank. All lists are
// sorted.
constexpr std::string_view kProteinNames[] = {
    "ACE",  "ARGN", "ASH", "ASPH", "ASPP", "CT3",  "CYM",  "CYN",  "CYS1", "CYS2", "CYSH", "CYSP", "CYX",  "FOR", "GLH",
    "GLUH", "GLUP", "HID", "HIE",  "HIP",  "HIS1", "HIS2", "HISA", "HISB", "HISD", "HISE", "HISH", "HISP", "HSC", "HSD",
    "HSE",  "HSP",  "HYP", "LSN",  "LYN",  "LYSH", "NAC",  "NH2",  "NHE",  "NLE",  "NMA",  "NME",  "NTER", "QLN"};
constexpr std::string_view kNucleicNames[] = {"ADE", "CYT", "DAN", "DCN", "DGN", "DTN", "GUA", "RA", "RAN",
                                              "RC",  "RCN", "RG",  "RGN", "RU",  "RUN", "THY", "URA"};
constexpr std::string_view kWaterNames[] = {"DOD",  "H2O",  "HOH", "OPC",  "OPC3", "SOL", "SOLV", "SPC",  "SPCE",
                                            "T3H",  "T3P",  "T4E", "T4P",  "T5P",  "TIP", "TIP2", "TIP3", "TIP4",
                                            "TIP5", "TIPS", "TP3", "TP3M", "TP4",  "TP5", "WAT"};

}  // namespace

ResidueClass class_of_residue(std::string_view residue) {
  std::string name = upper_case(residue);
  if (name == "UNK") return ResidueClass::unknown;  // any molecule, in many programs
  if (name == "W" || name == "WF" || name == "PW") return ResidueClass::bead;
  if (holds_name(kWaterNames, name)) return ResidueClass::water;
  if (holds_name(kProteinNames, name)) return ResidueClass::protein;
  if (holds_name(kNucleicNames, name)) return ResidueClass::nucleic;

  // Amber marks ends: NALA, CALA; DA5, RA3, DAN.
  const auto standard_class = [](const std::string& text) {
    const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(text);
    using Info = gemmi::ResidueInfo;
    if (info.kind == Info::HOH) return ResidueClass::water;
    if (info.is_nucleic_acid()) return info.is_standard() ? ResidueClass::nucleic : ResidueClass::modified_nucleic;
    if (info.is_amino_acid()) return info.is_standard() ? ResidueClass::protein : ResidueClass::modified_protein;
    if (info.kind == Info::PYR || info.kind == Info::KET) return ResidueClass::sugar;
    return ResidueClass::unknown;
  };
  if (name.size() == 4 && (name[0] == 'N' || name[0] == 'C')) {
    const std::string inner = name.substr(1);
    if (holds_name(kProteinNames, inner) || standard_class(inner) == ResidueClass::protein)
      return ResidueClass::protein;
  }
  if ((name.size() == 2 || name.size() == 3) && (name.back() == '3' || name.back() == '5')) {
    const std::string inner = name.substr(0, name.size() - 1);
    if (holds_name(kNucleicNames, inner) || standard_class(inner) == ResidueClass::nucleic)
      return ResidueClass::nucleic;
  }
  return standard_class(name);
}

}  // namespace bihive
