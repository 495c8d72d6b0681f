// One line of a PQR file, cut into its fields; and which of PDB and PQR a line of either belongs to.
#pragma once

#include <optional>
#include <string_view>

namespace bihive {

/// The parts of an ATOM or HETATM line. They are views into the line.
struct PqrLine {
  bool hetero = false;
  std::string_view serial, name, residue, chain, residue_number, insertion;
  std::string_view place;       ///< all that names the residue
  std::string_view numbers[5];  ///< x, y, z, charge, radius: parse_double() reads each
  std::string_view element;     ///< a symbol behind the radius, as Open Babel writes it; mostly empty
};

/// Whether a PDB file may begin with this line.
bool is_pdb_record(std::string_view line);

bool is_atom_record(std::string_view line);

/// The fields where blanks stand between them: exactly 9, or 10 with a chain, behind the record's name, of which the
/// last five are numbers. Else the columns of pdb2pqr, with numbers in the last five. Nothing but the symbol of an
/// element may follow. Nothing if the line is neither.
std::optional<PqrLine> split_pqr_line(std::string_view line);

/// True if the line is PQR and cannot be PDB: the fields are there, and PDB's columns would cut numbers in two.
bool is_pqr_only(std::string_view line);

/// True if PDB's columns hold whole numbers, also where large numbers before them shift them.
bool may_be_pdb(std::string_view line);

/// True if the line's fields are those of PQR, whatever PDB's columns say. With an element behind them they may be
/// those of PDB as well: then PDB's columns count.
bool may_be_pqr(std::string_view line);

}  // namespace bihive
