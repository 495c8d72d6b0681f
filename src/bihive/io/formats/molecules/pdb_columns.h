// Columns of PDB's atoms where programs depart from the format: names of four letters, chains of two, large numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bihive {

/// Columns first to last, counted from 1 as in the format's description; shorter if the line ends earlier.
inline std::string_view pdb_columns(std::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? std::string_view() : line.substr(first - 1, last - first + 1);
}

struct ResidueAndChain {
  std::string_view residue, chain;  ///< without blanks
};

/// Columns 18 to 22 of the atoms of one model, one after the other. Column 21 is blank in the format. Simulations write
/// the fourth letter of a residue's name there, other programs the first letter of a chain. Known residues tell which;
/// of unknown ones the name has four letters unless a known one before it had a chain of two.
class ResidueNames {
 public:
  /// The views are into the line.
  ResidueAndChain of(std::string_view line);

 private:
  bool has_four_letters(std::string_view columns);

  std::string last_;  // columns 18 to 22 of the last atom with a letter in column 21
  bool last_has_four_ = false, has_chains_of_two_ = false;
};

/// How many digits the serial number (from column 7) and the residue's number (from column 23) have more than their
/// columns hold. What follows them is shifted to the right by this many columns.
struct ColumnShift {
  std::size_t serial = 0, residue = 0;

  explicit operator bool() const { return serial + residue > 0; }
};

/// The shift that the line shows: numbers without blanks between their digits, and the points of all coordinates where
/// this shift puts them.
ColumnShift column_shift(std::string_view line);
/// The line without the last digits of these numbers, so that its columns are those of the format.
std::string without_shift(std::string_view line, ColumnShift shift);
/// The whole numbers, as texts of the line.
std::string_view shifted_serial(std::string_view line, ColumnShift shift);
std::string_view shifted_residue_number(std::string_view line, ColumnShift shift);

}  // namespace bihive
