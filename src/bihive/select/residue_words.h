// The words of selections that mean kinds of residues: protein, nucleic, water, ion, backbone.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// By a residue's name: those of gemmi's table [Wojdyr2022], and those that simulation programs use
/// (io/residue_class.h).
bool is_protein_residue(const std::string& residue);
bool is_nucleic_residue(const std::string& residue);
bool is_water_residue(const std::string& residue);
/// One atom or a small inorganic group that carries a charge: NA, CL, ZN, SO4, and the names of AMBER and CHARMM.
bool is_ion_residue(const std::string& residue);

/// The atoms of a chain's backbone by name: N, CA, C, O of a protein; P, O5', C5', C4', C3', O3' of a nucleic acid.
bool is_protein_backbone(std::string_view atom);
bool is_nucleic_backbone(std::string_view atom);

}  // namespace bihive
