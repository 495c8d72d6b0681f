// PDB, fixed columns [wwPDB-3.3]. This reader does not use gemmi's PDB reader. That one sorts atoms into chains and
// residues (file order is lost), reads a coordinate that is no number as 0, and stops at the line numbers of the older
// format.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/alternates.h"
#include "bihive/io/formats/molecules/atom_columns.h"
#include "bihive/io/formats/molecules/pdb_assemblies.h"
#include "bihive/io/formats/molecules/pdb_bonds.h"
#include "bihive/io/formats/molecules/pdb_columns.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/formats/molecules/pdb_title.h"
#include "bihive/io/formats/molecules/pqr_line.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

class PdbReader {
 public:
  PdbReader(const TextScanner& scanner, const FramePass& pass) : scanner_(scanner), pass_(pass), frame_(pass.wanted) {
    spheres_.format = "PDB";
  }

  Result<RawSpheres> read() {
    // Models lie between MODEL and ENDMDL. Simulations separate models by ENDMDL or END alone.
    FrameNotes notes(pass_.made, scanner_);
    bool in_model = false, any_cell = false;
    std::int64_t models = pass_.first;
    for (std::int64_t begin = scanner_.place(); scanner_.next_line(); begin = scanner_.place()) {
      const std::string_view record = scanner_.line().substr(0, 6);
      if (record.substr(0, 4) == "ATOM" || record == "HETATM") {
        if (!in_model) ++models;
        in_model = true;
        if (models - 1 != frame_) continue;
        if (Status atom = read_atom(); !atom) return atom.error();
      } else if (record == "REMARK" && pdb_columns(scanner_.line(), 8, 10) == "350") {
        if (pass_.index != nullptr) continue;
        assemblies_.add_line(scanner_.line());
        if (pass_.made != nullptr) note_line(pass_.made->assembly_lines, begin);
      } else if (record == "CRYST1") {
        if (pass_.index != nullptr) continue;
        // The last cell before the model's end counts. Where there is none, the first behind it does.
        const bool is_behind = models - 1 > frame_ || (models - 1 == frame_ && !in_model);
        if (!is_behind || !any_cell) read_cell(scanner_.line());
        any_cell = true;
        if (pass_.made != nullptr)
          pass_.made->cell_lines.push_back({begin, scanner_.place(), scanner_.line_number() - 1});
      } else if (record == "CONECT") {
        if (pass_.index != nullptr) continue;
        bonds_.add_line(scanner_.line());
        if (pass_.made != nullptr) note_line(pass_.made->bond_lines, begin);
      } else if (record == "ENDMDL" || trim(record) == "MODEL" || trim(record) == "END") {
        if (in_model) notes.end_frame(scanner_);
        in_model = false;
      } else if (models == 0 && pass_.index == nullptr) {
        title_.add_line(scanner_.line());
      }
    }
    if (in_model) notes.end_frame(scanner_);
    if (models == 0) return Error{"there is no ATOM or HETATM record in it", scanner_.file(), 0, 0, ""};
    if (pass_.reads_none()) return std::move(spheres_);
    if (frame_ < 0 || frame_ >= models) return no_such_frame(scanner_.file(), frame_, models);
    if (pass_.index != nullptr) take_lines_of_index();
    finish(pass_.index != nullptr ? pass_.index->count() : models);
    return std::move(spheres_);
  }

 private:
  // CRYST1 in its columns, else as fields. Lengths of 1 or 0, or none, stand for no crystal.
  void read_cell(std::string_view line) {
    std::array<double, 6> six{};
    constexpr std::array<std::array<std::size_t, 2>, 6> kColumns{
        {{7, 15}, {16, 24}, {25, 33}, {34, 40}, {41, 47}, {48, 54}}};
    for (std::size_t i = 0; i < 6; ++i)
      six[i] = parse_double(trim(pdb_columns(line, kColumns[i][0], kColumns[i][1]))).value_or(0);
    cell_warning_.clear();
    spheres_.cell.reset();
    const std::string_view numbers = trim(line.substr(std::min<std::size_t>(line.size(), 6)));
    if (numbers.empty()) return;
    if (six[0] == 1 && is_placeholder_cell(six)) return;
    spheres_.cell = unit_cell(six);
    if (spheres_.cell) return;
    const std::optional<std::array<double, 6>> fields = six_fields(numbers);
    if (fields && is_placeholder_cell(*fields)) return;
    if (fields) spheres_.cell = unit_cell(*fields);
    cell_warning_ = spheres_.cell ? "CRYST1 does not keep to its columns; its first six fields are taken as the cell"
                                  : "CRYST1 states no cell that can be read, so there is none";
  }

