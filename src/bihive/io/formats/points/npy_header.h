// The text at the beginning of an NPY file [NumPy-format]: the type of its numbers, or the fields of a structured type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/packed/binary_number.h"

namespace bihive {

/// Of a structured type.
struct NpyField {
  std::string name;
  std::string dtype;                ///< "<f4"
  std::vector<std::int64_t> shape;  ///< of one entry; empty for a single number
};

struct NpyHeader {
  std::string dtype;             ///< empty if the type is structured
  std::vector<NpyField> fields;  ///< of a structured type
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
  std::size_t data_begin = 0;  ///< bytes before the first number

  bool is_structured() const { return !fields.empty(); }
};

/// From the first bytes of the file, with the header at least.
Result<NpyHeader> npy_header(std::string_view bytes, const std::string& name);

/// float32, float64 and whole numbers of 1 to 8 bytes; nothing for other types.
std::optional<NumberType> npy_number_type(std::string_view dtype);

/// "(2, 4)"
std::string npy_shape_text(const std::vector<std::int64_t>& shape);

}  // namespace bihive
