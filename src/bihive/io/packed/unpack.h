// Undoes gzip, zstd, xz, bzip2 and BinaryCIF piece by piece, so that neither side must be in memory as a whole.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "bihive/base/result.h"

namespace bihive {

/// binary_cif becomes the text of mmCIF, also inside of the others.
enum class Packing { none, gzip, zstd, xz, bzip2, binary_cif };

/// Bytes that are enough for packing_of().
constexpr std::size_t kPackingMarkBytes = 10;
Packing packing_of(std::string_view first_bytes);

/// The endings of packed files' names: ".gz", ".zst", ".xz" or ".bz2" at the end of the name in lower case; else empty.
std::string_view packed_ending(std::string_view name);

/// The next bytes, which live until the next call; none: the end.
using PieceSource = std::function<Result<std::string_view>()>;
/// Takes the next unpacked bytes; false: it needs no more.
using PieceSink = std::function<Result<bool>(std::string_view)>;

/// All members of a gzip file, frames of a zstd file, or streams of the others, in a row; zeros behind the last member
/// of gzip are padding. Errors: cut or damaged data; those of source and sink; a build without the library. `name` is
/// for messages. A piece has at most a gigabyte.
Status unpack_pieces(Packing packing, const PieceSource& source, const std::string& name, const PieceSink& sink);

/// The bytes themselves, or what they hold if they are packed. Errors: more than the memory holds, too.
Result<std::string> unpack_bytes(std::string_view bytes, const std::string& name);

}  // namespace bihive
