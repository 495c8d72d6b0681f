// LAMMPS dump in text [LAMMPS-dump]: sections that begin with "ITEM:", repeated for every frame.
#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

// Scaled coordinates s stand for origin + s.x a + s.y b + s.z c.
using Box = Cell;

// The coordinate columns that a frame may have, in the order in which they are preferred.
struct Naming {
  std::string_view names[3];
  bool scaled;
  const char* rule;
};
constexpr Naming kNamings[] = {
    {{"x", "y", "z"}, false, "coordinates: x y z"},
    {{"xu", "yu", "zu"}, false, "coordinates: unwrapped, xu yu zu"},
    {{"xs", "ys", "zs"}, true, "coordinates: scaled, xs ys zs, brought into the box"},
    {{"xsu", "ysu", "zsu"}, true, "coordinates: scaled and unwrapped, xsu ysu zsu, brought to the box's scale"},
};
constexpr Naming kChosenCoordinates = {{}, false, "coordinates: columns as asked for"};

// Picoseconds of the units of time that LAMMPS has [LAMMPS-units]; those of `lj` have none.
struct Units {
  std::string_view name;
  double picoseconds;
};
constexpr Units kUnits[] = {{"real", 1e-3},     {"metal", 1},   {"si", 1e12}, {"cgs", 1e12},
                            {"electron", 1e-3}, {"micro", 1e6}, {"nano", 1e3}};

class LammpsReader {
 public:
  LammpsReader(const TextScanner& scanner, const FramePass& pass)
      : scanner_(scanner), pass_(pass), wanted_(pass.wanted), frames_(pass.first), notes_(pass.made, scanner_) {
    if (pass.file != nullptr) find_units(*pass.file);
  }

  Result<RawSpheres> read() {
    while (scanner_.next_filled_line())
      if (Status section = read_section(); !section) return section.error();
    if (in_frame_) return cut("ITEM: ATOMS and one line an atom");
    if (pass_.reads_none()) return std::move(spheres_);
    if (wanted_ < 0 || wanted_ >= frames_) return no_such_frame(scanner_.file(), wanted_, frames_);
    spheres_.format = "LAMMPS dump";
    spheres_.frames = pass_.index != nullptr ? pass_.index->count() : frames_;
    return std::move(spheres_);
  }

 private:
  Status read_section() {
    const std::string_view line = trim(scanner_.line());
    if (line.substr(0, 5) != "ITEM:")
      return scanner_.line_error("expected a line that begins with 'ITEM:' but found " + quote(line));
    const std::string_view item = trim(line.substr(5));
    if (item == "TIMESTEP") return read_timestep();
    if (item == "NUMBER OF ATOMS") return read_count();
    if (item.substr(0, 10) == "BOX BOUNDS") return read_box(item);
    if (item.substr(0, 5) == "ATOMS") return read_atoms(item);
    if (item == "UNITS") return read_units();
    if (item == "TIME") return read_time();
    return scanner_.line_error("expected ITEM: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS or ATOMS but found " +
                               quote(line));
  }

  // The error for a text that ends too early.
  Error cut(const std::string& expected) const {
    return scanner_.line_error("the file ends in frame " + std::to_string(frames_) + ": expected " + expected);
  }

  Status read_timestep() {
    if (in_frame_)
      return scanner_.line_error("expected ITEM: ATOMS of frame " + std::to_string(frames_) + " before the next frame");
    in_frame_ = true;
    if (!scanner_.next_line()) return cut("the time step");
    std::string_view field;
    if (!scanner_.next_field(field) || !parse_double(field))
      return scanner_.field_error("expected the time step but found " + quote(field));
    step_ = parse_int(field);
    return Done{};
  }

  // They stand at the beginning of the file, which the bytes of a later frame do not have.
  void find_units(const RandomFile& file) {
    constexpr std::int64_t kLook = 256;
    FileText head{file, 0, std::min(kLook, file.size()), 0, {}};
    TextScanner scanner(head);
    if (scanner.next_filled_line() && trim(scanner.line()) == "ITEM: UNITS" && scanner.next_line())
      units_ = printable(trim(scanner.line()));
  }

  Status read_units() {
    if (!scanner_.next_line()) return cut("the units");
    units_ = printable(trim(scanner_.line()));
    return Done{};
  }

  // Before the time step, or after it.
  Status read_time() {
    if (!scanner_.next_line()) return cut("the time");
    std::string_view field;
    if (scanner_.next_field(field)) time_ = parse_double(field);
    if (!time_ || !std::isfinite(*time_)) return scanner_.field_error("expected the time but found " + quote(field));
    return Done{};
  }

