// XYZ: a count, a comment, and one line for each sphere, repeated for every frame. Extended XYZ [ExtXYZ] names its
// columns in the comment (io/formats/molecules/xyz_comment.h): Properties=species:S:1:pos:R:3:radius:R:1
#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/xyz_comment.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

std::vector<TableColumn> plain_columns() {
  return {{"symbol", ColumnRole::species}, {"x", ColumnRole::x}, {"y", ColumnRole::y}, {"z", ColumnRole::z}};
}

// Adds the columns of one property, such as pos:R:3.
void add_property(const std::string& name, char kind, std::int64_t width, std::vector<TableColumn>& columns) {
  const std::string lower = lower_case(name);
  const auto add_three = [&](ColumnRole first, const char* const(&names)[3]) {
    for (int i = 0; i < 3; ++i) columns.push_back({names[i], static_cast<ColumnRole>(static_cast<int>(first) + i)});
  };
  if (lower == "pos" && width == 3) return add_three(ColumnRole::x, {"x", "y", "z"});
  if ((lower == "color" || lower == "colour") && width == 3)
    return add_three(ColumnRole::red, {"red", "green", "blue"});
  if (width == 1) {
    const bool z_number = name == "Z" || lower == "numbers";
    ColumnRole role = z_number ? ColumnRole::atomic_number : usual_role(name);
    // Only pos gives a position; properties named 'x' and so on become other numbers.
    if (role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z) role = ColumnRole::number;
    if (kind == 'S' && role == ColumnRole::number) role = ColumnRole::text;
    if (kind == 'L') role = ColumnRole::ignored;
    columns.push_back({name, role});
    return;
  }
  for (std::int64_t i = 1; i <= width; ++i)
    columns.push_back(
        {name + "_" + std::to_string(i), kind == 'R' || kind == 'I' ? ColumnRole::number : ColumnRole::ignored});
}

// The columns of a Properties value, or the message of an error.
std::string columns_of(std::string_view properties, std::vector<TableColumn>& columns) {
  while (!properties.empty()) {
    std::string_view part[3];
    for (std::string_view& p : part) {
      p = properties.substr(0, properties.find(':'));
      properties.remove_prefix(std::min(p.size() + 1, properties.size()));
    }
    const auto width = parse_int(part[2]);
    if (part[0].empty() || part[1].size() != 1 || std::string_view("SIRL").find(part[1]) == std::string_view::npos ||
        !width || *width < 1 || columns.size() + static_cast<std::uint64_t>(*width) > SphereTable::kMostColumns)
      return "expected name:type:columns in Properties, with one of S, I, R, L for the type, but found " +
             quote(std::string(part[0]) + ":" + std::string(part[1]) + ":" + std::string(part[2]));
    add_property(std::string(part[0]), part[1][0], *width, columns);
  }
  return "";
}

// A quote that is not closed may hide keys that matter.
Status check_comment(const TextScanner& scanner, const XyzComment& comment) {
  if (!comment.unclear_at()) return Done{};
  const std::string line = lower_case(scanner.line());
  for (const char* const key : {"properties", "lattice"}) {
    const auto value = comment.find(key);
    const bool is_open = value && !value->empty() && (value->front() == '"' || value->front() == '\'');
    if (is_open || (!value && line.find(key) != std::string::npos))
      return scanner.column_error(static_cast<std::int64_t>(*comment.unclear_at()),
                                  "from here on the comment of extended XYZ is not understood",
                                  "is a quote or bracket not closed?");
  }
  return Done{};
}

// The cell that a frame's comment line states.
Result<std::optional<Cell>> cell_of(const TextScanner& scanner, const XyzComment& comment) {
  const auto lattice = comment.find("lattice");
  if (!lattice) return std::optional<Cell>();
  const auto edges = xyz_numbers(*lattice);
  if (!edges || edges->size() != 9)
    return scanner.line_error("expected nine finite numbers in Lattice but found " + quote(*lattice));
  Cell cell;
  for (std::size_t i = 0; i < 9; ++i) cell.vectors[i / 3][static_cast<int>(i % 3)] = (*edges)[i];
  if (const auto origin = comment.find("origin")) {
    const auto corner = xyz_numbers(*origin);
    if (!corner || corner->size() != 3)
      return scanner.line_error("expected three finite numbers in Origin but found " + quote(*origin));
    cell.origin = {(*corner)[0], (*corner)[1], (*corner)[2]};
  }
  // Other values than three truths are passed over, as all unknown keys are.
  if (const auto flags = comment.find("pbc"))
    if (const auto periodic = xyz_flags(*flags)) cell.periodic = *periodic;
  return std::optional<Cell>(cell);
}

