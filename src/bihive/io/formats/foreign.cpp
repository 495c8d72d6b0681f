#include "bihive/io/formats/foreign.h"

#include <algorithm>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::string_view kTrajectory =
    "write one frame as PDB: 'gmx trjconv -f FILE -s TOPOLOGY -dump 0 -o OUT.pdb', or MDAnalysis";
constexpr std::string_view kMdanalysis =
    "write it as PDB or XYZ with MDAnalysis: Universe(TOPOLOGY, FILE).atoms.write('OUT.pdb')";
constexpr std::string_view kBabel = "convert it with 'obabel FILE -O OUT.pdb' (Open Babel)";
constexpr std::string_view kAse = "convert it with 'ase convert FILE OUT.xyz' (ASE)";
constexpr std::string_view kPoints = "write the points as CSV with a header, for example with meshio or CloudCompare";
constexpr ForeignFormat kKnown[] = {
    {"tng", "a TNG trajectory of GROMACS", ".tng", kTrajectory},
    {"tpr", "a run input file of GROMACS (TPR)", ".tpr", "convert it with 'gmx editconf -f FILE.tpr -o OUT.pdb'"},
    {"utf16", "a text in UTF-16", "", "convert it with 'iconv -f UTF-16 -t UTF-8 FILE > OUT'"},
    {"cr", "a text whose lines end in CR (carriage return) alone", "",
     "convert it with 'tr \"\\r\" \"\\n\" < FILE > OUT'"},
    {"mmtf", "an MMTF file", ".mmtf", "take the entry's mmCIF file"},
    {"pdbml", "a PDBML file (XML)", "", "take the entry's mmCIF file"},
    {"cml", "a CML file (XML)", ".cml", kBabel},
    {"ase-json", "a database of ASE in JSON", "", kAse},
    {"json", "JSON, but no scene of bihive", "", "scene files have the key \"bihive_scene\": docs/scene_format.md"},
    {"vtk", "a VTK file without points of its own", ".vti .vtr .pvtp .pvtu .vtm .pvd", kPoints},
    {"stl", "a mesh (STL)", ".stl", kPoints, "solid "},
    {"prmtop", "a topology of Amber (PRMTOP), without coordinates", ".prmtop .parm7",
     "convert it with 'cpptraj' or 'ambpdb'", "%VERSION"},
    {"inpcrd", "a file of coordinates of Amber", ".inpcrd .rst7 .restrt",
     "convert it with 'ambpdb -p TOPOLOGY -c FILE > OUT.pdb'"},
    {"top", "a topology of GROMACS, without coordinates", ".top .itp", "take its structure: a GRO or PDB file"},
    {"coor", "a binary structure of NAMD", ".coor", kMdanalysis},
    {"crd", "a structure of CHARMM (CRD)", ".crd", kMdanalysis},
    {"cssr", "a crystal structure in CSSR", ".cssr", kBabel},
    {"dlpoly", "a structure or trajectory of DL_POLY (CONFIG, HISTORY)", "config* revcon* history*",
     "write it as XYZ with ASE: ase.io.write('OUT.xyz', ase.io.read('CONFIG', format='dlp4')), or 'dlp-history'"},
    {"cube", "a cube of Gaussian", ".cube .cub", kAse},
    {"xsf", "a structure of XCrySDen (XSF)", ".xsf .axsf", kAse},
    {"tinker", "a structure of Tinker", ".txyz .arc", kBabel},
    {"dms", "a structure of Desmond (SQLite)", ".dms", kMdanalysis},
    {"ase-db", "an SQLite database", ".db", kAse, "SQLite format 3"},
    {"picture", "a picture", ".png .jpg .jpeg .exr .gif .tif .tiff",
     "bihive draws files of spheres; it reads no pictures", "\x89PNG\r\n\x1a\n|\xff\xd8\xff|\x76\x2f\x31\x01|GIF8"},
    {"pdf", "a PDF document", ".pdf", "", "%PDF-"},
    {"html", "a web page (HTML)", ".html .htm", "download the file itself, not the page that links to it"},
};

