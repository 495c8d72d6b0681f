// NPZ of NumPy: a zip archive of arrays. Arrays of as many rows are columns; an array of three or four columns that is
// alone, or is named so, gives the places.
#include <algorithm>

#include "bihive/io/npy.h"
#include "bihive/io/readers.h"
#include "bihive/io/sphere_table.h"
#include "bihive/io/text_scanner.h"
#include "bihive/io/zip_file.h"

namespace bihive {
namespace {

struct NamedArray {
  std::string name;
  NpyArray array;
  std::size_t columns() const { return array.shape.size() == 2 ? static_cast<std::size_t>(array.shape[1]) : 1; }
};

bool names_places(const std::string& name) {
  const std::string lower = lower_case(name);
  for (const char* const one :
       {"positions", "position", "pos", "xyz", "coords", "coordinates", "centers", "centres", "points"})
    if (lower == one) return true;
  return false;
}

}  // namespace

Result<RawSpheres> read_npz(std::string_view bytes, const std::string& file, std::int64_t frame) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  const auto bad = [&file](const std::string& what, const std::string& hint = "") {
    return Error{what, file, 0, 0, hint};
  };
  const Result<std::vector<ZipMember>> members = zip_members(bytes, file);
  if (!members) return members.error();

  // Read the arrays of numbers.
  std::vector<NamedArray> arrays;
  std::string left_out;
  for (const ZipMember& member : *members) {
    constexpr std::string_view ending = ".npy";
    const std::string_view name = member.name;
    if (name.size() <= ending.size() || name.substr(name.size() - ending.size()) != ending) continue;
    const std::string bare(name.substr(0, name.size() - ending.size()));
    for (const NamedArray& other : arrays)
      if (other.name == bare) return bad("the array " + quote(bare) + " comes twice");
    Result<std::string> unpacked = unpack_member(member, file);
    if (!unpacked) return unpacked.error();
    Result<NpyArray> array = parse_npy(*unpacked, file);
    if (!array)
      left_out += " " + bare;
    else
      arrays.push_back({bare, std::move(*array)});
  }

  // The places say how many rows the columns have: one named x, an array of places, or the only array.
  const auto is_places = [&](const NamedArray& one) {
    return (one.columns() == 3 || one.columns() == 4) && one.array.shape.size() == 2 &&
           (names_places(one.name) || arrays.size() == 1);
  };
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const NamedArray& one) { return lower_case(one.name) == "x" || is_places(one); });
  if (found == arrays.end()) {
    std::string names;
    for (const NamedArray& one : arrays)
      if (names.size() < 200) names += (names.empty() ? "" : " ") + one.name;
    return bad("no array of the NPZ file holds the places: it has " + (names.empty() ? "none of numbers" : names),
               "name them when they are written: numpy.savez(FILE, x=..., y=..., z=..., radius=...) or positions=...");
  }
  const std::int64_t rows = found->array.shape[0];

  // Each column of each array with so many rows.
  std::vector<TableColumn> columns;
  std::vector<std::pair<const NamedArray*, std::size_t>> sources;
  bool has_places = false;
  for (const NamedArray& one : arrays) {
    if (one.array.shape[0] != rows || one.columns() == 0 ||
        one.columns() + columns.size() > SphereTable::kMostColumns) {
      left_out += " " + one.name;
      continue;
    }
    const bool places = is_places(one) && !has_places;
    has_places = has_places || places;
    constexpr ColumnRole roles[4] = {ColumnRole::x, ColumnRole::y, ColumnRole::z, ColumnRole::radius};
    const char* const names[4] = {"x", "y", "z", "radius"};
    for (std::size_t i = 0; i < one.columns(); ++i) {
      sources.emplace_back(&one, i);
      if (places) {
        columns.push_back({names[i], roles[i]});
      } else if (one.array.shape.size() == 1) {
        columns.push_back({one.name, lower_case(one.name) == "r" ? ColumnRole::radius : usual_role(one.name)});
      } else {
        columns.push_back({one.name + "_" + std::to_string(i + 1), ColumnRole::number});
      }
    }
  }
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) return bad(fault);
  std::vector<double> row(columns.size());
  table.reserve(rows, rows * static_cast<std::int64_t>(2 * columns.size()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column)
      row[column] = sources[column].first->array.values[i * sources[column].first->columns() + sources[column].second];
    if (const std::string fault = table.add_numbers(row.data()); !fault.empty())
      return bad("row " + std::to_string(i) + " (from 0): " + fault);
  }
  const std::string names = table.column_names();
  RawSpheres spheres = std::move(table).take();
  spheres.format = "NPZ";
  spheres.rules.insert(spheres.rules.begin(), "arrays as columns: " + names);
  if (!left_out.empty())
    spheres.rules.push_back("arrays of another length or kind are left out:" + printable(left_out));
  return spheres;
}

}  // namespace bihive