  static std::optional<std::array<double, 6>> six_fields(std::string_view text) {
    std::array<double, 6> six{};
    TextScanner scanner(text, "");
    scanner.next_line();
    std::string_view field;
    for (double& number : six) {
      scanner.next_field(field);
      const auto parsed = parse_double(field);
      if (!parsed) return std::nullopt;
      number = *parsed;
    }
    return six;
  }

  // Runs of lines become one place.
  void note_line(PlaceList& places, std::int64_t begin) {
    if (places.empty() || places.back().end != begin) places.push_back({begin, begin, scanner_.line_number() - 1});
    places.set_last_end(scanner_.place());
  }

  // Lines elsewhere in the file that are true of this model too.
  void take_lines_of_index() {
    const FrameIndex& index = *pass_.index;
    const auto for_lines = [&](const TextPlace& place, const auto& take) {
      FileText part{*pass_.file, place.begin, place.end, place.lines_before, {}};
      TextScanner lines(part);
      while (lines.next_line()) take(lines.line());
    };
    for (const TextPlace& place : index.assembly_lines)
      for_lines(place, [this](std::string_view line) { assemblies_.add_line(line); });
    for (const TextPlace& place : index.bond_lines)
      for_lines(place, [this](std::string_view line) { bonds_.add_line(line); });
    take_title_of_file();
    if (index.cell_lines.empty()) return;
    const std::int64_t end = index.frames[static_cast<std::size_t>(frame_)].end;
    // The last cell before the model's end, or the first one.
    std::size_t first = 0, behind = index.cell_lines.size();
    while (first < behind) {
      const std::size_t middle = first + (behind - first) / 2;
      if (index.cell_lines[middle].begin < end)
        first = middle + 1;
      else
        behind = middle;
    }
    for_lines(index.cell_lines[first - std::min<std::size_t>(first, 1)],
              [this](std::string_view line) { read_cell(line); });
  }

  void take_title_of_file() {
    FileText head{*pass_.file, 0, pass_.index->frames[0].end, 0, {}};
    for (TextScanner lines(head); lines.next_line();) {
      const std::string_view record = lines.line().substr(0, 6);
      if (record.substr(0, 4) == "ATOM" || record == "HETATM") return;
      title_.add_line(lines.line());
    }
  }

  Status read_atom() {
    const std::string_view line = scanner_.line();
    const ColumnShift shift = column_shift(line);
    if (!shift) return read_columns(line, trim(pdb_columns(line, 7, 11)), trim(pdb_columns(line, 23, 26)));
    if (shifted_++ == 0) first_shifted_line_ = scanner_.line_number();
    return read_columns(without_shift(line, shift), shifted_serial(line, shift), shifted_residue_number(line, shift));
  }

