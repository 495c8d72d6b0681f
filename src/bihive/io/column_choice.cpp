#include "bihive/io/column_choice.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

ColumnRole role_of_part(const std::string& part) {
  return lower_case(part) == "r" ? ColumnRole::radius : usual_role(part);
}

// Two columns cannot say the same of a sphere.
bool say_the_same(ColumnRole a, ColumnRole b) {
  const auto one_for_both = [](ColumnRole role) {
    if (role == ColumnRole::diameter) return ColumnRole::radius;
    if (role == ColumnRole::transparency) return ColumnRole::opacity;
    if (role == ColumnRole::atomic_number) return ColumnRole::species;
    return role;
  };
  return a != ColumnRole::number && one_for_both(a) == one_for_both(b);
}

// The position of the column of that name (as it is written, else in upper or lower case), else of that number from 1.
// A message in `fault` if there is none, or more than one.
std::size_t position_of(const std::string& wanted, const std::string& part, const std::vector<TableColumn>& columns,
                        std::string& fault) {
  const auto same = [&](const TableColumn& column) { return column.name == wanted; };
  const auto alike = [&](const TableColumn& column) { return lower_case(column.name) == lower_case(wanted); };
  const auto count = std::count_if(columns.begin(), columns.end(), same);
  if (count == 1) return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), same) - columns.begin());
  const auto alike_count = std::count_if(columns.begin(), columns.end(), alike);
  if (alike_count == 1)
    return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), alike) - columns.begin());
  if (alike_count > 1) {
    fault =
        "there are " + std::to_string(alike_count) + " columns " + quote(wanted) + ": take one by its place, from 1";
    return 0;
  }
  const auto place = parse_int(wanted);
  if (place && *place >= 1 && *place <= static_cast<std::int64_t>(columns.size()))
    return static_cast<std::size_t>(*place - 1);
  constexpr std::size_t kReadable = 200;
  std::string names;
  for (const TableColumn& column : columns)
    if (names.size() < kReadable) names += " " + printable(column.name);
  fault = "there is no column " + quote(wanted) + " for " + printable(part) + "; there are " +
          std::to_string(columns.size()) + ":" + names;
  return 0;
}

}  // namespace

std::string choose_columns(const ColumnChoice& choice, std::vector<TableColumn>& columns) {
  // Find all of them before a name changes.
  std::vector<std::pair<std::size_t, std::string>> chosen;
  for (const auto& [part, wanted] : choice) {
    std::string fault;
    const std::size_t position = position_of(wanted, part, columns, fault);
    if (!fault.empty()) return fault;
    for (const auto& [other, part_of_other] : chosen)
      if (other == position)
        return "the column " + quote(columns[position].name) + " is asked for as " + printable(part_of_other) +
               " and as " + printable(part);
    chosen.emplace_back(position, part);
  }

  // A column that was taken for one of these parts becomes one of any numbers.
  for (const auto& [position, part] : chosen)
    for (TableColumn& column : columns)
      if (say_the_same(role_of_part(part), column.role)) column.role = ColumnRole::number;
  for (const auto& [position, part] : chosen) {
    TableColumn& column = columns[position];
    column.role = role_of_part(part);
    column.is_chosen = true;
    if (column.role == ColumnRole::number) column.name = part;
  }
  return "";
}

bool chooses_places(const ColumnChoice& choice) {
  return std::any_of(choice.begin(), choice.end(), [](const auto& one) {
    const ColumnRole role = role_of_part(one.first);
    return role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z;
  });
}

Result<ColumnChoice> columns_from_text(std::string_view text) {
  const auto bad = [&](const std::string& what) {
    return Error{what + " in " + quote(text), "", 0, 0, "write PART=COLUMN,..., for example x=px,y=py,z=pz,r=radius"};
  };
  ColumnChoice choice;
  for (const std::string_view around : parts_of(text, ',')) {
    const std::string_view one = trim(around);
    const std::size_t equals = one.find('=');
    if (equals == std::string_view::npos) return bad("expected PART=COLUMN but found " + quote(one));
    const std::string part(trim(one.substr(0, equals))), column(trim(one.substr(equals + 1)));
    if (part.empty() || column.empty()) return bad("expected a part and a column but found " + quote(one));
    if (!choice.emplace(part, column).second) return bad("the part " + quote(part) + " comes twice");
  }
  return choice;
}

}  // namespace bihive
