// Formats that bihive knows and does not read: a message that names the format and what to convert it with.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

struct ForeignFormat {
  std::string name;    ///< "a GROMACS structure (GRO)"
  std::string advice;  ///< "convert it with 'gmx editconf -f FILE.gro -o OUT.pdb'"
};

/// The format of unpacked bytes, by their content alone; nothing if it is none of those known.
std::optional<ForeignFormat> foreign_by_content(std::string_view bytes);

/// By the ending of the name (without .gz).
std::optional<ForeignFormat> foreign_by_name(const std::string& name);

}  // namespace bihive
