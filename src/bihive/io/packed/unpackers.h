// The ways in which files are packed, each undone piece by piece (unpack.h).
#pragma once

#include <cstddef>
#include <string>

#include "bihive/io/packed/unpack.h"

namespace bihive {

/// Unpacked bytes that are given on at a time.
constexpr std::size_t kUnpackedPieceBytes = std::size_t{1} << 18;

inline Error packed_fault(const std::string& what, const std::string& name) {
  return {what, name, 0, 0, ""};
}

/// As unpack_pieces(). A build without the library returns an error.
Status unxz_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink);
Status unbzip2_pieces(const PieceSource& source, const std::string& name, const PieceSink& sink);

}  // namespace bihive
