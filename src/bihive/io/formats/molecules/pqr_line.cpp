#include "bihive/io/formats/molecules/pqr_line.h"

#include <algorithm>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/molecules/pdb_columns.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::size_t kFieldsWithChain = 10;

// The fields behind the record's name, which may touch the serial number (HETATM10000).
std::vector<std::string_view> fields_behind_record(std::string_view line) {
  std::vector<std::string_view> fields;
  constexpr std::string_view blanks = " \t\r\v\f";
  std::size_t at = line.substr(0, 4) == "ATOM" ? 4 : 6;
  while (fields.size() <= kFieldsWithChain + 1) {
    at = line.find_first_not_of(blanks, at);
    if (at == std::string_view::npos) break;
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

// "A1000" is chain A, residue 1000, as pdb2pqr writes large numbers; "52A" is residue 52, insertion code A.
void split_number(std::string_view text, PqrLine& atom) {
  if (atom.chain.empty() && text.size() > 1 && !parse_int(text.substr(0, 1)) && text[0] != '-') {
    atom.chain = text.substr(0, 1);
    text.remove_prefix(1);
  }
  if (text.size() > 1 && !parse_int(text) && parse_int(text.substr(0, text.size() - 1))) {
    atom.insertion = text.substr(text.size() - 1);
    text.remove_suffix(1);
  }
  atom.residue_number = text;
}

bool are_numbers(const std::string_view* fields) {
  for (int i = 0; i < 5; ++i)
    if (!parse_double(fields[i])) return false;
  return true;
}

std::optional<PqrLine> by_fields(std::string_view line) {
  std::vector<std::string_view> fields = fields_behind_record(line);
  const std::string_view element = fields.empty() || atomic_number(fields.back()) == 0 ? "" : fields.back();
  if (!element.empty()) fields.pop_back();
  for (const bool has_chain : {true, false}) {
    const std::size_t count = has_chain ? kFieldsWithChain : kFieldsWithChain - 1;
    if (fields.size() != count || !are_numbers(&fields[count - 5])) continue;
    PqrLine atom;
    atom.serial = fields[0];
    atom.name = fields[1];
    atom.residue = fields[2];
    if (has_chain) atom.chain = fields[3];
    split_number(fields[count - 6], atom);
    for (std::size_t i = 0; i < 5; ++i) atom.numbers[i] = fields[count - 5 + i];
    atom.element = element;
    const std::string_view last = fields[count - 6];
    atom.place = {fields[2].data(), static_cast<std::size_t>(last.data() + last.size() - fields[2].data())};
    return atom;
  }
  return std::nullopt;
}

// The columns of pdb2pqr: those of PDB up to z, then eight for the charge and seven for the radius.
std::optional<PqrLine> by_columns(std::string_view line) {
  if (line.size() < 69) return std::nullopt;
  const auto columns = [line](std::size_t first, std::size_t last) {
    return trim(line.substr(first - 1, last - first + 1));
  };
  PqrLine atom;
  atom.serial = columns(7, 11);
  atom.name = columns(13, 16);
  const ResidueAndChain names = ResidueNames().of(line);
  atom.residue = names.residue;
  atom.chain = names.chain;
  atom.residue_number = columns(23, 26);
  atom.insertion = columns(27, 27);
  atom.place = line.substr(17, 10);
  const std::size_t edges[6] = {31, 39, 47, 55, 63, 70};
  for (std::size_t i = 0; i < 5; ++i) atom.numbers[i] = columns(edges[i], edges[i + 1] - 1);
  atom.element = trim(line.substr(69));
  if (!atom.element.empty() && atomic_number(atom.element) == 0) return std::nullopt;
  if (!are_numbers(atom.numbers)) return std::nullopt;
  return atom;
}

}  // namespace

// The record names with which a PDB file may begin, cut to six columns [wwPDB-3.3].
bool is_pdb_record(std::string_view line) {
  static constexpr std::string_view names[] = {
      "HEADER", "OBSLTE", "TITLE",  "SPLIT",  "CAVEAT", "COMPND", "SOURCE", "KEYWDS", "EXPDTA", "NUMMDL",
      "MDLTYP", "AUTHOR", "REVDAT", "SPRSDE", "JRNL",   "REMARK", "DBREF",  "DBREF1", "SEQADV", "SEQRES",
      "MODRES", "HET",    "HETNAM", "HELIX",  "SHEET",  "SSBOND", "LINK",   "CISPEP", "SITE",   "CRYST1",
      "ORIGX1", "SCALE1", "MTRIX1", "MODEL",  "ATOM",   "HETATM", "USER"};
  const std::string_view name = trim(line.substr(0, 6));
  if (std::find(std::begin(names), std::end(names), name) != std::end(names)) return true;
  return line.substr(0, 5) == "ATOM " || line.substr(0, 6) == "HETATM";
}

bool is_atom_record(std::string_view line) {
  return line.substr(0, 4) == "ATOM" || line.substr(0, 6) == "HETATM";
}

std::optional<PqrLine> split_pqr_line(std::string_view line) {
  std::optional<PqrLine> atom = by_fields(line);
  if (!atom) atom = by_columns(line);
  if (atom) atom->hetero = line.substr(0, 4) != "ATOM";
  return atom;
}

bool may_be_pqr(std::string_view line) {
  const std::optional<PqrLine> atom = split_pqr_line(line);
  return atom && (atom->element.empty() || !may_be_pdb(line));
}

// Columns 31 to 66: the three coordinates, then two that may be missing.
bool may_be_pdb(std::string_view line) {
  if (const ColumnShift shift = column_shift(line)) return may_be_pdb(without_shift(line, shift));
  constexpr std::size_t edges[6] = {30, 38, 46, 54, 60, 66};
  if (line.size() < edges[3]) return false;
  for (int i = 0; i < 5; ++i) {
    const std::string_view text = edges[i] < line.size() ? trim(line.substr(edges[i], edges[i + 1] - edges[i])) : "";
    if (text.empty() ? i < 3 : !parse_double(text)) return false;
  }
  // A number across an edge is a number of PQR. Coordinates may fill their columns, and so touch the next ones.
  const auto digit_at = [line](std::size_t at) { return at < line.size() && line[at] != ' ' && line[at] != '-'; };
  for (const std::size_t edge : {edges[4], edges[5]})
    if (digit_at(edge - 1) && digit_at(edge)) return false;
  return true;
}

bool is_pqr_only(std::string_view line) {
  return !may_be_pdb(line) && may_be_pqr(line);
}

}  // namespace bihive
