// MOL2 of Tripos [MOL2]: sections that begin with "@<TRIPOS>". Each MOLECULE is a frame.
#include <algorithm>
#include <limits>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/text/continued_lines.h"
#include "bihive/io/text/fields.h"
#include "bihive/io/text/title.h"

namespace bihive {
namespace {

constexpr std::string_view kTripos = "@<TRIPOS>";

// The element of a type of SYBYL (C.3, Ca) or of GAFF (c3, cl); 0: it is stated that there is none (Du, LP); nothing:
// the type does not tell.
std::optional<int> element_of_mol2_type(std::string_view type) {
  const std::string base(type.substr(0, type.find('.')));
  for (const char* const none : {"Du", "LP", "Any", "Hal", "Het", "Hev"})
    if (base == none) return 0;
  if (base.empty()) return std::nullopt;
  if (base[0] >= 'a' && base[0] <= 'z') {
    if (base.substr(0, 2) == "cl" || base.substr(0, 2) == "br") return atomic_number(base.substr(0, 2));
    if (std::string_view("hcnosfpi").find(base[0]) == std::string_view::npos) return std::nullopt;
    return atomic_number(base.substr(0, 1));
  }
  if (base.size() == 2 && base[1] >= 'A' && base[1] <= 'Z') return std::nullopt;  // CA is a carbon of AMBER
  const int number = atomic_number(base);
  return number > 0 ? std::optional<int>(number) : std::nullopt;
}

BondOrder order_of_mol2_type(std::string_view type) {
  if (type == "1" || type == "am") return BondOrder::single;
  if (type == "2") return BondOrder::double_bond;
  if (type == "3") return BondOrder::triple;
  return type == "ar" ? BondOrder::aromatic : BondOrder::unknown;
}

class Mol2Reader {
 public:
  Mol2Reader(std::string_view text, const std::string& file, std::int64_t wanted)
      : scanner_(text, file), wanted_(wanted) {
    spheres_.format = "MOL2";
  }

  Result<RawSpheres> read() {
    bool more = next_line();
    while (more) {
      const std::string_view line = trim(scanner_.line());
      if (line.substr(0, kTripos.size()) != kTripos) {
        more = next_line();
        continue;
      }
      const std::string section(line.substr(kTripos.size()));
      Status status = Done{};
      if (section == "MOLECULE")
        status = read_molecule();
      else if (section == "ATOM")
        status = read_atoms();
      else if (section == "BOND" && is_wanted() && has_atoms_)
        read_bonds();
      else if (section == "CRYSIN" && is_wanted())
        status = read_cell();
      if (!status) return status.error();
      more = next_line();
    }
    if (Status whole = end_molecule(); !whole) return whole.error();
    if (wanted_ < 0 || wanted_ >= frames_) return no_such_frame(scanner_.file(), wanted_, frames_);
    spheres_.frames = frames_;
    finish();
    return std::move(spheres_);
  }

 private:
  bool is_wanted() const { return frames_ - 1 == wanted_; }

  // Lines that begin with a number sign are comments.
  bool next_line() {
    while (scanner_.next_filled_line())
      if (trim(scanner_.line())[0] != '#') return true;
    return false;
  }

  Status end_molecule() const {
    if (frames_ > 0 && !has_atoms_)
      return scanner_.line_error("the molecule of line " + std::to_string(molecule_line_) + " has no section ATOM");
    return Done{};
  }

  // A name, which may be empty, and the counts.
  Status read_molecule() {
    if (Status whole = end_molecule(); !whole) return whole;
    molecule_line_ = scanner_.line_number();
    has_atoms_ = false;
    ++frames_;
    if (!scanner_.next_line()) return scanner_.line_error("the file ends before the name of a molecule");
    if (is_wanted()) spheres_.title = title_from(scanner_.line());
    if (!next_line()) return scanner_.line_error("the file ends before the number of atoms");
    const Result<std::int64_t> count = take_count(scanner_, "the number of atoms");
    if (!count) return count.error();
    count_ = *count;
    return Done{};
  }

  Status read_atoms() {
    if (frames_ == 0) return scanner_.line_error("expected " + std::string(kTripos) + "MOLECULE before its atoms");
    if (has_atoms_) return scanner_.line_error("the section ATOM comes twice in one molecule");
    has_atoms_ = true;
    for (std::int64_t i = 0; i < count_; ++i) {
      if (!next_line() || trim(scanner_.line())[0] == '@')
        return scanner_.line_error("expected " + std::to_string(count_) + " atoms (line " +
                                   std::to_string(molecule_line_ + 2) + ") but found " + std::to_string(i));
      if (!is_wanted()) continue;
      if (Status atom = read_atom(); !atom) return atom;
    }
    return Done{};
  }