const ForeignFormat* named(std::string_view key) {
  const auto found =
      std::find_if(std::begin(kKnown), std::end(kKnown), [key](const ForeignFormat& one) { return one.key == key; });
  return found == std::end(kKnown) ? nullptr : found;
}

// Formats with a mark at their begin, which nothing else has.
std::string_view by_mark(std::string_view bytes) {
  using namespace std::string_view_literals;
  for (const ForeignFormat& known : kKnown)
    for (std::string_view marks = known.marks; !marks.empty();) {
      const std::size_t end = std::min(marks.find('|'), marks.size());
      if (bytes.starts_with(marks.substr(0, end))) return known.key;
      marks.remove_prefix(std::min(end + 1, marks.size()));
    }
  if (bytes.size() < 16) return "";
  // A map of msgpack.
  const auto first = static_cast<unsigned char>(bytes[0]);
  if ((first >> 4 == 8 || first == 0xde) && bytes.substr(0, 65536).find("mmtfVersion") != std::string_view::npos)
    return "mmtf";
  if (bytes.substr(4, 4) == "\0\0\0\x0d"sv && bytes.substr(8, 8).find("VERSION") != std::string_view::npos)
    return "tpr";
  if (bytes.starts_with("\0\0\0"sv) && bytes.substr(0, 24).find("VERSION") != std::string_view::npos) return "tpr";
  if (bytes.substr(0, 64).find("TNG") != std::string_view::npos && bytes.substr(1).starts_with("\0"sv)) return "tng";
  return "";
}

// XML and HTML, by their first elements.
std::string_view by_element(std::string_view text) {
  const std::string head = lower_case(text.substr(0, 2000));
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || head[first] != '<') return "";
  const std::pair<std::string_view, std::string_view> elements[] = {
      {"<pdbx:", "pdbml"}, {"<html", "html"}, {"<!doctype html", "html"}, {"<cml", "cml"}, {"<molecule", "cml"}};
  for (const auto& [element, key] : elements)
    if (head.find(element) != std::string::npos) return key;
  return "";
}

// A line's fields, not many of them.
std::vector<std::string_view> fields_of_line(std::string_view line) {
  std::vector<std::string_view> fields;
  TextScanner scanner(line, "");
  scanner.next_line();
  for (std::string_view field; fields.size() < 12 && scanner.next_field(field);) fields.push_back(field);
  return fields;
}

bool all_numbers(const std::vector<std::string_view>& fields, std::size_t count) {
  return fields.size() >= count && std::all_of(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(count),
                                               [](std::string_view field) { return parse_double(field).has_value(); });
}

