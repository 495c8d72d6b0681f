// LAMMPS data files [LAMMPS-data]: a comment, header lines (counts and the box), then sections. The atoms' columns
// follow from the style behind "Atoms #", else from their number.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "bihive/base/parse_number.h"
#include "bihive/base/readable.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/lammps_styles.h"
#include "bihive/io/text/fields.h"

namespace bihive {
namespace {

constexpr std::string_view kSections[] = {"Atoms",
                                          "Velocities",
                                          "Masses",
                                          "Ellipsoids",
                                          "Lines",
                                          "Triangles",
                                          "Bodies",
                                          "Bonds",
                                          "Angles",
                                          "Dihedrals",
                                          "Impropers",
                                          "Atom Type Labels",
                                          "Bond Type Labels",
                                          "Angle Type Labels",
                                          "Dihedral Type Labels",
                                          "Improper Type Labels",
                                          "Pair Coeffs",
                                          "PairIJ Coeffs",
                                          "Bond Coeffs",
                                          "Angle Coeffs",
                                          "Dihedral Coeffs",
                                          "Improper Coeffs",
                                          "BondBond Coeffs",
                                          "BondAngle Coeffs",
                                          "MiddleBondTorsion Coeffs",
                                          "EndBondTorsion Coeffs",
                                          "AngleTorsion Coeffs",
                                          "AngleAngleTorsion Coeffs",
                                          "BondBond13 Coeffs",
                                          "AngleAngle Coeffs"};

bool is_section(std::string_view line) {
  const std::string_view name = trim(line);
  for (const std::string_view section : kSections)
    if (name == section) return true;
  return false;
}

// Other sections have names too (those of fixes): words that begin with a capital letter.
bool may_be_section(std::string_view line) {
  const std::string_view name = trim(line);
  return !name.empty() && name[0] >= 'A' && name[0] <= 'Z';
}

class LammpsDataReader {
 public:
  LammpsDataReader(std::string_view text, const std::string& file) : scanner_(text, file) {
    spheres_.format = "LAMMPS data";
  }

  Result<RawSpheres> read() {
    if (scanner_.next_line()) read_title(scanner_.line());
    scanner_.set_comment('#');
    bool more = scanner_.next_filled_line();
    for (; more && !may_be_section(scanner_.line()); more = scanner_.next_filled_line())
      if (Status status = read_header_line(); !status) return status.error();
    while (more) {
      const std::string section(trim(scanner_.line()));
      if (!may_be_section(section))
        return scanner_.line_error("expected the name of a section but found " + quote(section),
                                   read_atoms_ ? "are there more atoms than the header says?" : "");
      if (is_section(section) && !seen_.insert(section).second)
        return scanner_.line_error("the section " + quote(section) + " comes twice");
      if (section == "Atoms") {
        if (Status status = read_atoms(); !status) return status.error();
        more = scanner_.next_filled_line();
      } else {
        Status (LammpsDataReader::*const read_line)() = section == "Masses"             ? &LammpsDataReader::read_mass
                                                        : section == "Atom Type Labels" ? &LammpsDataReader::read_label
                                                        : section == "Bonds"            ? &LammpsDataReader::read_bond
                                                                                        : nullptr;
        for (more = scanner_.next_filled_line(); more && !is_heading(); more = scanner_.next_filled_line())
          if (read_line != nullptr)
            if (Status status = (this->*read_line)(); !status) return status.error();
      }
    }
    if (!read_atoms_) return scanner_.line_error("the file ends without the section 'Atoms'");
    if (Status status = number_labels(); !status) return status.error();
    infer_elements();
    take_bonds();
    place_cell();
    return std::move(spheres_);
  }

 private:
  // Inside of a section that is left out, labels may begin lines, so only known names end it.
  bool is_heading() { return is_section(scanner_.line()); }

