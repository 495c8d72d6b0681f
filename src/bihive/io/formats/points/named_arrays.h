// Spheres from arrays under names: columns of one dimension, places and vectors of two. NPZ and HDF5 share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// One or two dimensions, row after row.
struct NamedArray {
  std::string name;
  std::vector<std::int64_t> shape;
  std::vector<double> values;

  std::int64_t rows() const { return shape.empty() ? 1 : shape[0]; }
  std::size_t columns() const { return shape.size() == 2 ? static_cast<std::size_t>(shape[1]) : 1; }
};

/// Of one file.
struct NamedArrays {
  std::string format;  ///< for messages and the spheres: "NPZ"
  std::vector<NamedArray> arrays;
  std::string left_out;  ///< the names of those that are no numbers, a blank before each
  std::string advice;    ///< how places are named when such a file is written
};

/// The array of the chosen x, one named x, an array of places (positions, xyz, ...), or the only array tells the number
/// of rows; others of as many rows are columns.
Result<RawSpheres> spheres_of_named_arrays(const NamedArrays& all, const std::string& file, const ColumnChoice& choice);

}  // namespace bihive
