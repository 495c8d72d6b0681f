#include "bihive/io/formats/detect.h"

#include <algorithm>

#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/formats/arrays/gsd_file.h"
#include "bihive/io/formats/molecules/pqr_line.h"
#include "bihive/io/formats/readers.h"
#include "bihive/io/text/parse_number.h"
#include "bihive/io/text/text_scanner.h"

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

// A lone number on the first line is enough, so that a cut file gets the reader's own message.
bool is_xyz(TextScanner scanner) {
  std::string_view field;
  if (!scanner.next_field(field) || !parse_double(field)) return false;
  return !scanner.next_field(field);
}

// A title, which may be empty, a count, and an atom in columns of five.
bool is_gro(std::string_view text) {
  TextScanner scanner(text, "");
  std::string_view field;
  if (!scanner.next_line() || !scanner.next_line() || !scanner.next_field(field) || !parse_int(field)) return false;
  return !scanner.next_field(field) && scanner.next_line() && is_gro_atom(scanner.line());
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

// The name without .gz or .zst ends so.
bool name_ends(const std::string& name, std::string_view ending) {
  std::string lower = lower_case(name);
  for (const std::string_view packing : {".gz", ".zst"})
    if (lower.size() > packing.size() && lower.ends_with(packing)) lower.resize(lower.size() - packing.size());
  return lower.size() >= ending.size() && lower.compare(lower.size() - ending.size(), ending.size(), ending) == 0;
}

// PQR has PDB's records, with fields of its own. Its atoms do not fit PDB's columns, or the name says it. A file that
// is named PDB stays PDB: shifted columns are an error there, and its B factors are no radii.
bool is_pqr(TextScanner scanner, const std::string& name) {
  if (name_ends(name, ".pdb") || name_ends(name, ".ent")) return false;
  const bool named_so = name_ends(name, ".pqr");
  bool any = false, one_does_not_fit_pdb = false;
  do {
    if (!is_atom_record(scanner.line()) || (scanner.at_end() && any)) continue;
    if (!may_be_pqr(scanner.line())) return named_so && !any && !may_be_pdb(scanner.line());
    any = true;
    one_does_not_fit_pdb = one_does_not_fit_pdb || is_pqr_only(scanner.line());
  } while (!one_does_not_fit_pdb && scanner.next_line());
  return named_so || one_does_not_fit_pdb;
}

}  // namespace

std::optional<Format> format_by_name(const std::string& name) {
  static constexpr std::pair<std::string_view, Format> endings[] = {
      {".pdb", Format::pdb},          {".ent", Format::pdb},
      {".pqr", Format::pqr},          {".pdbx", Format::mmcif},
      {".cif", Format::mmcif},        {".mmcif", Format::mmcif},
      {".xyz", Format::xyz},          {".extxyz", Format::xyz},
      {".gro", Format::gro},          {".gsd", Format::gsd},
      {".dump", Format::lammps_dump}, {".lammpstrj", Format::lammps_dump},
      {".lmp", Format::lammps_data},  {".lammps", Format::lammps_data},
      {".poscar", Format::poscar},    {".vasp", Format::poscar},
      {".sdf", Format::sdf},          {".sd", Format::sdf},
      {".mol", Format::sdf},          {".mol2", Format::mol2},
      {".ply", Format::ply},          {".pcd", Format::pcd},
      {".vtk", Format::vtk_legacy},   {".vtp", Format::vtk_xml},
      {".vtu", Format::vtk_xml},      {".vts", Format::vtk_xml},
      {".csv", Format::csv},          {".tsv", Format::csv},
      {".txt", Format::csv},          {".dat", Format::csv},
      {".npy", Format::npy},          {".npz", Format::npz},
  };
  for (const auto& [ending, format] : endings)
    if (name_ends(name, ending)) return format;
  // VASP's files have names of their own.
  const std::string own = lower_case(name.substr(name.find_last_of('/') + 1));
  if (own.rfind("poscar", 0) == 0 || own.rfind("contcar", 0) == 0) return Format::poscar;
  if (own.rfind("xdatcar", 0) == 0) return Format::xdatcar;
  return std::nullopt;
}

std::optional<Format> format_by_content(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 6) == "\x93NUMPY") return Format::npy;
  if (bytes.substr(0, 4) == "PK\x03\x04") return Format::npz;
  if (looks_like_hdf5(bytes)) return Format::hdf5;
  if (looks_like_netcdf(bytes)) return Format::netcdf;
  if (GsdFile::looks_like(bytes)) return Format::gsd;
  const std::string_view head = bytes.substr(0, kLook);
  // Their headers are text, and what follows may be binary.
  if (head.substr(0, 4) == "ply\n" || head.substr(0, 5) == "ply\r\n") return Format::ply;
  if (head.substr(0, 15) == "# vtk DataFile ") return Format::vtk_legacy;
  if (is_pcd(head)) return Format::pcd;
  if (is_vtk_xml(head)) return Format::vtk_xml;
  if (head.find('\0') != std::string_view::npos) return std::nullopt;

  TextScanner scanner(head, "");
  if (!scanner.next_filled_line()) return std::nullopt;
  if (trim(scanner.line()).substr(0, 5) == "ITEM:") return Format::lammps_dump;
  // Formats whose first lines no other has. Their titles may be anything, also a word of PDB.
  static constexpr std::pair<bool (*)(std::string_view), Format> recognisers[] = {
      {is_sdf, Format::sdf},   {is_poscar, Format::poscar},           {is_xdatcar, Format::xdatcar},
      {is_mol2, Format::mol2}, {is_lammps_data, Format::lammps_data},
  };
  for (const auto& [is_format, format] : recognisers)
    if (is_format(head)) return format;
  if (is_pdb_record(scanner.line())) return is_pqr(scanner, name) ? Format::pqr : Format::pdb;
  if (is_gro(head)) return Format::gro;
  if (is_xyz(scanner)) return Format::xyz;
  if (is_table(scanner)) return Format::csv;

  // CIF may begin with comments.
  while (trim(scanner.line()).substr(0, 1) == "#")
    if (!scanner.next_filled_line()) return std::nullopt;
  if (lower_case(trim(scanner.line()).substr(0, 5)) == "data_")
    return is_small_cif(bytes) ? Format::small_cif : Format::mmcif;
  return std::nullopt;
}

std::string known_formats() {
  return "PDB (.pdb .ent), PQR (.pqr), mmCIF and CIF (.cif .mmcif), XYZ (.xyz .extxyz), GRO (.gro), GSD (.gsd), LAMMPS "
         "dump (.dump .lammpstrj) and data (.lmp .lammps), POSCAR and XDATCAR (.poscar .vasp), SDF and MOL (.sdf "
         ".mol), "
         "MOL2 (.mol2), PLY (.ply), PCD (.pcd), VTK (.vtk .vtp .vtu .vts), CSV or plain 'x y z r' (.csv .tsv .txt "
         ".dat), "
         "NPY and NPZ (.npy .npz), HDF5 and H5MD (.h5 .hdf5 .h5md), NetCDF of LAMMPS and AMBER (.nc .ncdf), each also "
         "as .gz or .zst";
}

}  // namespace bihive
