#include "bihive/io/formats/points/vtk_arrays.h"

#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

bool is_colour(const PointArray& array) {
  if (array.components != 3 && array.components != 4) return false;
  const std::string name = lower_case(array.name);
  for (const char* const one : {"rgb", "rgba", "color", "colour", "colors", "colours"})
    if (name == one) return true;
  return false;
}

void add_columns(const PointArray& array, bool colour, std::vector<TableColumn>& columns) {
  if (colour) {
    columns.push_back({"red", ColumnRole::red});
    columns.push_back({"green", ColumnRole::green});
    columns.push_back({"blue", ColumnRole::blue});
    if (array.components == 4) columns.push_back({array.name, ColumnRole::ignored});
  } else if (array.components == 1) {
    ColumnRole role = usual_role(array.name);
    if (role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z) role = ColumnRole::number;
    columns.push_back({array.name, role});
  } else {
    for (std::int64_t i = 1; i <= array.components; ++i)
      columns.push_back({array.name + "_" + std::to_string(i), ColumnRole::number});
  }
}

}  // namespace

Result<RawSpheres> spheres_of_arrays(const std::vector<double>& places, const std::vector<PointArray>& arrays,
                                     std::string left_out, const std::string& file, const ColumnChoice& choice) {
  const std::size_t points = places.size() / 3;
  std::vector<TableColumn> columns{{"x", ColumnRole::x}, {"y", ColumnRole::y}, {"z", ColumnRole::z}};
  std::vector<const PointArray*> taken;
  bool has_colour = false, colours_are_bytes = false;
  for (const PointArray& array : arrays) {
    const bool fits = array.components > 0 &&
                      array.components + static_cast<std::int64_t>(columns.size()) <=
                          static_cast<std::int64_t>(SphereTable::kMostColumns) &&
                      array.values.size() == points * static_cast<std::size_t>(array.components);
    if (!fits) {
      left_out += " " + quote(array.name);
      continue;
    }
    const bool colour = !has_colour && is_colour(array);
    if (colour) colours_are_bytes = array.is_bytes;
    has_colour = has_colour || colour;
    add_columns(array, colour, columns);
    taken.push_back(&array);
  }
  if (const std::string fault = choose_columns(choice, columns); !fault.empty()) return Error{fault, file, 0, 0, ""};
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) return Error{fault, file, 0, 0, ""};
  if (colours_are_bytes) table.colours_are_bytes();
  table.reserve(static_cast<std::int64_t>(points), static_cast<std::int64_t>(8 * columns.size() * points));
  std::vector<double> row;
  for (std::size_t i = 0; i < points; ++i) {
    row.assign(places.begin() + static_cast<std::ptrdiff_t>(3 * i),
               places.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    for (const PointArray* array : taken) {
      const auto begin = array->values.begin() + static_cast<std::ptrdiff_t>(i) * array->components;
      row.insert(row.end(), begin, begin + array->components);
    }
    if (const std::string fault = table.add_numbers(row.data()); !fault.empty())
      return Error{"point " + std::to_string(i) + " (from 0): " + fault, file, 0, 0, ""};
  }
  const std::string names = table.column_names();
  RawSpheres spheres = std::move(table).take();
  spheres.format = "VTK";
  spheres.rules.insert(spheres.rules.begin(), "points and their arrays: " + names);
  if (!left_out.empty()) spheres.rules.push_back("arrays of another length or kind are left out:" + left_out);
  spheres.rules.push_back("points alone are read; lines, faces and cells are left out");
  return spheres;
}

}  // namespace bihive