// Formats that the first lines show.
std::string_view by_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  TextScanner scanner(text.substr(0, 65536), "");
  while (lines.size() < 40 && scanner.next_line()) lines.push_back(scanner.line());
  const auto line = [&lines](std::size_t i) { return i < lines.size() ? lines[i] : std::string_view(); };

  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view bare = trim(lines[i]);
    if (bare == "PRIMCOORD" || bare == "PRIMVEC" || bare.starts_with("ANIMSTEPS")) return "xsf";
  }

  // CHARMM: titles behind asterisks, then the count.
  if (line(0).starts_with("*")) {
    std::size_t i = 0;
    while (line(i).starts_with("*")) ++i;
    const std::vector<std::string_view> count = fields_of_line(line(i));
    if (!count.empty() && parse_int(count[0])) return "crd";
  }

  // Cube: two comments, a count with the origin, three counts with vectors.
  const auto counted_vector = [&](std::size_t i) {
    const std::vector<std::string_view> fields = fields_of_line(line(i));
    return fields.size() >= 4 && fields.size() <= 5 && parse_int(fields[0]) && all_numbers(fields, 4);
  };
  if (counted_vector(2) && counted_vector(3) && counted_vector(4) && counted_vector(5)) return "cube";

  const std::vector<std::string_view> second = fields_of_line(line(1));
  // DL_POLY: a title, kinds of records and of the cell, the cell unless its kind is 0; then a name with a number, and
  // three numbers. A trajectory has its time before the cell.
  const auto kind = [&second](std::size_t i) { return i < second.size() ? parse_int(second[i]).value_or(-1) : -1; };
  if (kind(0) >= 0 && kind(0) <= 2 && kind(1) >= 0 && kind(1) <= 7) {
    const std::size_t cell_lines = kind(1) == 0 ? 0 : 3;
    const std::vector<std::string_view> name = fields_of_line(line(2 + cell_lines)),
                                        place = fields_of_line(line(3 + cell_lines));
    const bool is_atom = name.size() >= 2 && !parse_double(name[0]) && parse_int(name[1]);
    const bool has_cell = cell_lines == 0 || all_numbers(fields_of_line(line(2)), 3);
    if (line(2).starts_with("timestep ") || (is_atom && has_cell && place.size() == 3 && all_numbers(place, 3)))
      return "dlpoly";
  }

  // Amber: a title, a count (with a time), then six numbers on a line.
  if ((second.size() == 1 || second.size() == 2) && parse_int(second[0]) && fields_of_line(line(2)).size() == 6 &&
      all_numbers(fields_of_line(line(2)), 6))
    return "inpcrd";

  // Tinker: a count with a title, then number, name, three coordinates, type.
  const std::vector<std::string_view> first = fields_of_line(line(0)), atom = fields_of_line(line(1));
  if (!first.empty() && parse_int(first[0]) && atom.size() >= 6 && atom[0] == "1" && !parse_double(atom[1]) &&
      parse_double(atom[2]) && parse_double(atom[3]) && parse_double(atom[4]) && parse_int(atom[5]))
    return "tinker";
  return "";
}

// JSON: what `ase db` writes has numbered rows.
std::string_view by_braces(std::string_view text) {
  const std::string_view head = text.substr(0, 65536);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || head[first] != '{') return "";
  const bool numbered = trim(head.substr(first + 1)).substr(0, 16).find("\"1\"") != std::string_view::npos;
  if (numbered &&
      (head.find("\"unique_id\"") != std::string_view::npos || head.find("\"numbers\"") != std::string_view::npos))
    return "ase-json";
  return head.find("\"bihive_scene\"") == std::string_view::npos ? "json" : "";
}

}  // namespace

const ForeignFormat* foreign_before_all(std::string_view bytes) {
  // Letters of one byte with a zero beside each, or the mark of UTF-16 in either order.
  const std::string_view first = bytes.substr(0, 32);
  bool is_wide[2] = {first.size() >= 8, first.size() >= 8};
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t zero = 0; zero < 2; ++zero) is_wide[zero] = is_wide[zero] && (first[i] == '\0') == (i % 2 == zero);
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") || is_wide[0] || is_wide[1]) return named("utf16");

  const std::string_view head = bytes.substr(0, 65536);
  if (head.find('\0') != std::string_view::npos) return nullptr;
  if (head.find('\n') == std::string_view::npos && head.find('\r') != std::string_view::npos) return named("cr");

  // Three lengths, then three angles with the group.
  TextScanner scanner(head, "");
  if (!scanner.next_line() || !all_numbers(fields_of_line(scanner.line()), 3) || !scanner.next_line()) return nullptr;
  return scanner.line().find("SPGR") != std::string_view::npos ? named("cssr") : nullptr;
}

const ForeignFormat* foreign_by_content(std::string_view bytes) {
  for (const auto recognise : {by_mark, by_element, by_braces})
    if (const std::string_view key = recognise(bytes); !key.empty()) return named(key);
  if (bytes.substr(0, 65536).find('\0') != std::string_view::npos) return nullptr;
  if (const std::string_view key = by_lines(bytes); !key.empty()) return named(key);
  return nullptr;
}

const ForeignFormat* foreign_by_name(const std::string& name) {
  for (const ForeignFormat& known : kKnown)
    if (is_named_so(known.endings, name)) return &known;
  return nullptr;
}

}  // namespace bihive