  void take_time() {
    if (!time_) return;
    const auto* const units =
        std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Units& one) { return one.name == units_; });
    const bool is_known = units != std::end(kUnits);
    spheres_.time_ps = *time_ * (is_known ? units->picoseconds : 1);
    spheres_.rules.push_back(is_known         ? "time: picoseconds, from units " + units_
                             : units_.empty() ? "time: taken as picoseconds, as the file names no units"
                                              : "time: as it stands there, in units " + units_);
  }

  Status read_count() {
    if (!scanner_.next_line()) return cut("the number of atoms");
    std::string_view field;
    scanner_.next_field(field);
    count_ = parse_int(field);
    count_line_ = scanner_.line_number();
    if (!count_ || *count_ < 0) return scanner_.field_error("expected the number of atoms but found " + quote(field));
    return Done{};
  }

  // Three lines of numbers. Orthogonal: lo hi. Triclinic (xy xz yz): lo hi tilt, where lo and hi are those of the box
  // around the tilted one. General triclinic (abc origin): an edge and a coordinate of the origin.
  //
  // The line of the item ends in two letters for each direction: p p if it is periodic. Without them all are.
  Status read_box(std::string_view item) {
    const bool general = item.find("abc origin") != std::string_view::npos;
    const bool tilted = item.find("xy xz yz") != std::string_view::npos;
    const int width = general ? 4 : tilted ? 3 : 2;
    double v[3][4] = {};
    for (auto& row : v) {
      if (!scanner_.next_line()) return cut("three lines of box bounds");
      for (int i = 0; i < width; ++i) {
        std::string_view field;
        scanner_.next_field(field);
        const auto value = parse_double(field);
        if (!value || coordinate_fault(*value))
          return scanner_.field_error("expected " + std::to_string(width) + " numbers of the box but found " +
                                      quote(field));
        row[i] = *value;
      }
    }
    if (general) {
      box_ = Box{{v[0][3], v[1][3], v[2][3]},
                 {Vec3d{v[0][0], v[0][1], v[0][2]}, Vec3d{v[1][0], v[1][1], v[1][2]}, Vec3d{v[2][0], v[2][1], v[2][2]}},
                 periodic_of(item)};
      return Done{};
    }
    // Remove the tilt from the bounds [LAMMPS-triclinic].
    const double xy = v[0][2], xz = v[1][2], yz = v[2][2];
    const double xlo = v[0][0] - std::min({0.0, xy, xz, xy + xz});
    const double xhi = v[0][1] - std::max({0.0, xy, xz, xy + xz});
    const double ylo = v[1][0] - std::min(0.0, yz);
    const double yhi = v[1][1] - std::max(0.0, yz);
    const double zlo = v[2][0], zhi = v[2][1];
    box_ = Box{{xlo, ylo, zlo},
               {Vec3d{xhi - xlo, 0, 0}, Vec3d{xy, yhi - ylo, 0}, Vec3d{xz, yz, zhi - zlo}},
               periodic_of(item)};
    return Done{};
  }

  static std::array<bool, 3> periodic_of(std::string_view item) {
    std::vector<std::string_view> words;
    TextScanner scanner(item, "");
    scanner.next_line();
    for (std::string_view word; scanner.next_field(word);) words.push_back(word);
    std::array<bool, 3> periodic{true, true, true};
    if (words.size() < 3) return periodic;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view letters = words[words.size() - 3 + k];
      if (letters.size() != 2 || letters.find_first_not_of("pfsm") != std::string_view::npos) return {true, true, true};
      periodic[k] = letters == "pp";
    }
    return periodic;
  }

  Status read_atoms(std::string_view item) {
    // Find the role of each column.
    if (!count_) return scanner_.line_error("expected ITEM: NUMBER OF ATOMS before ITEM: ATOMS");
    std::vector<TableColumn> columns;
    TextScanner header(item.substr(5), "");
    header.next_line();
    for (std::string_view name; columns.size() <= SphereTable::kMostColumns && header.next_field(name);)
      columns.push_back({std::string(name), ColumnRole::number});
    const bool asked_for = chooses_places(pass_.columns);
    const Naming* naming = asked_for ? nullptr : choose_coordinates(columns);
    if (asked_for)
      for (TableColumn& column : columns) column.role = usual_role(column.name);
    if (const std::string fault = choose_columns(pass_.columns, columns); !fault.empty())
      return scanner_.line_error(fault);
    if (asked_for) naming = naming_of(columns);
    if (!naming)
      return scanner_.line_error("expected columns x y z, xu yu zu, xs ys zs or xsu ysu zsu but found " +
                                 quote(trim(item.substr(5))));
    if (naming->scaled && !box_) return scanner_.line_error("scaled coordinates need ITEM: BOX BOUNDS before them");
    SphereTable table(columns);
    if (const std::string fault = table.columns_fault(); !fault.empty()) return scanner_.line_error(fault);

    // Read the atoms of the wanted frame. Skip those of other frames, but check the last line.
    const bool wanted = frames_ == wanted_;
    if (wanted) table.reserve(*count_, scanner_.bytes_left());
    std::int64_t found = 0;
    const std::int64_t first_line = scanner_.line_number() + 1;
    if (wanted) {
      const Result<std::int64_t> rows = table.add_rows(scanner_, *count_, SphereTable::RowLines::all);
      if (!rows) return rows.error();
      found = *rows;
    }
    for (; !wanted && found < *count_ && scanner_.next_line(); ++found)
      if (scanner_.at_end())
        if (Status width = table.check_width(scanner_); !width) return width;
    if (found < *count_)
      return cut(std::to_string(*count_) + " atoms (line " + std::to_string(count_line_) + ") but found " +
                 std::to_string(found));
    if (wanted) {
      const IdOrder order = table.sort_by_id();
      spheres_ = std::move(table).take();
      note_id_order(order, scanner_.file(), first_line, spheres_);
      spheres_.rules.insert(spheres_.rules.begin(), naming->rule);
      if (naming->scaled) unscale();
      spheres_.cell = box_;
      spheres_.step = step_;
      take_time();
    }

    // The frame is complete.
    notes_.end_frame(scanner_);
    in_frame_ = false;
    ++frames_;
    step_.reset();
    time_.reset();
    count_.reset();
    box_.reset();
    return Done{};
  }

  // Gives the columns their roles; nullptr if there is no complete set of coordinates.
  static const Naming* choose_coordinates(std::vector<TableColumn>& columns) {
    constexpr ColumnRole axes[3] = {ColumnRole::x, ColumnRole::y, ColumnRole::z};
    for (const Naming& naming : kNamings) {
      bool complete = true;
      for (const std::string_view name : naming.names)
        complete = complete && std::any_of(columns.begin(), columns.end(),
                                           [name](const TableColumn& column) { return column.name == name; });
      if (!complete) continue;
      for (TableColumn& column : columns) {
        const ColumnRole role = usual_role(column.name);
        const bool is_axis = role == ColumnRole::x || role == ColumnRole::y || role == ColumnRole::z;
        column.role = is_axis ? ColumnRole::number : role;
        for (int axis = 0; axis < 3; ++axis)
          if (column.name == naming.names[axis]) column.role = axes[axis];
      }
      return &naming;
    }
    return nullptr;
  }

  // The naming of the columns that the user has chosen as coordinates.
  static const Naming* naming_of(const std::vector<TableColumn>& columns) {
    constexpr ColumnRole axes[3] = {ColumnRole::x, ColumnRole::y, ColumnRole::z};
    for (const Naming& naming : kNamings) {
      bool same = true;
      for (int axis = 0; axis < 3; ++axis)
        same = same && std::any_of(columns.begin(), columns.end(), [&](const TableColumn& column) {
                 return column.role == axes[axis] && column.name == naming.names[axis];
               });
      if (same) return &naming;
    }
    return &kChosenCoordinates;
  }

  void unscale() {
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const Vec3d s{spheres_.x[i], spheres_.y[i], spheres_.z[i]};
      const auto& [a, b, c] = box_->vectors;
      const Vec3d p = box_->origin + s.x * a + s.y * b + s.z * c;
      spheres_.x[i] = p.x;
      spheres_.y[i] = p.y;
      spheres_.z[i] = p.z;
    }
  }

  TextScanner scanner_;
  FramePass pass_;
  std::int64_t wanted_;
  std::int64_t frames_;
  FrameNotes notes_;
  bool in_frame_ = false;
  std::optional<std::int64_t> step_, count_;
  std::optional<double> time_;
  std::string units_;
  std::int64_t count_line_ = 0;
  std::optional<Box> box_;
  RawSpheres spheres_;
};

Result<RawSpheres> read_lammps_dump(const TextScanner& scanner, const FramePass& pass) {
  return LammpsReader(scanner, pass).read();
}

}  // namespace

extern constexpr Format kLammpsDump(
    "LAMMPS dump", ".dump .lammpstrj", Format::kText | Format::kFrames | Format::kColumns | Format::kParts,
    [](const FileHead& head) { return trim(head.text.line()).substr(0, 5) == "ITEM:"; }, read_lammps_dump,
    "`ITEM:` | one frame; columns by name; scaled, unwrapped and triclinic coordinates | column, else by element, else "
    "from distances",
    5);

}  // namespace bihive