  Status read_columns(std::string_view line, std::string_view serial, std::string_view residue_number) {
    // The coordinates are required.
    std::vector<double>* const axes[3] = {&spheres_.x, &spheres_.y, &spheres_.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t first = 31 + 8 * axis;
      const std::string name(1, static_cast<char>('x' + axis));
      const std::string_view field = trim(pdb_columns(line, first, first + 7));
      const auto value = parse_double(field);
      const auto bad = [&](const std::string& what) {
        return scanner_.column_error(static_cast<std::int64_t>(first), what);
      };
      if (!value)
        return bad("expected a number for " + name + " in columns " + std::to_string(first) + " to " +
                   std::to_string(first + 7) + " but found " + quote(field));
      if (const char* fault = coordinate_fault(*value)) return bad(name + " " + fault + ": " + quote(field));
      // A line that ends within the columns of a number would change it.
      if (line.size() < first + 7)
        return scanner_.column_error(
            static_cast<std::int64_t>(first),
            "expected " + name + " in columns " + std::to_string(first) + " to " + std::to_string(first + 7) +
                ", but the line ends in column " + std::to_string(line.size()),
            scanner_.at_end() && !scanner_.ends_in_newline() ? "the file is cut on this line" : "");
      axes[axis]->push_back(*value);
    }
    const ResidueAndChain of = residue_names_.of(line);
    elements_.add({pdb_columns(line, 77, 78), pdb_columns(line, 13, 16), trim(pdb_columns(line, 18, 21)),
                   pdb_columns(line, 18, 27), scanner_.line_number()});

    // All else is optional.
    const double occupancy = optional_number(pdb_columns(line, 55, 60), 1);
    AtomNames names;
    names.record = line.substr(0, 4) == "ATOM" ? "ATOM" : "HETATM";
    names.serial = serial;
    names.chain = of.chain;
    names.residue_number = residue_number;
    names.insertion = trim(pdb_columns(line, 27, 27));
    names.residue = of.residue;
    names.name = trim(pdb_columns(line, 13, 16));
    columns_.add(names, occupancy, optional_number(pdb_columns(line, 61, 66), 0));

    // A residue is named by its chain and number with insertion code.
    if (const char mark = line[16]; mark != ' ') {
      const std::string residue =
          std::string(of.chain) + ' ' + std::string(residue_number) + std::string(names.insertion);
      alternates_.add({residue, of.residue, pdb_columns(line, 13, 16), mark, occupancy}, spheres_.size() - 1);
    }
    return Done{};
  }

  double optional_number(std::string_view field, double missing) {
    field = trim(field);
    if (field.empty()) return missing;
    if (const auto value = parse_double(field)) return *value;
    if (unreadable_++ == 0) first_unreadable_line_ = scanner_.line_number();
    return std::numeric_limits<double>::quiet_NaN();
  }

  void finish(std::int64_t models) {
    spheres_.frames = models;
    spheres_.title = title_.title();
    spheres_.entry_id = title_.entry_id();
    spheres_.rules.push_back("atoms: ATOM and HETATM records of model " + std::to_string(frame_) + " (from 0)");
    elements_.take(spheres_, scanner_.file());
    columns_.take(spheres_.attributes);
    spheres_.assemblies = assemblies_.take();
    alternates_.remove_from(spheres_);
    bonds_.take(spheres_);
    if (!cell_warning_.empty()) spheres_.warnings.push_back(scanner_.file() + ": " + cell_warning_);
    if (shifted_ > 0)
      spheres_.warnings.push_back(scanner_.file() + ":" + std::to_string(first_shifted_line_) + ": " +
                                  std::to_string(shifted_) + (shifted_ == 1 ? " atom has" : " atoms have") +
                                  " a number with more digits than its columns hold; what follows it is read by the "
                                  "shift that the line shows");
    if (unreadable_ > 0)
      spheres_.warnings.push_back(scanner_.file() + ":" + std::to_string(first_unreadable_line_) + ": " +
                                  std::to_string(unreadable_) +
                                  " occupancies or B factors are no numbers and are taken as unknown");
  }

  TextScanner scanner_;
  FramePass pass_;
  std::int64_t frame_;
  RawSpheres spheres_;
  AtomColumns columns_;
  PdbElements elements_{true};
  Alternates alternates_;
  PdbAssemblies assemblies_;
  PdbBonds bonds_;
  PdbTitle title_;
  ResidueNames residue_names_;
  std::string cell_warning_;
  std::int64_t unreadable_ = 0;
  std::int64_t first_unreadable_line_ = 0;
  std::int64_t shifted_ = 0, first_shifted_line_ = 0;
};

Result<RawSpheres> read_pdb(const TextScanner& scanner, const FramePass& pass) {
  return PdbReader(scanner, pass).read();
}

}  // namespace

extern constexpr Format kPdb(
    "PDB", ".pdb .ent", Format::kText | Format::kFrames,
    [](const FileHead& head) { return is_pdb_record(head.text.line()); }, read_pdb,
    "the name of a record | ATOM and HETATM of one model; the likeliest of alternate locations | van der Waals, by "
    "element",
    0);

}  // namespace bihive
