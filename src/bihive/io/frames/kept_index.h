// The index of frames in a file beside that of the frames, so that the next program need not look for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/io/frames/frame_index.h"
#include "bihive/io/packed/random_file.h"

namespace bihive {

/// The file of an index. Where any of it differs, the index is of no use. The stamp holds what nobody can choose: an
/// index that came with the file from elsewhere, in an archive for example, does not fit.
struct IndexedFile {
  std::int64_t format;    ///< Format::index_number
  std::int64_t size = 0;  ///< bytes
  FileStamp stamp;
};

/// FILE.bihive-index
std::string kept_index_path(const std::string& path);

/// The bytes of an index: a mark, the file it belongs to, the places in 64 bits, little endian, and a sum of all.
std::string encode_index(const FrameIndex& index, const IndexedFile& file);

/// The bytes at kept_index_path(), if an index lies there that this user made: a file itself and no link, of this user
/// or of root, that not everybody may write. Nothing: there is none. Error: it is not to be trusted, or not readable.
Result<std::optional<std::string>> read_kept_index(const std::string& path);

/// Whether the bytes begin as those of an index of any version.
bool looks_like_index(std::string_view bytes);

/// Nothing: damaged, of another version, or of another file. Places are checked: they lie in the file, one after the
/// other, and no frame is empty.
std::optional<FrameIndex> decode_index(std::string_view bytes, const IndexedFile& file);

}  // namespace bihive
