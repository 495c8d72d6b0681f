// Files that may be packed: whether they are, and how they begin.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// Whether the bytes are packed with gzip, zstd, xz or bzip2, or are BinaryCIF.
bool is_packed(std::string_view bytes);

/// The first 64 kB of what a file holds, unpacked; fewer if it holds fewer. It shows the format. Errors: as
/// read_spheres().
Result<std::string> read_head(const std::string& path);

}  // namespace bihive
