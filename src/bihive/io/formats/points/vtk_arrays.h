// The arrays of VTK's files, which its old and its XML format share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Numbers of the points, `components` each, point after point.
struct PointArray {
  std::string name;
  std::int64_t components = 1;
  bool is_bytes = false;  ///< whole numbers: colours are then 0 to 255
  std::vector<double> values;
};

/// Spheres from the places (three numbers a point) and the arrays of as many points; others are left out. An array of
/// one component has the role of its name, colours have three or four, others become name_1, name_2, ... `left_out`:
/// names of arrays that were left out before, each in quotes with a blank before it.
Result<RawSpheres> spheres_of_arrays(const std::vector<double>& places, const std::vector<PointArray>& arrays,
                                     std::string left_out, const std::string& file, const ColumnChoice& choice);

}  // namespace bihive
