#include "bihive/base/memory.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/npy_fields.h"
#include "bihive/io/npy.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

// Columns that the user chooses.
Result<RawSpheres> columns_of_npy(const NpyArray& array, const std::string& file, const ColumnChoice& choice) {
  const auto bad = [&file](const std::string& what) { return Error{what, file, 0, 0, ""}; };
  const auto width = static_cast<std::size_t>(array.shape[1]);
  if (width > SphereTable::kMostColumns) return bad("expected at most 1000 columns but found " + std::to_string(width));
  std::vector<TableColumn> columns = columns_without_names(width);
  if (const std::string fault = choose_columns(choice, columns); !fault.empty()) return bad(fault);
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) return bad(fault);
  for (std::int64_t row = 0; row < array.shape[0]; ++row)
    if (const std::string fault = table.add_numbers(array.values.data() + static_cast<std::size_t>(row) * width);
        !fault.empty())
      return bad("row " + std::to_string(row) + " (from 0): " + fault);
  const std::string names = table.column_names();
  RawSpheres spheres = std::move(table).take();
  spheres.format = "NPY";
  spheres.rules.insert(spheres.rules.begin(), "NPY " + array.dtype + ": columns " + names);
  return spheres;
}

Result<RawSpheres> read_npy(std::string_view bytes, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  const Result<NpyHeader> header = npy_header(bytes, file);
  if (header && header->is_structured()) {
    if (frame != 0) return no_such_frame(file, frame, 1);
    NamedArrays all{"NPY", {}, "", "name the fields x, y, z and radius, or one of three columns positions"};
    Result<std::vector<NamedArray>> fields = npy_fields(bytes, *header, file, all.left_out);
    if (!fields) return fields.error();
    all.arrays = std::move(*fields);
    return spheres_of_named_arrays(all, file, choice);
  }
  Result<NpyArray> array = parse_npy(bytes, file);
  if (!array) return array.error();
  if (array->shape.size() == 2 && !choice.empty()) {
    if (frame != 0) return no_such_frame(file, frame, 1);
    return columns_of_npy(*array, file, choice);
  }
  if (array->shape.size() != 2 || (array->shape[1] != 3 && array->shape[1] != 4)) {
    const std::string shape = array->shape.size() == 2
                                  ? std::to_string(array->shape[0]) + ", " + std::to_string(array->shape[1])
                                  : std::to_string(array->shape[0]) + ",";
    return Error{
        "the NPY array's shape is (" + shape + "); expected (n, 3) for x, y, z or (n, 4) for x, y, z, radius", file, 0,
        0, array->shape.size() == 2 ? "say which columns these are: " + setting_name("columns") + " x=1,y=2,z=3" : ""};
  }
  if (frame != 0) return no_such_frame(file, frame, 1);

  // Take the columns apart.
  if (Status status =
          check_memory(static_cast<double>(array->values.size()) * sizeof(double), "the columns of the array",
                       static_cast<double>(array->values.size()) * sizeof(double));
      !status)
    return Error{status.error().message, file, 0, 0, ""};
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

}  // namespace

extern constexpr Format kNpy(
    "NPY", ".npy", Format::kColumns | Format::kParts,
    [](const FileHead& head) { return head.bytes.substr(0, 6) == "\x93NUMPY"; }, read_npy,
    "its mark | n x 3 or n x 4, float32 or float64, either byte order, C or Fortran order; fields of structured arrays "
    "| fourth column, else from "
    "distances");

}  // namespace bihive
