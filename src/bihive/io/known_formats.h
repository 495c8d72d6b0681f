// The names of the formats that bihive reads, for help and messages.
#pragma once

#include <string>

namespace bihive {

enum class FormatsThat { hold_spheres, have_columns, are_trajectories };

/// "CSV, GSD, HDF5 and PDB": in alphabetical order.
std::string names_of_formats(FormatsThat which);

}  // namespace bihive
