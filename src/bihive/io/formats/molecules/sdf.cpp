// Molecules in MDL's formats [CTfile]: MOL files and the records of SDF, V2000 (fixed columns) and V3000 (fields). Each
// record of an SDF is a frame.
#include <algorithm>
#include <map>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/text/continued_lines.h"
#include "bihive/io/text/fields.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

constexpr std::string_view kSdfFiles = ".sdf .sd .mol";

// The columns of a line, counted from 0; less where the line ends.
std::string_view columns_of_line(std::string_view line, std::size_t first, std::size_t width) {
  return first < line.size() ? trim(line.substr(first, width)) : std::string_view();
}

int element_of_symbol(std::string_view symbol) {
  return symbol == "T" ? 1 : atomic_number(symbol);
}

bool is_end_of_record(std::string_view line) {
  return line.substr(0, 4) == "$$$$";
}

// The characters up to those behind "M  V30 ". Some programs write one blank where the format has two.
std::size_t v3000_prefix(std::string_view line) {
  constexpr std::size_t kNone = std::string_view::npos;
  const std::size_t tag = line.substr(0, 1) == "M" ? line.find_first_not_of(' ', 1) : kNone;
  if (tag == kNone || tag == 1 || line.substr(tag, 3) != "V30") return kNone;
  return std::min(tag + 4, line.size());
}

// A line of V3000 that ends in "-" goes on in the next one.
constexpr Continuation kV3000Lines{'-', "", [](std::string_view line) { return v3000_prefix(line) != line.npos; },
                                   v3000_prefix};

class SdfReader {
 public:
  SdfReader(std::string_view text, const std::string& file, std::int64_t wanted)
      : scanner_(text, file), wanted_(wanted) {
    spheres_.format = "SDF";
  }

  Result<RawSpheres> read() {
    std::int64_t frames = 0;
    while (next_record()) {
      if (Status record = read_record(frames == wanted_); !record) return record.error();
      ++frames;
      // The data behind the molecule.
      while (!is_end_of_record(scanner_.line()) && scanner_.next_line()) {
      }
    }
    if (wanted_ < 0 || wanted_ >= frames) return no_such_frame(scanner_.file(), wanted_, frames);
    spheres_.frames = frames;
    finish();
    return std::move(spheres_);
  }

 private:
  // Goes to the first line of a record, which may be empty. Behind the last one only blank lines may follow.
  bool next_record() {
    if (!scanner_.next_line()) return false;
    if (!trim(scanner_.line()).empty()) return true;
    TextScanner ahead(scanner_);
    return ahead.next_filled_line();
  }

  Error cut(const std::string& expected) const {
    return scanner_.line_error("the file ends inside a molecule: expected " + expected);
  }

  Status read_record(bool wanted) {
    if (wanted) spheres_.title = title_from(scanner_.line());
    for (int line = 0; line < 3; ++line)
      if (!scanner_.next_line()) return cut("three lines of names and a line of counts");
    const std::string_view line = scanner_.line();
    const bool v3000 = line.find("V3000") != std::string_view::npos;
    if (v3000) return read_v3000(wanted);

    const auto atoms = parse_int(columns_of_line(line, 0, 3)), bonds = parse_int(columns_of_line(line, 3, 3));
    if (!atoms || *atoms < 0 || !bonds || *bonds < 0)
      return scanner_.column_error(
          1, "expected the numbers of atoms and bonds in columns 1 to 6 but found " + quote(line.substr(0, 6)));
    const std::int64_t counts_line = scanner_.line_number();
    for (std::int64_t i = 0; i < *atoms; ++i) {
      if (!scanner_.next_line() || is_end_of_record(scanner_.line()) || scanner_.line().substr(0, 6) == "M  END")
        return scanner_.line_error("the molecule ends too early: line " + std::to_string(counts_line) + " promises " +
                                   std::to_string(*atoms) + " atoms, but there are " + std::to_string(i));
      if (!wanted) continue;
      if (Status atom = read_atom(); !atom) return atom;
    }
    for (std::int64_t i = 0; i < *bonds; ++i) {
      if (!scanner_.next_line()) return cut(std::to_string(*bonds) + " bonds");
      const std::string_view bond = scanner_.line();
      if (!wanted) continue;
      add_stated_bond(parse_int(columns_of_line(bond, 0, 3)), parse_int(columns_of_line(bond, 3, 3)),
                      parse_int(columns_of_line(bond, 6, 3)));
    }
    return read_properties(wanted);
  }

