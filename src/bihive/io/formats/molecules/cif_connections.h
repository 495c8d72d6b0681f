// The bonds of mmCIF files: _struct_conn names those that residues do not have of themselves, _chem_comp_bond those of
// each kind of residue.
#pragma once

#include <string>
#include <vector>

#include "bihive/io/formats/molecules/cif_rows.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Adds the bonds of the rows of _struct_conn whose type is covalent, a disulfide or a metal coordination. `marks`: the
/// alternate location of each sphere, 0: none. An end is the sphere of that chain, residue, name and mark; a bond to
/// none, to several, or to a symmetry mate counts as none.
void add_connections(const std::vector<CifRow>& rows, const std::string& marks, RawSpheres& spheres);

/// Adds the bonds of the rows of _chem_comp_bond within each residue of their component, between atoms of the same
/// alternate location, or of none.
void add_component_bonds(const std::vector<CifRow>& rows, const std::string& marks, RawSpheres& spheres);

/// The order that value_order and pdbx_aromatic_flag state.
BondOrder order_of_component_bond(const std::string& value_order, bool is_aromatic);

}  // namespace bihive
