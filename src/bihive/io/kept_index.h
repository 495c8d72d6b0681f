// The index of frames in a file beside that of the frames, so that the next program need not look for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/io/detect.h"
#include "bihive/io/frame_index.h"

namespace bihive {

/// The file of an index. Where any of it differs, the index is of no use.
struct IndexedFile {
  Format format;
  std::int64_t size = 0;        ///< bytes
  std::int64_t written_ns = 0;  ///< when it was written last
};

/// FILE.bihive-index
std::string kept_index_path(const std::string& path);

/// The bytes of an index: a mark, the file it belongs to, the places in 64 bits, little endian, and a sum of all.
std::string encode_index(const FrameIndex& index, const IndexedFile& file);

/// Nothing: damaged, of another version, or of another file. Places are checked: they lie in the file, one behind the
/// other.
std::optional<FrameIndex> decode_index(std::string_view bytes, const IndexedFile& file);

}  // namespace bihive
