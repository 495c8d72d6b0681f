#include "bihive/io/formats/arrays/array_file.h"

#include <algorithm>

namespace bihive {

const ArrayFacts* ArrayFile::find(std::string_view name) const {
  for (const ArrayFacts& array : arrays())
    if (array.name == name) return &array;
  return nullptr;
}

const RefusedArray* ArrayFile::find_refused(std::string_view name, bool faults) const {
  const auto is_above = [](std::string_view group, std::string_view array) {
    return array.substr(0, group.size()) == group &&
           (group.empty() || array.size() == group.size() || array[group.size()] == '/');
  };
  for (const RefusedArray& array : refused())
    if ((array.is_fault || !faults) && (is_above(name, array.name) || is_above(array.name, name))) return &array;
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