  // LAMMPS' write_data leaves there: "LAMMPS data file via write_data, version ..., timestep = 1000, units = lj".
  void read_title(std::string_view title) {
    const auto word_behind = [title](std::string_view key) {
      const std::size_t at = title.find(key);
      if (at == std::string_view::npos) return std::string_view();
      const std::string_view rest = title.substr(at + key.size());
      return trim(rest.substr(0, rest.find(',')));
    };
    if (const auto step = parse_int(word_behind("timestep = "))) spheres_.step = *step;
    units_ = printable(word_behind("units = "));
    if (!units_.empty())
      spheres_.rules.push_back("units: " + quote(units_) + " by the first line; lengths as they are");
  }

  Status read_header_line() {
    std::vector<std::string_view> words;
    std::vector<double> numbers;
    for (std::string_view field; words.size() < 8 && scanner_.next_field(field);) {
      const auto number = parse_double(field);
      if (words.empty() && number) {
        if (coordinate_fault(*number)) return scanner_.field_error(quote(field) + " " + coordinate_fault(*number));
        numbers.push_back(*number);
      } else {
        words.push_back(field);
      }
    }
    std::string keyword;
    for (const std::string_view word : words) keyword += (keyword.empty() ? "" : " ") + std::string(word);
    if (numbers.empty())
      return scanner_.line_error("expected a number and its name, or a section, but found " +
                                 quote(trim(scanner_.line())));

    // Counts.
    for (auto [name, target] : {std::pair{"atoms", &count_}, std::pair{"atom types", &types_}}) {
      if (keyword != name) continue;
      scanner_.restart_line();
      std::string_view field;
      scanner_.next_field(field);
      const auto count = parse_int(field);
      if (!count || *count < 0 || numbers.size() != 1)
        return scanner_.field_error("expected the number of " + keyword + " but found " + quote(field));
      if (*target) return scanner_.line_error("the number of " + keyword + " comes twice");
      *target = *count;
      return Done{};
    }

    // The box.
    const auto take = [&](auto& target) {
      if (numbers.size() != target.size())
        return Status(scanner_.line_error("expected " + std::to_string(target.size()) + " numbers before '" + keyword +
                                          "' but found " + std::to_string(numbers.size())));
      std::copy(numbers.begin(), numbers.end(), target.begin());
      has_box_ = true;
      return Status(Done{});
    };
    constexpr std::string_view bounds[3] = {"xlo xhi", "ylo yhi", "zlo zhi"}, edges[3] = {"avec", "bvec", "cvec"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (keyword == bounds[axis]) return take(bounds_[axis]);
      if (keyword == edges[axis]) {
        has_edges_ = true;
        return take(edges_[axis]);
      }
    }
    if (keyword == "xy xz yz") return take(tilts_);
    if (keyword == "abc origin") return take(origin_);
    // Counts of other things. Atoms with shapes have styles of their own.
    constexpr std::pair<std::string_view, std::string_view> shapes[] = {
        {"ellipsoids", "ellipsoid"}, {"lines", "line"}, {"triangles", "tri"}, {"bodies", "body"}};
    for (const auto& [name, style] : shapes)
      if (keyword == name && numbers[0] > 0) style_of_shapes_ = style;
    return Done{};
  }

  Status read_mass() {
    std::string_view type, field;
    scanner_.next_field(type);
    if (!scanner_.next_field(field)) return scanner_.line_error("expected a type and its mass");
    const auto mass = parse_double(field);
    if (!mass || !(*mass > 0) || !std::isfinite(*mass))
      return scanner_.field_error("expected the mass of type " + quote(type) + " but found " + quote(field));
    masses_[std::string(type)] = *mass;
    return Done{};
  }

  Status read_label() {
    const Result<std::int64_t> type = take_count(scanner_, "the number of an atom type");
    if (!type) return type.error();
    std::string_view label;
    if (!scanner_.next_field(label)) return scanner_.line_error("expected a type and its label");
    if (*type > std::numeric_limits<std::int32_t>::max())
      return scanner_.field_error("the type " + std::to_string(*type) + " is too large");
    type_of_label_[printable(label)] = static_cast<std::int32_t>(*type);
    return Done{};
  }

