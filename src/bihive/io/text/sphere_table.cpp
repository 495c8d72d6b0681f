#include "bihive/io/text/sphere_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "bihive/base/aligned_buffer.h"
#include "bihive/base/memory.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/readable.h"
#include "bihive/io/text/column_numbers.h"

namespace bihive {

ColumnRole usual_role(std::string_view name) {
  static const std::unordered_map<std::string, ColumnRole> roles = {
      {"x", ColumnRole::x},
      {"y", ColumnRole::y},
      {"z", ColumnRole::z},
      {"radius", ColumnRole::radius},
      {"diameter", ColumnRole::diameter},
      {"element", ColumnRole::species},
      {"symbol", ColumnRole::species},
      {"species", ColumnRole::species},
      {"atomic_number", ColumnRole::atomic_number},
      {"type", ColumnRole::type},
      {"red", ColumnRole::red},
      {"green", ColumnRole::green},
      {"blue", ColumnRole::blue},
      {"opacity", ColumnRole::opacity},
      {"transparency", ColumnRole::transparency},
  };
  const auto found = roles.find(lower_case(name));
  return found == roles.end() ? ColumnRole::number : found->second;
}

bool needs_all_rows(ColumnRole role) {
  return role == ColumnRole::species || role == ColumnRole::text || role == ColumnRole::atomic_number ||
         role == ColumnRole::red || role == ColumnRole::green || role == ColumnRole::blue;
}

std::vector<TableColumn> columns_without_names(std::size_t count) {
  std::vector<TableColumn> columns;
  if (count != 3 && count != 4) {
    for (std::size_t i = 1; i <= count; ++i) columns.push_back({"column_" + std::to_string(i), ColumnRole::number});
    return columns;
  }
  columns = {{"x", ColumnRole::x}, {"y", ColumnRole::y}, {"z", ColumnRole::z}};
  if (count > 3) columns.push_back({"radius", ColumnRole::radius});
  return columns;
}

// Asking for the memory's size costs more than reading a row.
constexpr std::int64_t kRowsBetweenChecks = 1 << 16;

SphereTable::SphereTable(const std::vector<TableColumn>& columns) {
  for (const TableColumn& column : columns) {
    if (columns_.size() > kMostColumns) break;
    columns_.emplace_back();
    columns_.back().name = printable(column.name);
    columns_.back().is_chosen = column.is_chosen;
    columns_.back().is_text = column.role == ColumnRole::text;
    columns_.back().role = column.role == ColumnRole::text ? ColumnRole::number : column.role;
  }
}

std::string SphereTable::columns_fault() const {
  const auto count = [this](std::initializer_list<ColumnRole> roles) {
    return std::count_if(columns_.begin(), columns_.end(), [roles](const Column& column) {
      return std::find(roles.begin(), roles.end(), column.role) != roles.end();
    });
  };

  if (columns_.size() > kMostColumns) return "expected at most " + std::to_string(kMostColumns) + " columns";

  // There must be exactly one column for each axis.
  const std::pair<ColumnRole, const char*> axes[3] = {{ColumnRole::x, "x"}, {ColumnRole::y, "y"}, {ColumnRole::z, "z"}};
  for (const auto& [role, name] : axes) {
    if (count({role}) == 0) return std::string("expected columns x, y and z, but there is no ") + name;
    if (count({role}) > 1) return std::string("expected one column ") + name + " only";
  }

  // There may be at most one column for each other role.
  if (count({ColumnRole::radius, ColumnRole::diameter}) > 1)
    return "expected one column for the radius or diameter only";
  if (count({ColumnRole::opacity, ColumnRole::transparency}) > 1) return "expected one column for the opacity only";
  if (count({ColumnRole::species}) > 1 || count({ColumnRole::atomic_number}) > 1)
    return "expected one column for the element only";
  if (count({ColumnRole::type}) > 1) return "expected one column for the type only";

  // A colour needs all three of its parts.
  const auto red = count({ColumnRole::red}), green = count({ColumnRole::green}), blue = count({ColumnRole::blue});
  if (red != green || red != blue || red > 1) return "expected red, green and blue once each, or none of them";
  return "";
}

std::string SphereTable::column_names() const {
  std::string names;
  for (const Column& column : columns_) names += (names.empty() ? "" : " ") + column.name;
  return names;
}

void SphereTable::reserve(std::int64_t rows, std::int64_t bytes_left) {
  // A field takes at least two bytes, with the blank or the line end behind it.
  const auto row_bytes = static_cast<std::int64_t>(2 * columns_.size());
  const auto room = static_cast<std::size_t>(std::max<std::int64_t>(0, std::min(rows, bytes_left / row_bytes + 1)));
  for (Column& column : columns_) {
    if (holds_labels(column.role))
      column.labels.reserve(room);
    else if (column.role != ColumnRole::ignored)
      column.values.reserve(room);
    prefer_huge_pages(column.values.data(), column.values.capacity() * sizeof(double));
  }
}

Status SphereTable::add_row(TextScanner& scanner) {
  std::string_view field;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!scanner.next_field(field)) return width_error(scanner, static_cast<std::int64_t>(i));
    Column& column = columns_[i];
    if (column.role == ColumnRole::ignored) continue;
    if (holds_labels(column.role)) {
      column.labels.add(field);
    } else if (Status read = read_number(column, field, scanner); !read) {
      return read;
    }
  }
  if (!more_fields_allowed_ && scanner.next_field(field))
    return scanner.field_error("expected " + std::to_string(columns_.size()) + " columns (" + column_names() +
                               ") but found one more: " + quote(field));
  if (++rows_ % kRowsBetweenChecks != 0) return Done{};
  if (const std::string fault = memory_fault(); !fault.empty()) return scanner.line_error(fault);
  return Done{};
}