  // Types from 5 on are those of queries, 9 is a coordination, and 10 a hydrogen bond, which is none here.
  void add_stated_bond(std::optional<std::int64_t> one, std::optional<std::int64_t> other,
                       std::optional<std::int64_t> type) {
    constexpr BondOrder kOrders[] = {BondOrder::unknown, BondOrder::single, BondOrder::double_bond, BondOrder::triple,
                                     BondOrder::aromatic};
    const std::int64_t stated = type.value_or(0);
    if (stated != 10) add_bond(spheres_, one, other, kOrders[stated >= 0 && stated <= 4 ? stated : 0]);
  }

  // x, y and z in ten columns each, a symbol of three, then codes for isotope and charge.
  Status read_atom() {
    const std::string_view line = scanner_.line();
    Vec3d at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view field = columns_of_line(line, 10 * axis, 10);
      const auto value = parse_double(field);
      const std::string what = std::string(1, "xyz"[axis]);
      const auto column = static_cast<std::int64_t>(10 * axis + 1);
      if (!value)
        return scanner_.column_error(column, "expected a number for " + what + " in columns " +
                                                 std::to_string(10 * axis + 1) + " to " +
                                                 std::to_string(10 * axis + 10) + " but found " + quote(field));
      if (const char* fault = coordinate_fault(*value))
        return scanner_.column_error(column, what + " " + fault + ": " + quote(field));
      at[static_cast<int>(axis)] = *value;
    }
    const std::string_view symbol = columns_of_line(line, 31, 3);
    if (symbol.empty()) return scanner_.column_error(32, "expected a symbol in columns 32 to 34 but found none");
    const auto code = parse_int(columns_of_line(line, 36, 3)).value_or(0);
    add(at, symbol, code >= 1 && code <= 7 && code != 4 ? double(4 - code) : 0);
    return Done{};
  }

  void add(Vec3d at, std::string_view symbol, double charge) {
    spheres_.x.push_back(at.x);
    spheres_.y.push_back(at.y);
    spheres_.z.push_back(at.z);
    spheres_.attributes.element.push_back(static_cast<std::uint8_t>(element_of_symbol(symbol)));
    symbols_.add(symbol);
    charge_.values.push_back(charge);
  }

  // "M  CHG  n  aaa vvv ...": the charges of n atoms; then those codes in the atoms' lines do not count.
  Status read_properties(bool wanted) {
    bool first = true;
    while (scanner_.next_line()) {
      const std::string_view line = scanner_.line();
      if (line.substr(0, 6) == "M  END" || is_end_of_record(line)) return Done{};
      const bool charges = line.substr(0, 6) == "M  CHG";
      if (!wanted || (!charges && line.substr(0, 6) != "M  RAD")) continue;
      if (first) std::fill(charge_.values.begin(), charge_.values.end(), 0);
      first = false;
      if (!charges) continue;
      std::string_view field;
      scanner_.next_field(field);
      scanner_.next_field(field);
      const Result<std::int64_t> count = take_count(scanner_, "a number of charges");
      if (!count) return count.error();
      for (std::int64_t i = 0; i < *count; ++i) {
        const Result<std::int64_t> atom = take_count(scanner_, "the number of an atom");
        if (!atom) return atom.error();
        const Result<double> charge = take_number(scanner_, "a charge");
        if (!charge) return charge.error();
        if (*atom < 1 || *atom > static_cast<std::int64_t>(charge_.values.size()))
          return scanner_.line_error("there is no atom " + std::to_string(*atom) + " in the molecule");
        charge_.values[static_cast<std::size_t>(*atom - 1)] = *charge;
      }
    }
    // A MOL file without its last line holds all of its atoms.
    return Done{};
  }

  // "M  V30 index type x y z aamap [KEY=VALUE ...]"
  Status read_v3000(bool wanted) {
    std::optional<std::int64_t> atoms;
    std::int64_t found = 0;
    bool in_atoms = false, in_bonds = false;
    while (scanner_.next_line()) {
      const std::string_view line = trim(scanner_.line());
      if (line == "M  END" || is_end_of_record(line)) {
        if (!atoms) return scanner_.line_error("the molecule ends without 'M  V30 COUNTS', the number of its atoms");
        if (found != *atoms || in_atoms)
          return scanner_.line_error("the molecule ends too early: expected " + std::to_string(*atoms) +
                                     " atoms but found " + std::to_string(found));
        return Done{};
      }
      const std::size_t prefix = v3000_prefix(line);
      if (prefix == std::string_view::npos) continue;
      const std::string_view rest = trim(line.substr(prefix));
      if (rest == "BEGIN ATOM") {
        if (in_atoms || found > 0) return scanner_.line_error("the block of atoms comes twice");
        in_atoms = true;
      } else if (rest == "END ATOM") {
        in_atoms = false;
      } else if (rest == "BEGIN BOND" || rest == "END BOND") {
        in_bonds = rest == "BEGIN BOND";
      } else if (in_bonds) {
        if (wanted) read_v3000_bond();
      } else if (rest.substr(0, 7) == "COUNTS ") {
        if (atoms) return scanner_.line_error("the counts come twice");
        skip_fields(3);
        const Result<std::int64_t> count = take_count(scanner_, "the number of atoms");
        if (!count) return count.error();
        atoms = *count;
      } else if (in_atoms) {
        if (!atoms) return scanner_.line_error("expected 'M  V30 COUNTS', the number of atoms, before the atoms");
        if (found >= *atoms) return scanner_.line_error("there are more atoms than COUNTS promises");
        ++found;
        if (Status atom = read_v3000_atom(wanted); !atom) return atom;
      }
    }
    return cut("M  END");
  }

  // "M  V30 index type atom1 atom2 ...", with positions in place of the atoms' indices, as in files of version 2000.
  void read_v3000_bond() {
    skip_fields(3);
    std::string_view type, one, other;
    if (scanner_.next_field(type) && scanner_.next_field(one) && scanner_.next_field(other))
      add_stated_bond(parse_int(one), parse_int(other), parse_int(type));
  }

  void skip_fields(int count) {
    std::string_view field;
    for (int i = 0; i < count; ++i) scanner_.next_field(field);
  }

  Status read_v3000_atom(bool wanted) {
    if (!wanted) return Done{};
    skip_fields(3);
    std::string_view symbol, field;
    if (!scanner_.next_field(symbol)) return scanner_.line_error("expected the symbol of an atom");
    // A list of symbols in quotes may have blanks.
    if (symbol[0] == '"')
      for (field = symbol; !field.empty() && (field.size() < 2 || field.back() != '"');) scanner_.next_field(field);
    if (symbol == "NOT") scanner_.next_field(field);
    const Result<Vec3d> at = take_place(scanner_);
    if (!at) return at.error();
    double charge = 0;
    while (scanner_.next_field(field))
      if (field.substr(0, 4) == "CHG=") charge = parse_double(field.substr(4)).value_or(0);
    add(*at, symbol, charge);
    return Done{};
  }

  void finish() {
    SphereAttributes& attributes = spheres_.attributes;
    attributes.bonds.are_all = !attributes.bonds.empty();
    if (std::all_of(attributes.element.begin(), attributes.element.end(), [](auto number) { return number == 0; }))
      attributes.element.clear();
    attributes.texts.push_back(printable_texts(symbols_.take("symbol")));
    const auto is_charged = [](double charge) { return charge != 0; };
    if (std::any_of(charge_.values.begin(), charge_.values.end(), is_charged))
      attributes.numbers.push_back(std::move(charge_));
    spheres_.rules.push_back("elements: the symbols of the atoms");
  }

  TextScanner scanner_;
  std::int64_t wanted_;
  RawSpheres spheres_;
  TextCollector symbols_;
  NamedNumbers charge_{"charge", {}};
};

// V2000 may be missing in old files, where the ending tells: a title may be a number, as the first line of XYZ is.
bool is_sdf(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  for (int line = 0; line < 4; ++line)
    if (!scanner.next_line()) return false;
  const std::string_view mark = columns_of_line(scanner.line(), 30, 12);
  if (mark.find("V2000") != std::string_view::npos || mark.find("V3000") != std::string_view::npos) return true;
  const auto is_count = [&](std::size_t first) {
    const auto count = parse_int(columns_of_line(scanner.line(), first, 3));
    return count && *count >= 0;
  };
  return is_named_so(kSdfFiles, head.name) && is_count(0) && is_count(3);
}

Result<RawSpheres> read_sdf(std::string_view text, const std::string& file, std::int64_t frame) {
  std::string joined;
  return SdfReader(with_joined_lines(text, kV3000Lines, joined), file, frame).read();
}

}  // namespace

extern constexpr Format kSdf("SDF", kSdfFiles, Format::kText | Format::kFrames, is_sdf, read_sdf,
                             "`V2000` or `V3000` on the fourth line | one molecule | van der Waals, by element");

}  // namespace bihive
