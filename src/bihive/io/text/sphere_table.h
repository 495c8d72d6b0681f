// Spheres from a table of text: one line for each sphere, columns by name. LAMMPS dumps, XYZ and CSV share it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/text/id_order.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {

/// The role of a column.
enum class ColumnRole {
  ignored,  ///< ignored
  x,        ///< centre
  y,
  z,
  radius,
  diameter,
  atomic_number,
  red,  ///< 0 to 1 or 0 to 255
  green,
  blue,
  opacity,       ///< 0 (clear) to 1
  transparency,  ///< 1 - opacity
  number,        ///< any number or text, kept under the column's name
  text,          ///< text, also where it looks like a number
  species,       ///< an element's symbol, an atomic number (1 to 118), or any other label
  type,          ///< a whole number, or a label
};

struct TableColumn {
  std::string name;
  ColumnRole role;
  bool is_chosen = false;  ///< by the user: its name does not decide
};

/// The role that a column's name stands for in most formats (upper or lower case): x, y, z, radius, diameter, element,
/// symbol, species, atomic_number, type, red, green, blue, opacity, transparency; else `number`.
ColumnRole usual_role(std::string_view name);
/// Whether the meaning of such a column depends on all rows: colours may range to 1 or to 255, and elements are none if
/// all are unknown.
bool needs_all_rows(ColumnRole role);

/// Gives the chosen columns their parts, and takes these from other columns. Returns the reason why it cannot, or an
/// empty text.
std::string choose_columns(const ColumnChoice& choice, std::vector<TableColumn>& columns);

/// Whether x, y or z are among the chosen.
bool chooses_places(const ColumnChoice& choice);

/// Of a table without names: x, y, z and radius if there are three or four columns, else column_1, column_2, ...
std::vector<TableColumn> columns_without_names(std::size_t count);

/// The remedy where no column is called x.
inline std::string how_to_name_columns() {
  return "say which columns they are: " + setting_name("columns") + " x=NAME,y=NAME,z=NAME";
}

class SphereTable {
 public:
  /// More columns are an error: no real file has that many.
  static constexpr std::size_t kMostColumns = 1000;

  /// Control characters in the names are replaced.
  explicit SphereTable(const std::vector<TableColumn>& columns);

  /// The reason why the columns cannot make spheres (no x, two radii ...), or an empty text.
  std::string columns_fault() const;
  /// "x y z radius"
  std::string column_names() const;
  /// Ignores fields behind the last column; without this call they are an error.
  void allow_more_fields() { more_fields_allowed_ = true; }
  /// Makes room for that many rows, but never for more than the rest of the text can hold.
  void reserve(std::int64_t rows, std::int64_t bytes_left);

  /// Reads the scanner's line. Errors: too few fields or too many; a field that should be a number and is not; a
  /// coordinate, radius, colour or opacity out of range.
  Status add_row(TextScanner& scanner);
  /// Which lines are rows: each, or each that has more than blanks and does not begin with '#'.
  enum class RowLines { all, data };
  /// As add_row() for the next lines, `most` rows at most: the same rows and the same errors, by all threads. Returns
  /// how many there were; fewer only at the end of the text.
  Result<std::int64_t> add_rows(TextScanner& scanner, std::int64_t most, RowLines lines);
  /// A row of a file that is not text: one number for each column, those of ignored ones too. Returns why it is refused
  /// ("x is not finite"), or an empty text. A column that is an opacity by its name alone, as the logits of Gaussian
  /// splats are, becomes one of any numbers where its numbers are none.
  std::string add_numbers(const double* row);
  /// Colours are sRGB bytes, 0 to 255, even if none is above 1.
  void colours_are_bytes() { colours_are_bytes_ = true; }
  /// Checks the number of fields of a line that is otherwise skipped.
  Status check_width(const TextScanner& scanner) const;

  /// Brings the rows into the order of the numbers in a column `id`, in upper or lower case, if each row has its own.
  IdOrder sort_by_id();

  /// The spheres, without `format`. Colours are linear, 0 to 1; if any part is above 1, all are sRGB, 0 to 255.
  RawSpheres take() &&;

 private:
  struct Column {
    std::string name;
    ColumnRole role;
    bool is_chosen = false;
    // Numbers.
    std::vector<double> values;
    bool has_number = false;
    // Labels, and columns of text.
    bool is_text = false;
    TextCollector labels;
  };

  struct Part;
  bool add_plain_row(std::string_view line);
  Status read_rows(TextScanner& scanner, RowLines lines);
  bool is_decided() const;
  SphereTable without_rows() const;
  void drop_rows();
  void append(std::vector<Part>& parts, std::size_t used);

  static Status read_number(Column& column, std::string_view field, const TextScanner& scanner);
  static void begin_text(Column& column);
  bool becomes_numbers(Column& column, double value);
  static void take_types(Column& column, RawSpheres& spheres);
  std::string memory_fault() const;
  Status width_error(const TextScanner& scanner, std::int64_t found) const;
  const Column* find(ColumnRole role) const;
  Column* find(ColumnRole role);
  std::vector<double> take_values(ColumnRole role);
  void take_radii(RawSpheres& spheres);
  void take_elements(RawSpheres& spheres);
  void take_colours(RawSpheres& spheres);
  void take_columns(RawSpheres& spheres);

  std::vector<Column> columns_;
  std::int64_t rows_ = 0;
  bool more_fields_allowed_ = false;
  bool colours_are_bytes_ = false;
  std::string no_opacity_;           // a rule
  std::vector<double> row_numbers_;  // of the row that is being read
  std::vector<std::string_view> row_texts_;
};

}  // namespace bihive
