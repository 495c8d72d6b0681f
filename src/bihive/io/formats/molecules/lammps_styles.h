// The columns of LAMMPS' atom styles in data files [LAMMPS-data].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/io/text/sphere_table.h"

namespace bihive {

/// The columns of a style by its name ("full", "hybrid sphere dipole"), without image flags; nothing: it is unknown.
std::optional<std::vector<TableColumn>> lammps_columns(std::string_view style);

/// The style that a first line of atoms without a stated style fits, by the number of its columns; empty: none, or
/// several. `types` is the number of atom types.
std::string guess_lammps_style(std::string_view line, std::int64_t types);

/// Whether the last three of the line's fields are whole numbers without a decimal point, as image flags are.
bool ends_in_image_flags(std::string_view line);

}  // namespace bihive
