// Finds the format of a file: by its content, then by its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

enum class Format { pdb, mmcif, xyz, lammps_dump, csv, npy };

/// The format of unpacked bytes. The content decides; if it fits several formats, the ending of the name decides
/// (without .gz).
std::optional<Format> detect_format(std::string_view bytes, const std::string& name);

/// The known formats and their endings, for messages.
std::string known_formats();

}  // namespace bihive
