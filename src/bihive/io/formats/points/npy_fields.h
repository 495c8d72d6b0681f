// The fields of NumPy's structured arrays, as arrays by their names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/formats/points/named_arrays.h"
#include "bihive/io/formats/points/npy_header.h"

namespace bihive {

/// The fields of numbers and of booleans, a row for each entry of the array. `bytes`: the whole file. The names of all
/// other fields are added to `left_out`, a blank before each. Errors: a type whose length is unknown (objects), a shape
/// that does not agree with the size of the file, too little memory.
Result<std::vector<NamedArray>> npy_fields(std::string_view bytes, const NpyHeader& header, const std::string& file,
                                           std::string& left_out);

}  // namespace bihive
