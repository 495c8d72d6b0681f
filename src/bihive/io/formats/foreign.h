// Formats that bihive knows and does not read, or not alone: for a message that names the format and what to do with
// it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

struct ForeignFormat {
  std::string name;          ///< "a run input file of GROMACS (TPR)"
  std::string advice;        ///< "convert it with 'gmx editconf -f FILE.tpr -o OUT.pdb'"
  bool needs_atoms = false;  ///< a trajectory that io/trajectory.h reads, beside a file of its atoms
};

/// The format of unpacked bytes, by their content alone; nothing if it is none of those known.
std::optional<ForeignFormat> foreign_by_content(std::string_view bytes);

/// By the ending of the name (without .gz).
std::optional<ForeignFormat> foreign_by_name(const std::string& name);

}  // namespace bihive
