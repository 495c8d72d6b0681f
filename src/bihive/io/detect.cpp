#include "bihive/io/detect.h"

#include <algorithm>

#include "bihive/io/parse_number.h"
#include "bihive/io/text_scanner.h"

namespace bihive {
namespace {

// The first lines show the format; longer lines are cut at this length.
constexpr std::size_t kLook = 65536;

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

// One line with a count, a comment, then a line of at least four fields of which three are numbers. A lone number on
// the first line is enough, so that a cut file gets the reader's own message.
bool is_xyz(TextScanner scanner) {
  std::string_view field;
  if (!scanner.next_field(field) || !parse_double(field)) return false;
  return !scanner.next_field(field);
}

bool is_table(TextScanner scanner) {
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

std::optional<Format> by_content(std::string_view bytes) {
  if (bytes.substr(0, 6) == "\x93NUMPY") return Format::npy;
  const std::string_view head = bytes.substr(0, kLook);
  if (head.find('\0') != std::string_view::npos) return std::nullopt;

  TextScanner scanner(head, "");
  if (!scanner.next_filled_line()) return std::nullopt;
  if (trim(scanner.line()).substr(0, 5) == "ITEM:") return Format::lammps_dump;
  if (is_pdb_record(scanner.line())) return Format::pdb;
  if (is_xyz(scanner)) return Format::xyz;
  if (is_table(scanner)) return Format::csv;

  // CIF may begin with comments.
  while (trim(scanner.line()).substr(0, 1) == "#")
    if (!scanner.next_filled_line()) return std::nullopt;
  if (lower_case(trim(scanner.line()).substr(0, 5)) == "data_") return Format::mmcif;
  return std::nullopt;
}

std::optional<Format> by_name(const std::string& name) {
  static constexpr std::pair<std::string_view, Format> endings[] = {
      {".pdb", Format::pdb},          {".ent", Format::pdb},
      {".cif", Format::mmcif},        {".mmcif", Format::mmcif},
      {".xyz", Format::xyz},          {".extxyz", Format::xyz},
      {".dump", Format::lammps_dump}, {".lammpstrj", Format::lammps_dump},
      {".csv", Format::csv},          {".tsv", Format::csv},
      {".txt", Format::csv},          {".dat", Format::csv},
      {".npy", Format::npy},
  };
  std::string lower = lower_case(name);
  if (lower.size() > 3 && lower.compare(lower.size() - 3, 3, ".gz") == 0) lower.resize(lower.size() - 3);
  for (const auto& [ending, format] : endings)
    if (lower.size() >= ending.size() && lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0)
      return format;
  return std::nullopt;
}

}  // namespace

std::optional<Format> detect_format(std::string_view bytes, const std::string& name) {
  const auto format = by_content(bytes);
  return format ? format : by_name(name);
}

std::string known_formats() {
  return "PDB (.pdb .ent), mmCIF (.cif .mmcif), XYZ (.xyz .extxyz), LAMMPS dump (.dump .lammpstrj), CSV or plain "
         "'x y z r' (.csv .tsv .txt .dat), NPY (.npy), each also as .gz";
}

}  // namespace bihive
