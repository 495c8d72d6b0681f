#include "bihive/io/arrays/array_file.h"

#include <algorithm>

namespace bihive {

const ArrayFacts* ArrayFile::find(std::string_view name) const {
  for (const ArrayFacts& array : arrays())
    if (array.name == name) return &array;
  return nullptr;
}

Result<std::vector<double>> ArrayFile::read_all(const ArrayFacts& array) const {
  return read(array, std::vector<std::int64_t>(array.lengths.size(), 0), array.lengths);
}

bool looks_like_hdf5(std::string_view first_bytes) {
  using namespace std::string_view_literals;
  return first_bytes.substr(0, 8) == "\x89HDF\r\n\x1a\n"sv;
}

bool looks_like_netcdf(std::string_view first_bytes) {
  return first_bytes.size() > 3 && first_bytes.substr(0, 3) == "CDF" &&
         (first_bytes[3] == 1 || first_bytes[3] == 2 || first_bytes[3] == 5);
}

}  // namespace bihive
