// Formats of molecules with their bonds: SDF and MOL2. For write_spheres() alone.
#pragma once

#include <string_view>

#include "bihive/io/write_spheres.h"

namespace bihive {

/// A record of SDF: of version 2000 if it has up to 999 atoms and bonds and its columns hold all coordinates, else of
/// version 3000.
WrittenSpheres write_sdf(const SphereSet& spheres, std::string_view title);

WrittenSpheres write_mol2(const SphereSet& spheres, std::string_view title);

}  // namespace bihive