  // "id type atom1 atom2", where the type may be a label.
  Status read_bond() {
    std::string_view id, type;
    scanner_.next_field(id);
    scanner_.next_field(type);
    const Result<std::int64_t> one = take_count(scanner_, "the id of a bonded atom");
    if (!one) return one.error();
    const Result<std::int64_t> other = take_count(scanner_, "the id of a bonded atom");
    if (!other) return other.error();
    bonds_.emplace_back(*one, *other);
    return Done{};
  }

  // Atoms go by ids, which ascend unless some stands twice.
  void take_bonds() {
    const NamedNumbers* const ids = spheres_.attributes.find_numbers("id");
    if (ids == nullptr || bonds_.empty()) return;
    if (spheres_.ids == RowIds::repeated) {
      spheres_.warnings.push_back(scanner_.file() +
                                  ": its bonds are left out, as ids do not say which atoms they join");
      return;
    }
    std::int64_t lacking = 0;
    const auto position_of = [&](std::int64_t id) -> std::optional<std::int64_t> {
      const auto found = std::lower_bound(ids->values.begin(), ids->values.end(), static_cast<double>(id));
      if (found != ids->values.end() && *found == static_cast<double>(id)) return found - ids->values.begin() + 1;
      ++lacking;
      return std::nullopt;
    };
    for (const auto& [one, other] : bonds_) add_bond(spheres_, position_of(one), position_of(other));
    spheres_.attributes.bonds.are_all = !spheres_.attributes.bonds.empty();
    if (lacking > 0)
      spheres_.warnings.push_back(scanner_.file() + ": bonds name atoms that are not there, " +
                                  std::to_string(lacking) + (lacking == 1 ? " time" : " times") +
                                  "; these bonds are left out");
  }

  bool is_type(std::string_view field) const {
    const auto number = parse_int(field);
    return number ? *number >= 1 && *number <= types_.value_or(0) : type_of_label_.contains(printable(field));
  }

  Status read_atoms() {
    if (!count_) return scanner_.line_error("expected the number of atoms ('100 atoms') before the section 'Atoms'");
    // The style stands behind a number sign.
    scanner_.set_comment(0);
    const std::string heading(trim(scanner_.line()));
    scanner_.set_comment('#');
    const std::size_t mark = heading.find('#');
    std::string style(mark == std::string::npos ? std::string_view()
                                                : trim(std::string_view(heading).substr(mark + 1)));
    const std::int64_t heading_line = scanner_.line_number();
    const auto cut = [&](std::int64_t found) {
      return scanner_.line_error("the file ends in its atoms: expected " + std::to_string(*count_) + ", found " +
                                 std::to_string(found));
    };

    // The first atom shows whether there are image flags, and the style if it is not stated.
    read_atoms_ = true;
    if (*count_ == 0) return Done{};
    if (!scanner_.next_filled_line()) return cut(0);
    const bool stated = !style.empty();
    const LammpsAtomLines lines = look_at_atom_lines(scanner_, stated && !needs_all_lines(style) ? 1 : *count_,
                                                     [this](std::string_view field) { return is_type(field); });
    if (!stated) style = style_of_shapes_.empty() ? guess_lammps_style(lines) : style_of_shapes_;
    std::optional<std::vector<TableColumn>> columns = lammps_columns(style, lines);
    if (!columns && stated)
      return scanner_.line_error(
          "the atom style " + quote(style) + " behind 'Atoms' (line " + std::to_string(heading_line) + ") is not known",
          "known are " + lammps_style_names());
    if (!columns)
      return scanner_.line_error("no atom style is stated behind 'Atoms' (line " + std::to_string(heading_line) +
                                     "), and several or none have " + std::to_string(lines.fields) + " columns",
                                 "write the style there, as in 'Atoms # full'");
    const auto fields = static_cast<std::size_t>(lines.fields);
    if (fields == columns->size() + 3 && (style.rfind("hybrid", 0) != 0 || lines.ends_in_flags))
      for (const char* const flag : {"ix", "iy", "iz"}) columns->push_back({flag, ColumnRole::number});
    const bool is_open = style.rfind("hybrid", 0) == 0 && fields > columns->size();
    SphereTable table(*columns);
    if (is_open) table.allow_more_fields();
    if (const std::string fault = table.columns_fault(); !fault.empty()) return scanner_.line_error(fault);
    spheres_.rules.push_back("atom style: " + printable(style) +
                             (stated                     ? ""
                              : style_of_shapes_.empty() ? ", by the number of columns"
                                                         : ", by the header") +
                             " (" + table.column_names() + (is_open ? ", others are left out)" : ")"));

    // Read one line for each atom.
    table.reserve(*count_, scanner_.bytes_left());
    for (std::int64_t i = 0; i < *count_; ++i) {
      if (i > 0 && !scanner_.next_filled_line()) return cut(i);
      if (is_section(scanner_.line()))
        return scanner_.line_error("expected " + std::to_string(*count_) + " atoms but found " + std::to_string(i));
      if (Status row = table.add_row(scanner_); !row) return row;
    }
    const IdOrder order = table.sort_by_id();
    RawSpheres taken = std::move(table).take();
    note_id_order(order, scanner_.file(), std::nullopt, taken);
    taken.format = std::move(spheres_.format);
    taken.step = spheres_.step;
    taken.rules.insert(taken.rules.begin(), spheres_.rules.begin(), spheres_.rules.end());
    spheres_ = std::move(taken);
    return Done{};
  }

