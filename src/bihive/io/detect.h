// Which format a file has: by what is in it, then by its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

enum class Format { pdb, mmcif, xyz, lammps_dump, csv, npy };

/// The format of unpacked bytes. The content decides; where it could be anything, the name's ending does (without .gz).
std::optional<Format> detect_format(std::string_view bytes, const std::string& name);

/// The formats that are known and the endings that stand for them, for messages.
std::string known_formats();

}  // namespace bihive
