#include "bihive/io/formats/points/named_arrays.h"

#include <algorithm>
#include <utility>

#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

bool names_places(const std::string& name) {
  const std::string lower = lower_case(name);
  for (const char* const one :
       {"positions", "position", "pos", "xyz", "coords", "coordinates", "centers", "centres", "points"})
    if (lower == one) return true;
  return false;
}

bool is_places(const NamedArray& one, std::size_t of_arrays) {
  return (one.columns() == 3 || one.columns() == 4) && one.shape.size() == 2 &&
         (names_places(one.name) || of_arrays == 1);
}

constexpr ColumnRole kPlaceRoles[4] = {ColumnRole::x, ColumnRole::y, ColumnRole::z, ColumnRole::radius};
constexpr const char* kPlaceNames[4] = {"x", "y", "z", "radius"};

// Column i of the array, from 0.
TableColumn column_of(const NamedArray& one, std::size_t i, bool places) {
  if (places) return {kPlaceNames[i], kPlaceRoles[i]};
  if (one.shape.size() == 1) return {one.name, lower_case(one.name) == "r" ? ColumnRole::radius : usual_role(one.name)};
  return {one.name + "_" + std::to_string(i + 1), ColumnRole::number};
}

// The array that says how many rows the columns have, or null.
const NamedArray* measure(const std::vector<NamedArray>& arrays, const ColumnChoice& choice) {
  if (const auto x = choice.find("x"); x != choice.end()) {
    for (const NamedArray& one : arrays)
      for (std::size_t i = 0; i < std::min(one.columns(), SphereTable::kMostColumns); ++i)
        if (lower_case(column_of(one, i, false).name) == lower_case(x->second)) return &one;
  }
  for (const NamedArray& one : arrays)
    if (lower_case(one.name) == "x" || is_places(one, arrays.size())) return &one;
  // Columns that are chosen by their place alone.
  return chooses_places(choice) && !arrays.empty() ? &arrays.front() : nullptr;
}

}  // namespace

Result<RawSpheres> spheres_of_named_arrays(const NamedArrays& all, const std::string& file,
                                           const ColumnChoice& choice) {
  const auto bad = [&file](const std::string& what, const std::string& hint = "") {
    return Error{what, file, 0, 0, hint};
  };
  const std::vector<NamedArray>& arrays = all.arrays;
  std::string left_out = all.left_out;
  const NamedArray* const found = measure(arrays, choice);
  if (found == nullptr) {
    std::string names;
    for (const NamedArray& one : arrays)
      if (names.size() < 200) names += (names.empty() ? "" : " ") + printable(one.name);
    return bad("no array of the " + all.format + " file holds the places: it has " +
                   (names.empty() ? "none of numbers" : names),
               all.advice);
  }
  const std::int64_t rows = found->rows();

  // Each column of each array that has this number of rows.
  std::vector<TableColumn> columns;
  std::vector<std::pair<const NamedArray*, std::size_t>> sources;
  bool has_places = false;
  for (const NamedArray& one : arrays) {
    if (one.rows() != rows || one.columns() == 0 || one.columns() + columns.size() > SphereTable::kMostColumns) {
      left_out += " " + one.name;
      continue;
    }
    const bool places = is_places(one, arrays.size()) && !has_places;
    has_places = has_places || places;
    for (std::size_t i = 0; i < one.columns(); ++i) {
      sources.emplace_back(&one, i);
      columns.push_back(column_of(one, i, places));
    }
  }
  if (const std::string fault = choose_columns(choice, columns); !fault.empty()) return bad(fault);
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) return bad(fault, how_to_name_columns());
  std::vector<double> row(columns.size());
  table.reserve(rows, rows * static_cast<std::int64_t>(2 * columns.size()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column)
      row[column] = sources[column].first->values[i * sources[column].first->columns() + sources[column].second];
    if (const std::string fault = table.add_numbers(row.data()); !fault.empty())
      return bad("row " + std::to_string(i) + " (from 0): " + fault);
  }
  const std::string names = table.column_names();
  RawSpheres spheres = std::move(table).take();
  spheres.format = all.format;
  spheres.rules.insert(spheres.rules.begin(), "arrays as columns: " + names);
  if (!left_out.empty())
    spheres.rules.push_back("arrays of another length or kind are left out:" + printable(left_out));
  return spheres;
}

}  // namespace bihive
