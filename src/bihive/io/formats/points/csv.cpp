// CSV with a header, and plain `x y z [r]` text.
#include <algorithm>
#include <limits>

#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

bool next_data_line(TextScanner& scanner) {
  while (scanner.next_filled_line())
    if (trim(scanner.line()).front() != '#') return true;
  return false;
}

// The fields of the current line, from its beginning, with the separator set; not many more than a table may have.
std::vector<std::string> fields_of(TextScanner& scanner, char separator) {
  scanner.set_separator(separator);
  std::vector<std::string> fields;
  for (std::string_view field; fields.size() <= SphereTable::kMostColumns && scanner.next_field(field);)
    fields.emplace_back(field);
  return fields;
}

char separator_of(std::string_view line, bool tabs_separate) {
  for (const char separator : {';', ',', '\t'})
    if (line.find(separator) != std::string_view::npos && (separator != '\t' || tabs_separate)) return separator;
  return TextScanner::kBlanks;
}

// A header's columns. 'r' alone is the radius; together with 'g' and 'b' it is red.
std::vector<TableColumn> columns_of_header(const std::vector<std::string>& names) {
  const auto has = [&names](const std::string& wanted) {
    return std::any_of(names.begin(), names.end(), [&](const auto& name) { return lower_case(name) == wanted; });
  };
  const bool rgb = has("r") && has("g") && has("b");
  std::vector<TableColumn> columns;
  for (const std::string& name : names) {
    const std::string lower = lower_case(name);
    ColumnRole role = name.empty() ? ColumnRole::ignored : usual_role(name);
    if (lower == "r") role = rgb ? ColumnRole::red : ColumnRole::radius;
    if (lower == "g" && rgb) role = ColumnRole::green;
    if (lower == "b" && rgb) role = ColumnRole::blue;
    columns.push_back({name.empty() ? "(unnamed)" : name, role});
  }
  return columns;
}

// Whether one of the first lines has three numbers, whatever separates them. Text for people has none.
bool any_row(std::string_view text) {
  std::string spaced(text.substr(0, 65536));
  for (char& c : spaced)
    if (c == ',' || c == ';' || c == '"') c = ' ';
  TextScanner lines(spaced, "");
  while (lines.next_line()) {
    int numbers = 0;
    for (std::string_view field; numbers < 3 && lines.next_field(field);) numbers += parse_double(field) ? 1 : 0;
    if (numbers == 3) return true;
  }
  return false;
}

Result<RawSpheres> read_csv(std::string_view text, const std::string& file, std::int64_t frame,
                            const ColumnChoice& choice) {
  TextScanner scanner(text, file);
  if (!next_data_line(scanner)) return scanner.line_error("there is no line with numbers in it");
  if (frame != 0) return no_such_frame(file, frame, 1);

  // A first line without any number is a header. Numbers may have tabs and blanks between them, in any mixture.
  const std::string first = fields_of(scanner, separator_of(scanner.line(), false)).front();
  std::vector<std::string> fields = fields_of(scanner, separator_of(scanner.line(), true));
  const bool has_header = !parse_double(first) && std::none_of(fields.begin(), fields.end(), [](const auto& field) {
    return parse_double(field).has_value();
  });
  if (!has_header) {
    scanner.set_comment('#');
    fields = fields_of(scanner, separator_of(scanner.line(), false));
    if (fields.size() != 3 && fields.size() != 4 && !chooses_places(choice))
      return scanner.line_error(
          "expected 'x y z' or 'x y z r' but found " + std::to_string(fields.size()) +
              (fields.size() == 1 ? " column" : " columns"),
          "name the columns in a header line, or say which they are: " + setting_name("columns") + " x=1,y=2,z=3");
  }

  std::vector<TableColumn> columns = has_header ? columns_of_header(fields) : columns_without_names(fields.size());
  if (const std::string fault = choose_columns(choice, columns); !fault.empty()) return scanner.line_error(fault);
  SphereTable table(columns);
  if (const std::string fault = table.columns_fault(); !fault.empty()) {
    if (has_header && !any_row(text))
      return Error{"this looks like text for people: no line of it has three numbers", file, 0, 0,
                   "a table of spheres has a line for each, with x, y and z"};
    return scanner.line_error(fault + " in the header " + quote(table.column_names()), how_to_name_columns());
  }
  table.reserve(scanner.lines_left() + 1, scanner.bytes_left());

  // Every later line is a sphere.
  if (!has_header) {
    scanner.restart_line();
    if (Status row = table.add_row(scanner); !row) return row.error();
  }
  const Result<std::int64_t> rows =
      table.add_rows(scanner, std::numeric_limits<std::int64_t>::max(), SphereTable::RowLines::data);
  if (!rows) return rows.error();

  const std::string names = table.column_names();
  RawSpheres spheres = std::move(table).take();
  spheres.format = "CSV";
  spheres.rules.insert(spheres.rules.begin(), (has_header ? "columns by the header: " : "plain columns: ") + names);
  return spheres;
}

bool is_table(const FileHead& head) {
  TextScanner scanner = head.text;
  // Skip comments.
  while (trim(scanner.line()).substr(0, 1) == "#")
    if (!scanner.next_filled_line()) return false;

  // Either three numbers, or a header that has x, y and z.
  std::string spaced(scanner.line());
  for (char& c : spaced)
    if (c == ',' || c == ';' || c == '"') c = ' ';
  TextScanner fields(spaced, "");
  fields.next_line();
  int numbers = 0, others = 0;
  bool has[3] = {}, begins_with_number = false;
  for (std::string_view field; fields.next_field(field);) {
    ++(parse_double(field) ? numbers : others);
    if (numbers == 1 && others == 0) begins_with_number = true;
    for (int axis = 0; axis < 3; ++axis) has[axis] = has[axis] || lower_case(field) == std::string(1, char('x' + axis));
  }
  return (numbers >= 3 && others == 0) || (!begins_with_number && has[0] && has[1] && has[2]);
}

}  // namespace

extern constexpr Format kCsv(
    "CSV", ".csv .tsv .txt .dat", Format::kText | Format::kColumns, is_table, read_csv,
    "three numbers, or a header with x, y and z | columns by name or place; plain `x y z [r]` | "
    "column, else by element, else from distances");

}  // namespace bihive