  // Types that stand in the file by their labels get the labels' numbers, and those by numbers the labels.
  Status number_labels() {
    if (type_of_label_.empty() || spheres_.size() == 0) return Done{};
    std::map<std::int32_t, std::string> label_of_type;
    for (const auto& [label, type] : type_of_label_) label_of_type.emplace(type, label);
    SphereAttributes& attributes = spheres_.attributes;
    const NamedTexts* const texts = attributes.find_texts("type");
    std::vector<std::int32_t> type_of_text;
    if (texts != nullptr)
      for (const std::string& text : texts->texts) {
        const auto found = type_of_label_.find(text);
        const auto number = parse_int(text);
        if (found == type_of_label_.end() && !(number && *number == static_cast<std::int32_t>(*number)))
          return scanner_.line_error("the type " + quote(text) + " is no number, and no label that the file states");
        type_of_text.push_back(found != type_of_label_.end() ? found->second : static_cast<std::int32_t>(*number));
      }
    TextCollector labels;
    labels.reserve(spheres_.size());
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      std::int32_t& type = attributes.type[i];
      if (texts != nullptr) type = type_of_text[static_cast<std::size_t>(texts->text_of_sphere[i])];
      const auto label = label_of_type.find(type);
      labels.add(label == label_of_type.end() ? std::to_string(type) : label->second);
    }
    std::erase_if(attributes.texts, [](const NamedTexts& column) { return column.name == "type"; });
    attributes.texts.push_back(printable_texts(labels.take("type")));
    return Done{};
  }

  // The number of a type as a mass names it; nothing: no atom has it.
  std::optional<std::int32_t> type_of_mass(const std::string& name) const {
    if (const auto found = type_of_label_.find(printable(name)); found != type_of_label_.end()) return found->second;
    const auto number = parse_int(name);
    if (number && *number == static_cast<std::int32_t>(*number)) return static_cast<std::int32_t>(*number);
    // A label that the file does not number.
    const NamedTexts* const texts = spheres_.attributes.find_texts("type");
    if (texts == nullptr) return std::nullopt;
    const auto text = std::find(texts->texts.begin(), texts->texts.end(), printable(name));
    const auto sphere = std::find(texts->text_of_sphere.begin(), texts->text_of_sphere.end(),
                                  static_cast<std::int32_t>(text - texts->texts.begin()));
    if (text == texts->texts.end() || sphere == texts->text_of_sphere.end()) return std::nullopt;
    return spheres_.attributes.type[static_cast<std::size_t>(sphere - texts->text_of_sphere.begin())];
  }

