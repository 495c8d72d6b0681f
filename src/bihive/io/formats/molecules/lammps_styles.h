// The columns of LAMMPS' atom styles in data files [LAMMPS-data].
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/io/text/sphere_table.h"

namespace bihive {

/// What the lines of atoms have in common.
struct LammpsAtomLines {
  std::int64_t fields = 0;     ///< of the first
  bool third_is_type = true;   ///< the second fields are whole numbers, the third ones types
  bool ends_in_flags = false;  ///< the last three fields are whole numbers without a decimal point, as image flags are
};

/// Looks at the scanner's line and those behind it, `most` lines at most.
LammpsAtomLines look_at_atom_lines(TextScanner scanner, std::int64_t most,
                                   const std::function<bool(std::string_view)>& is_type);

/// The columns of a style by its name ("full", "hybrid sphere dipole"), without image flags. Nothing: it is unknown.
/// Styles whose number of columns depends on the simulation, or on LAMMPS' version, take it from the lines.
std::optional<std::vector<TableColumn>> lammps_columns(std::string_view style, const LammpsAtomLines& lines);

/// Whether only all lines together tell the columns of the style.
bool needs_all_lines(std::string_view style);

/// "amoeba, angle, ..."
std::string lammps_style_names();

/// The style that lines of atoms without a stated style fit, by the number of their columns; empty: none, or several.
std::string guess_lammps_style(const LammpsAtomLines& lines);

}  // namespace bihive
