// The layout of an NPY file of numbers: type, shape, and where the numbers begin.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/formats/points/npy_header.h"

namespace bihive {

/// Of one or two dimensions, and of no structured type.
struct NpyLayout : NpyHeader {
  NumberType type;
  std::uint64_t count = 0;  ///< of numbers
};

/// `head`: the bytes of the file from its beginning, with the header at least. Errors: no NPY header, a type or shape
/// that is not read, or a shape that does not agree with the size of the file.
Result<NpyLayout> npy_layout(std::string_view head, std::uint64_t file_bytes, const std::string& name);

}  // namespace bihive