  // Types become elements if all their masses are those of elements. Models without a unit of mass have whole numbers.
  void infer_elements() {
    const std::vector<std::int32_t>& types = spheres_.attributes.type;
    bool all_whole = true;
    std::map<std::int32_t, int> element_of_type;
    std::string text;
    for (const auto& [name, mass] : masses_) {
      all_whole = all_whole && mass == std::floor(mass);
      const int element = element_of_mass(mass);
      if (element == 0) return;
      const auto type = type_of_mass(name);
      if (!type) continue;
      element_of_type[*type] = element;
      if (element_of_type.size() <= 8)
        text += (text.empty() ? "" : ", ") + printable(name) + " (" + readable_number(mass) + ") " +
                element_symbol(element);
    }
    if (element_of_type.empty() || all_whole || units_ == "lj") return;
    std::vector<std::uint8_t> elements;
    elements.reserve(types.size());
    for (const std::int32_t type : types) {
      const auto found = element_of_type.find(type);
      if (found == element_of_type.end()) return;
      elements.push_back(static_cast<std::uint8_t>(found->second));
    }
    spheres_.attributes.element = std::move(elements);
    spheres_.rules.push_back("elements: inferred from the masses, as the file states none: type " + text +
                             (element_of_type.size() > 8 ? ", ..." : ""));
  }

  void place_cell() {
    if (!has_box_) return;
    Cell cell;
    if (has_edges_) {
      cell.origin = {origin_[0], origin_[1], origin_[2]};
      for (std::size_t i = 0; i < 3; ++i) cell.vectors[i] = {edges_[i][0], edges_[i][1], edges_[i][2]};
    } else {
      cell.origin = {bounds_[0][0], bounds_[1][0], bounds_[2][0]};
      cell.vectors = {Vec3d{bounds_[0][1] - bounds_[0][0], 0, 0}, Vec3d{tilts_[0], bounds_[1][1] - bounds_[1][0], 0},
                      Vec3d{tilts_[1], tilts_[2], bounds_[2][1] - bounds_[2][0]}};
    }
    spheres_.cell = cell;
  }

  TextScanner scanner_;
  RawSpheres spheres_;
  std::string units_, style_of_shapes_;
  std::optional<std::int64_t> count_, types_;
  // LAMMPS takes these where the file says nothing.
  std::array<std::array<double, 2>, 3> bounds_{{{-0.5, 0.5}, {-0.5, 0.5}, {-0.5, 0.5}}};
  std::array<double, 3> tilts_{}, origin_{};
  std::array<std::array<double, 3>, 3> edges_{};
  bool has_box_ = false, has_edges_ = false, read_atoms_ = false;
  std::set<std::string> seen_;
  std::map<std::string, double> masses_;
  std::map<std::string, std::int32_t> type_of_label_;
  std::vector<std::pair<std::int64_t, std::int64_t>> bonds_;  // ids
};

bool is_lammps_data(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  // XYZ begins with a count, and its comment may be "3 atoms" too.
  if (!scanner.next_line() || parse_int(trim(scanner.line()))) return false;
  scanner.set_comment('#');
  for (int line = 0; line < 30 && scanner.next_filled_line(); ++line) {
    std::string_view count, name, more;
    if (scanner.next_field(count) && parse_int(count) && scanner.next_field(name) && name == "atoms" &&
        !scanner.next_field(more))
      return true;
  }
  return false;
}

Result<RawSpheres> read_lammps_data(std::string_view text, const std::string& file, std::int64_t frame) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return LammpsDataReader(text, file).read();
}

}  // namespace

extern constexpr Format kLammpsData(
    "LAMMPS data", ".lmp .lammps", Format::kText, is_lammps_data, read_lammps_data,
    "`N atoms` on a line of the head | atoms of every style, the box, image flags | the "
    "file's diameters, else by element where masses tell it, else from distances");

}  // namespace bihive
