// Reads and writes NumPy's .npy files of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

/// Any float32, float64 or integer array of one or two dimensions, brought into C order and binary64 (float32 is exact
/// in it).
struct NpyArray {
  std::vector<std::int64_t> shape;
  std::string dtype;  ///< as in the file: "<f4", ">f8", ...
  std::vector<double> values;
};

/// Little or big endian, C or Fortran order, format versions 1 to 3. `name` is for messages.
Result<NpyArray> parse_npy(std::string_view bytes, const std::string& name);

/// The bytes of a version 1.0 little-endian C-order file. `shape` must multiply to values.size().
std::string npy_bytes(const std::vector<float>& values, const std::vector<std::int64_t>& shape);
std::string npy_bytes(const std::vector<double>& values, const std::vector<std::int64_t>& shape);
std::string npy_bytes(const std::vector<std::int64_t>& values, const std::vector<std::int64_t>& shape);

}  // namespace bihive
