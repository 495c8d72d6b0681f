#include "bihive/io/npy.h"
#include "bihive/io/readers.h"

namespace bihive {

Result<RawSpheres> read_npy(std::string_view bytes, const std::string& file, std::int64_t frame) {
  Result<NpyArray> array = parse_npy(bytes, file);
  if (!array) return array.error();
  if (array->shape.size() != 2 || (array->shape[1] != 3 && array->shape[1] != 4)) {
    const std::string shape = array->shape.size() == 2
                                  ? std::to_string(array->shape[0]) + ", " + std::to_string(array->shape[1])
                                  : std::to_string(array->shape[0]) + ",";
    return Error{"the NPY array's shape is (" + shape + "); expected (n, 3) for x, y, z or (n, 4) for x, y, z, radius",
                 file, 0, 0, ""};
  }
  if (frame != 0) return no_such_frame(file, frame, 1);

  // Take the columns apart.
  const auto columns = static_cast<std::size_t>(array->shape[1]);
  RawSpheres spheres;
  spheres.format = "NPY";
  std::vector<double>* const targets[4] = {&spheres.x, &spheres.y, &spheres.z, &spheres.r};
  const char* const names[4] = {"x", "y", "z", "the radius"};
  for (std::size_t column = 0; column < columns; ++column) {
    targets[column]->reserve(static_cast<std::size_t>(array->shape[0]));
    for (std::size_t i = column; i < array->values.size(); i += columns) {
      const double value = array->values[i];
      if (const char* fault = column < 3 ? coordinate_fault(value) : radius_fault(value))
        return Error{"row " + std::to_string(i / columns) + " (from 0): " + names[column] + " " + fault + ": " +
                         std::to_string(value),
                     file, 0, 0, ""};
      targets[column]->push_back(value);
    }
  }
  spheres.rules.push_back("NPY " + array->dtype + ": columns x, y, z" +
                          (columns == 4 ? std::string(", radius") : std::string()));
  return spheres;
}

}  // namespace bihive
