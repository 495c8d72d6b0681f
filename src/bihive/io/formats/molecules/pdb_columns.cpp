#include "bihive/io/formats/molecules/pdb_columns.h"

#include "bihive/base/ascii.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::size_t kSerialColumn = 7, kSerialColumnWidth = 5, kResidue = 23, kResidueWidth = 4;
constexpr std::size_t kMostDigitsMore = 4;
// Columns of the decimal points of x, y and z (8.3 each, from column 31).
constexpr std::size_t kPoints[3] = {35, 43, 51};

bool has_at(std::string_view line, std::size_t column, char c) {
  return column <= line.size() && line[column - 1] == c;
}

bool has_digit_at(std::string_view line, std::size_t column) {
  return column <= line.size() && is_digit(line[column - 1]);
}

// Digits behind a number that fills its columns.
std::size_t digits_more(std::string_view line, std::size_t first, std::size_t width) {
  std::size_t digits = 0;
  while (digits < width + kMostDigitsMore && has_digit_at(line, first + digits)) ++digits;
  return digits > width ? digits - width : 0;
}

bool has_points(std::string_view line, std::size_t shift) {
  for (const std::size_t column : kPoints)
    if (!has_at(line, column + shift, '.')) return false;
  return true;
}

}  // namespace

ResidueAndChain ResidueNames::of(std::string_view line) {
  const std::string_view names = pdb_columns(line, 18, 22);
  const bool is_full = names.size() >= 4 && names.substr(0, 4).find(' ') == std::string_view::npos;
  if (is_full && has_four_letters(names)) return {names.substr(0, 4), trim(names.substr(4))};
  return {trim(names.substr(0, 3)), names.size() > 3 ? trim(names.substr(3)) : std::string_view()};
}

bool ResidueNames::has_four_letters(std::string_view columns) {
  if (columns == last_) return last_has_four_;
  last_ = columns;
  const bool two_for_chain = columns.size() > 4 && columns[4] != ' ';
  if (class_of_residue(columns.substr(0, 4)) != ResidueClass::unknown) {
    last_has_four_ = true;
  } else if (class_of_residue(columns.substr(0, 3)) != ResidueClass::unknown) {
    last_has_four_ = false;
    has_chains_of_two_ = has_chains_of_two_ || two_for_chain;
  } else {
    last_has_four_ = !(two_for_chain && has_chains_of_two_);
  }
  return last_has_four_;
}

ColumnShift column_shift(std::string_view line) {
  // Nearly all lines end here.
  if (!has_digit_at(line, kSerialColumn + kSerialColumnWidth) && !has_digit_at(line, kResidue + kResidueWidth))
    return {};
  ColumnShift shift;
  shift.serial = digits_more(line, kSerialColumn, kSerialColumnWidth);
  shift.residue = digits_more(line, kResidue + shift.serial, kResidueWidth);
  const bool is_shifted = shift && !has_points(line, 0) && has_points(line, shift.serial + shift.residue);
  return is_shifted ? shift : ColumnShift{};
}

std::string without_shift(std::string_view line, ColumnShift shift) {
  std::string plain(line);
  plain.erase(kResidue - 1 + shift.serial + kResidueWidth, shift.residue);
  plain.erase(kSerialColumn - 1 + kSerialColumnWidth, shift.serial);
  return plain;
}

std::string_view shifted_serial(std::string_view line, ColumnShift shift) {
  return trim(line.substr(kSerialColumn - 1, kSerialColumnWidth + shift.serial));
}

std::string_view shifted_residue_number(std::string_view line, ColumnShift shift) {
  return trim(line.substr(kResidue - 1 + shift.serial, kResidueWidth + shift.residue));
}

}  // namespace bihive
