// The header of an NPY file: type, shape, and where the numbers begin.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/packed/binary_number.h"

namespace bihive {

struct NpyLayout {
  std::string dtype;
  NumberType type;
  bool fortran_order = false;
  std::vector<std::int64_t> shape;  ///< one or two sides
  std::size_t data_begin = 0;       ///< bytes before the first number
  std::uint64_t count = 0;          ///< of numbers
};

/// `head`: the bytes of the file from its beginning, with the header at least. Errors: no NPY header, a type or shape
/// that is not read, or a shape that does not agree with the size of the file.
Result<NpyLayout> npy_layout(std::string_view head, std::uint64_t file_bytes, const std::string& name);

}  // namespace bihive
