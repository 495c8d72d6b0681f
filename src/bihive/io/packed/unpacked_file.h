// Opens a file for reading at any place, whatever it is: a plain file, one that is packed, a pipe.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/io/packed/random_file.h"

namespace bihive {

/// A plain file is read where it lies. A packed file is unpacked into memory, and from 32 MB on into a file without a
/// name in TMPDIR or /var/tmp (docs/decisions/0029-frames-of-packed-files.md). A pipe, and a file that states no size
/// (/proc), is read into memory. Errors: as read_file() and unpack_pieces(); no room.
Result<RandomFile> open_unpacked(const std::string& path);

}  // namespace bihive