// The number of a key, after which some programs write a comma.
std::optional<double> number_of(const XyzComment& comment, std::initializer_list<std::string_view> keys) {
  const auto value = comment.find_any(keys);
  if (!value) return std::nullopt;
  const auto number = parse_double(value->substr(0, value->find_first_of(",;")));
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// Time and step that a frame's comment line states.
void take_when_of(const XyzComment& comment, RawSpheres& spheres) {
  spheres.time_ps = number_of(comment, {"time", "t"});
  if (spheres.time_ps)
    spheres.rules.push_back("time: that of the comment, taken as picoseconds, as the format names no unit");
  const auto step = number_of(comment, {"step"});
  if (step && *step == std::floor(*step) && std::abs(*step) < 0x1p53) spheres.step = static_cast<std::int64_t>(*step);
}

// The value of `title`; else a comment without keys and values, unless it is a number or ends in one behind a colon
// ("Atoms. Timestep: 0").
std::string title_of(std::string_view comment, const XyzComment& entries) {
  if (const auto title = entries.find("title")) return title_from(*title);
  if (comment.find('=') != std::string_view::npos) return "";
  const std::size_t colon = comment.rfind(':');
  const std::string_view last = colon == std::string_view::npos ? comment : comment.substr(colon + 1);
  TextScanner numbers(last, "");
  bool all_numbers = numbers.next_line();
  for (std::string_view field; all_numbers && numbers.next_field(field);) all_numbers = parse_double(field).has_value();
  return all_numbers ? std::string() : title_from(comment);
}

// The table that a frame's comment line describes.
Result<SphereTable> table_of(const TextScanner& scanner, const XyzComment& comment, const ColumnChoice& choice) {
  if (Status status = check_comment(scanner, comment); !status) return status.error();
  const auto properties = comment.find("properties");
  std::vector<TableColumn> columns;
  std::string fault;
  if (properties)
    fault = columns_of(*properties, columns);
  else
    columns = plain_columns();
  if (fault.empty()) fault = choose_columns(choice, columns);
  SphereTable table(columns);
  if (fault.empty()) fault = table.columns_fault();
  if (!fault.empty())
    return scanner.line_error(
        fault, properties ? "Properties needs pos:R:3" : "name more columns by Properties=... on this line");
  if (!properties) table.allow_more_fields();
  return table;
}

// The count of a frame's first line.
Result<std::int64_t> count_of_frame(TextScanner& scanner, std::int64_t frame) {
  std::string_view field;
  scanner.next_field(field);
  const auto count = parse_int(field);
  if (!count || *count < 0)
    return scanner.field_error("expected the number of spheres of frame " + std::to_string(frame) + " but found " +
                               quote(field));
  if (scanner.next_field(field))
    return scanner.field_error("expected nothing but the number of spheres on this line, but found " + quote(field));
  return *count;
}

// A line for one more sphere: the count before it was too small. Cell vectors (VEC1, Tv) look alike, but for their
// name.
bool is_sphere(TextScanner scanner) {
  scanner.restart_line();
  std::string_view label, field;
  if (!scanner.next_field(label) || (!parse_int(label) && atomic_number(label) == 0)) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (!scanner.next_field(field) || !parse_double(field)) return false;
  return true;
}

// Several programs write text behind the last frame.
std::string text_behind(const TextScanner& scanner, std::int64_t frames) {
  const std::string read = frames == 1 ? "one frame was" : std::to_string(frames) + " frames were";
  return scanner.file() + ":" + std::to_string(scanner.line_number()) +
         ": the text from here on begins no frame and is left out (" + quote(trim(scanner.line())) + "); " + read +
         " read";
}

// The same from an index.
std::string text_behind_all(const RandomFile& file, const FrameIndex& index) {
  FileText rest{file, index.frames.back().end, file.size(), index.lines, {}};
  TextScanner scanner(rest);
  scanner.next_filled_line();
  return text_behind(scanner, index.count());
}

Result<RawSpheres> read_xyz(const TextScanner& text, const FramePass& pass) {
  TextScanner scanner = text;
  const std::int64_t frame = pass.wanted;
  RawSpheres spheres;
  std::vector<std::string> warnings;
  FrameNotes notes(pass.made, scanner);
  std::int64_t frames = pass.first;
  for (; scanner.next_filled_line(); ++frames, notes.end_frame(scanner)) {
    // Read the count, and the comment that may name the columns.
    const Result<std::int64_t> count = count_of_frame(scanner, frames);
    if (!count && frames > std::max<std::int64_t>(frame, 0) && !is_sphere(scanner)) {
      warnings.push_back(text_behind(scanner, frames));
      if (pass.made != nullptr) pass.made->text_behind = true;
      break;
    }
    if (!count) return count.error();
    const std::int64_t count_line = scanner.line_number();
    const auto cut = [&](std::int64_t found) {
      return scanner.line_error("the file ends in frame " + std::to_string(frames) + ": line " +
                                std::to_string(count_line) + " promises " + std::to_string(*count) +
                                " spheres, but there are " + std::to_string(found));
    };
    if (!scanner.next_line()) {
      if (*count == 0) continue;
      return cut(0);
    }
    const XyzComment comment(scanner.line());
    const std::string title = frames == frame ? title_of(scanner.line(), comment) : std::string();
    Result<SphereTable> table = table_of(scanner, comment, pass.columns);
    if (!table) return table.error();
    std::optional<Cell> cell;
    if (frames == frame) {
      Result<std::optional<Cell>> stated = cell_of(scanner, comment);
      if (!stated) return stated.error();
      cell = *stated;
    }

    // Read the spheres of the wanted frame. Skip those of other frames, but check the last line.
    const bool wanted = frames == frame;
    if (wanted) table->reserve(*count, scanner.bytes_left());
    std::int64_t found = 0;
    const std::int64_t first_line = scanner.line_number() + 1;
    if (wanted) {
      const Result<std::int64_t> rows = table->add_rows(scanner, *count, SphereTable::RowLines::all);
      if (!rows) return rows.error();
      found = *rows;
    }
    for (; !wanted && found < *count && scanner.next_line(); ++found)
      if (scanner.at_end())
        if (Status width = table->check_width(scanner); !width) return width.error();
    if (found < *count) return cut(found);
    if (!wanted) continue;
    const std::string columns = table->column_names();
    const IdOrder order = table->sort_by_id();
    spheres = std::move(*table).take();
    note_id_order(order, scanner.file(), first_line, spheres);
    spheres.cell = cell;
    spheres.title = title;
    spheres.rules.insert(spheres.rules.begin(), "columns: " + columns);
    take_when_of(comment, spheres);
  }
  if (pass.reads_none()) return spheres;
  if (frame < 0 || frame >= frames) return no_such_frame(scanner.file(), frame, frames);
  if (pass.index != nullptr) {
    frames = pass.index->count();
    if (pass.index->text_behind) warnings.push_back(text_behind_all(*pass.file, *pass.index));
  }
  spheres.format = "XYZ";
  spheres.frames = frames;
  spheres.warnings.insert(spheres.warnings.end(), warnings.begin(), warnings.end());
  return spheres;
}

// A lone number on the first line is enough, so that a cut file gets the reader's own message.
bool is_xyz(const FileHead& head) {
  TextScanner scanner = head.text;
  std::string_view field;
  return scanner.next_field(field) && parse_double(field) && !scanner.next_field(field);
}

}  // namespace

extern constexpr Format kXyz(
    "XYZ", ".xyz .extxyz", Format::kText | Format::kFrames | Format::kColumns, is_xyz, read_xyz,
    "a count alone on the first line | one frame; extended XYZ: any columns named by `Properties` "
    "| column, else by element",
    3);

}  // namespace bihive
