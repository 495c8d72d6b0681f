// The molecule that comes with the program.
#pragma once

#include <string_view>

namespace bihive {

/// The bytes of data/1hpv.pdb: HIV-1 protease with amprenavir, a PDB file of 1631 atoms [Kim1995].
std::string_view bundled_molecule();

}  // namespace bihive