std::string SphereTable::add_numbers(const double* row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    const double value = row[i];
    if (column.role == ColumnRole::ignored) continue;
    if (holds_labels(column.role) || column.is_text) {
      const bool whole = value == std::floor(value) && std::abs(value) < 0x1p53;
      column.labels.add(whole ? std::to_string(static_cast<std::int64_t>(value)) : std::to_string(value));
      continue;
    }
    if (const char* fault = number_fault(column.role, value))
      if (!becomes_numbers(column, value)) return column.name + " " + fault + ": " + readable_number(value);
    column.has_number = true;
    column.values.push_back(value);
  }
  return ++rows_ % kRowsBetweenChecks == 0 ? memory_fault() : "";
}

bool SphereTable::becomes_numbers(Column& column, double value) {
  const bool is_opacity = column.role == ColumnRole::opacity || column.role == ColumnRole::transparency;
  if (!is_opacity || column.is_chosen) return false;
  column.role = ColumnRole::number;
  no_opacity_ = "'" + column.name + "' is outside 0 to 1 (" + readable_number(value) + " in row " +
                std::to_string(rows_) + ", from 0), so it is a number and no opacity";
  return true;
}

// Each number is kept once here, and once more while the set is made.
std::string SphereTable::memory_fault() const {
  const double bytes = sizeof(double) * static_cast<double>(columns_.size()) * static_cast<double>(rows_);
  const Status status =
      check_memory(bytes, std::to_string(rows_) + " rows of " + std::to_string(columns_.size()) + " columns", bytes);
  return status ? "" : status.error().message;
}

Status SphereTable::read_number(Column& column, std::string_view field, const TextScanner& scanner) {
  if (column.is_text) {
    column.labels.add(field);
    return Done{};
  }
  const auto value = parse_double(field);

  // A later column may have gaps, and its first entry may show that it is text.
  if (!value && column.role == ColumnRole::number) {
    if (field.empty()) {
      column.values.push_back(std::numeric_limits<double>::quiet_NaN());
      return Done{};
    }
    if (!column.has_number) {
      begin_text(column);
      column.labels.add(field);
      return Done{};
    }
  }
  if (!value) return scanner.field_error("expected a number for " + column.name + " but found " + quote(field));
  if (const char* fault = number_fault(column.role, *value)) {
    const bool is_opacity = column.role == ColumnRole::opacity || column.role == ColumnRole::transparency;
    return scanner.field_error(column.name + " " + fault + ": " + quote(field),
                               is_opacity && !column.is_chosen
                                   ? "keep it as a number: " + setting_name("columns") + " NAME=" + column.name
                                   : "");
  }
  column.has_number = true;
  column.values.push_back(*value);
  return Done{};
}

// The first entry that is not empty is no number: the column holds texts, and empty ones so far.
void SphereTable::begin_text(Column& column) {
  column.is_text = true;
  for (std::size_t row = 0; row < column.values.size(); ++row) column.labels.add("");
  column.values = {};
}

Status SphereTable::check_width(const TextScanner& scanner) const {
  const std::int64_t found = scanner.count_fields();
  if (found < static_cast<std::int64_t>(columns_.size())) return width_error(scanner, found);
  return Done{};
}

Status SphereTable::width_error(const TextScanner& scanner, std::int64_t found) const {
  return scanner.line_error("expected " + std::to_string(columns_.size()) + " columns (" + column_names() +
                                ") but found " + std::to_string(found),
                            scanner.at_end() && !scanner.ends_in_newline() ? "the file is cut on this line" : "");
}

}  // namespace bihive