  // "id name x y z type [residue's number [its name [charge [status]]]]"
  Status read_atom() {
    std::string_view id, name, type, number, residue, charge;
    scanner_.next_field(id);
    scanner_.next_field(name);
    const Result<Vec3d> at = take_place(scanner_);
    if (!at) return at.error();
    if (!scanner_.next_field(type)) return scanner_.line_error("expected the type of an atom behind its place");
    scanner_.next_field(number);
    scanner_.next_field(residue);
    double value = std::numeric_limits<double>::quiet_NaN();
    if (scanner_.next_field(charge)) {
      const auto parsed = parse_double(charge);
      if (!parsed) return scanner_.field_error("expected a charge but found " + quote(charge));
      value = *parsed;
      has_charges_ = true;
    }
    spheres_.x.push_back(at->x);
    spheres_.y.push_back(at->y);
    spheres_.z.push_back(at->z);
    charge_.values.push_back(value);
    const auto residue_number = parse_int(number);
    residue_number_.values.push_back(residue_number ? double(*residue_number)
                                                    : std::numeric_limits<double>::quiet_NaN());
    names_.add(name);
    residues_.add(residue);
    types_.add(type);
    elements_.add({"", name, residue, residue, scanner_.line_number()});
    return Done{};
  }

  // "id origin target type", until a line that is none. A bond to an atom that is not there counts as none, and so does
  // one of the type nc, "not connected".
  void read_bonds() {
    for (;;) {
      TextScanner ahead(scanner_);
      if (!ahead.next_filled_line() || trim(ahead.line())[0] == '@') return;
      scanner_.next_filled_line();
      std::string_view id, origin, target, type;
      if (trim(scanner_.line())[0] == '#') continue;
      if (!scanner_.next_field(id) || !scanner_.next_field(origin) || !scanner_.next_field(target)) continue;
      scanner_.next_field(type);
      if (type != "nc") add_bond(spheres_, parse_int(origin), parse_int(target), order_of_mol2_type(type));
    }
  }

  // "a b c alpha beta gamma group setting"
  Status read_cell() {
    if (!next_line()) return scanner_.line_error("the file ends before the numbers of the cell");
    std::array<double, 6> numbers{};
    for (double& one : numbers) {
      const Result<double> number = take_number(scanner_, "the cell");
      if (!number) return number.error();
      one = *number;
    }
    spheres_.cell = unit_cell(numbers);
    if (!spheres_.cell)
      spheres_.warnings.push_back(scanner_.file() + ":" + std::to_string(scanner_.line_number()) +
                                  ": the numbers of CRYSIN make no cell, so there is none");
    return Done{};
  }

  void finish() {
    // The types tell the elements; the names tell where they do not.
    elements_.take(spheres_, scanner_.file());
    SphereAttributes& attributes = spheres_.attributes;
    attributes.element.resize(spheres_.size());
    attributes.bonds.are_all = !attributes.bonds.empty();
    std::vector<std::optional<int>> element_of_label;
    for (const std::string& type : types_.texts()) element_of_label.push_back(element_of_mol2_type(type));
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const auto type = static_cast<std::size_t>(types_.text_of_sphere()[i]);
      attributes.type.push_back(static_cast<std::int32_t>(type + 1));
      if (element_of_label[type]) attributes.element[i] = static_cast<std::uint8_t>(*element_of_label[type]);
    }
    if (std::all_of(attributes.element.begin(), attributes.element.end(), [](auto number) { return number == 0; }))
      attributes.element.clear();
    if (has_charges_) attributes.numbers.push_back(std::move(charge_));
    attributes.numbers.push_back(std::move(residue_number_));
    attributes.texts.push_back(printable_texts(names_.take("name")));
    attributes.texts.push_back(printable_texts(residues_.take("resname")));
    attributes.texts.push_back(printable_texts(types_.take("type")));
    spheres_.rules.push_back("elements: by the types, else by names");
  }

  TextScanner scanner_;
  std::int64_t wanted_;
  std::int64_t frames_ = 0, count_ = 0, molecule_line_ = 0;
  bool has_atoms_ = false, has_charges_ = false;
  RawSpheres spheres_;
  PdbElements elements_{false};
  NamedNumbers charge_{"charge", {}}, residue_number_{"resid", {}};
  TextCollector names_, residues_, types_;
};

bool is_mol2(const FileHead& head) {
  TextScanner scanner(head.bytes, "");
  for (int line = 0; line < 200 && scanner.next_line(); ++line)
    if (scanner.line().substr(0, kTripos.size()) == kTripos) return true;
  return false;
}

Result<RawSpheres> read_mol2(std::string_view text, const std::string& file, std::int64_t frame) {
  // A line that ends in a backslash goes on in the next one.
  constexpr Continuation kLines{'\\', " ", [](std::string_view line) { return line.substr(0, 1) != "#"; },
                                [](std::string_view) { return std::size_t{0}; }};
  std::string joined;
  return Mol2Reader(with_joined_lines(text, kLines, joined), file, frame).read();
}

}  // namespace

extern constexpr Format kMol2("MOL2", ".mol2", Format::kText | Format::kFrames, is_mol2, read_mol2,
                              "`@<TRIPOS>` | one molecule | van der Waals, by element");

}  // namespace bihive
