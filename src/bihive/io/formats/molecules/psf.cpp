// PSF of CHARMM, XPLOR and NAMD [PSF]: atoms and bonds without coordinates, which a trajectory gives.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/io/elements.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/text/fields.h"

namespace bihive {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

class PsfReader {
 public:
  PsfReader(std::string_view text, const std::string& file) : scanner_(text, file) { spheres_.format = "PSF"; }

  Result<RawSpheres> read() {
    scanner_.next_filled_line();
    is_extended_ = scanner_.line().find("EXT") != std::string_view::npos;
    bool has_atoms = false;
    while (scanner_.next_line()) {
      Status status = Done{};
      if (begins("!NATOM")) {
        if (has_atoms) return scanner_.line_error("the section !NATOM comes twice");
        has_atoms = true;
        status = read_atoms();
      } else if (begins("!NBOND")) {
        if (!has_atoms) return scanner_.line_error("the bonds come before the atoms");
        status = read_bonds();
      }
      if (!status) return status.error();
    }
    if (!has_atoms) return scanner_.line_error("the file has no section !NATOM");
    finish();
    return std::move(spheres_);
  }

 private:
  // "    3341 !NATOM", and what may follow the name.
  bool begins(std::string_view section) const {
    const std::string_view line = trim(scanner_.line());
    const std::size_t mark = line.find('!');
    return mark != std::string_view::npos && line.substr(mark).starts_with(section);
  }

  Status read_atoms() {
    const std::int64_t line = scanner_.line_number();
    const Result<std::int64_t> count = take_count(scanner_, "the number of atoms");
    if (!count) return count.error();
    for (std::int64_t i = 0; i < *count; ++i) {
      if (!scanner_.next_line() || trim(scanner_.line()).empty())
        return scanner_.line_error("expected " + std::to_string(*count) + " atoms (line " + std::to_string(line) +
                                   ") but found " + std::to_string(i));
      if (Status atom = read_atom(); !atom) return atom;
    }
    return Done{};
  }

  // "number segment residue's number its name atom's name type charge mass ...". The segment may be blank; its columns
  // tell.
  Status read_atom() {
    const std::size_t begin = is_extended_ ? 11 : 9, width = is_extended_ ? 8 : 4;
    const std::string_view line = scanner_.line();
    const bool has_segment = line.size() < begin + width || !trim(line.substr(begin, width)).empty();
    std::string_view field;
    std::string texts[5];  // segment, residue's number, its name, atom's name, type
    if (!scanner_.next_field(field)) return scanner_.line_error("expected the number of an atom");
    const std::optional<std::int64_t> serial = parse_int(field);
    for (std::size_t k = has_segment ? 0 : 1; k < 5; ++k) {
      if (!scanner_.next_field(field))
        return scanner_.line_error("expected segment, residue, names, type, charge and mass of an atom");
      texts[k] = field;
    }
    const Result<double> charge = take_number(scanner_, "the charge");
    if (!charge) return charge.error();
    const Result<double> mass = take_number(scanner_, "the mass");
    if (!mass) return mass.error();

    // A letter after the number is the insertion code.
    std::int64_t residue = 0;
    const char* const end = texts[1].data() + texts[1].size();
    const auto [rest, fault] = std::from_chars(texts[1].data(), end, residue);
    has_insertions_ = has_insertions_ || (fault == std::errc() && rest != end);
    for (std::vector<double>* coordinates : {&spheres_.x, &spheres_.y, &spheres_.z}) coordinates->push_back(0);
    residue_number_.values.push_back(fault == std::errc() ? double(residue) : kNotANumber);
    insertions_.add(fault == std::errc() ? std::string_view(rest, static_cast<std::size_t>(end - rest)) : "");
    serial_.values.push_back(serial ? double(*serial) : kNotANumber);
    charge_.values.push_back(*charge);
    mass_.values.push_back(*mass);
    segments_.add(texts[0]);
    residues_.add(texts[2]);
    names_.add(texts[3]);
    types_.add(texts[4]);
    const std::string place = texts[0] + " " + texts[1];
    elements_.add({"", texts[3], texts[2], place, scanner_.line_number()});
    return Done{};
  }

  // Pairs of atoms by their positions from 1, several on a line.
  Status read_bonds() {
    const Result<std::int64_t> count = take_count(scanner_, "the number of bonds");
    if (!count) return count.error();
    if (*count > 0) scanner_.next_filled_line();
    for (std::int64_t i = 0; i < *count; ++i) {
      std::optional<std::int64_t> ends[2];
      for (std::optional<std::int64_t>& end : ends) {
        std::string_view field;
        while (!scanner_.next_field(field))
          if (!scanner_.next_filled_line())
            return scanner_.line_error("expected " + std::to_string(*count) + " bonds but found " + std::to_string(i));
        end = parse_int(field);
        if (!end || *end < 1 || *end > static_cast<std::int64_t>(spheres_.size()))
          return scanner_.field_error("expected the number of an atom but found " + quote(field));
      }
      add_bond(spheres_, ends[0], ends[1]);
    }
    return Done{};
  }

  void finish() {
    spheres_.has_positions = false;
    // Names tell where a mass is not that of an element: hydrogen may be made heavier.
    elements_.take(spheres_, scanner_.file());
    SphereAttributes& attributes = spheres_.attributes;
    attributes.element.resize(spheres_.size());
    attributes.bonds.are_all = !attributes.bonds.empty();
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      if (const int element = element_of_mass(mass_.values[i]); element > 0)
        attributes.element[i] = static_cast<std::uint8_t>(element);
      attributes.type.push_back(types_.text_of_sphere()[i] + 1);
    }
    if (std::all_of(attributes.element.begin(), attributes.element.end(), [](auto number) { return number == 0; }))
      attributes.element.clear();
    for (NamedNumbers* column : {&residue_number_, &serial_, &charge_, &mass_})
      attributes.numbers.push_back(std::move(*column));
    attributes.texts.push_back(printable_texts(segments_.take("chain")));
    attributes.texts.push_back(printable_texts(residues_.take("resname")));
    attributes.texts.push_back(printable_texts(names_.take("name")));
    attributes.texts.push_back(printable_texts(types_.take("type")));
    if (has_insertions_) attributes.texts.push_back(printable_texts(insertions_.take("insertion")));
    spheres_.rules.push_back("elements: by the masses, else by names; chains are the segments");
  }

  TextScanner scanner_;
  bool is_extended_ = false, has_insertions_ = false;
  RawSpheres spheres_;
  PdbElements elements_{false};
  NamedNumbers residue_number_{"resid", {}}, serial_{"serial", {}}, charge_{"charge", {}}, mass_{"mass", {}};
  TextCollector segments_, residues_, names_, types_, insertions_;
};

bool is_psf(const FileHead& head) {
  const std::string_view line = head.text.line();
  return line.starts_with("PSF") && (line.size() == 3 || line[3] == ' ');
}

Result<RawSpheres> read_psf(std::string_view text, const std::string& file, std::int64_t frame) {
  if (frame != 0) return no_such_frame(file, frame, 1);
  return PsfReader(text, file).read();
}

}  // namespace

extern constexpr Format kPsf("PSF", ".psf", Format::kText, is_psf, read_psf,
                             "`PSF` | atoms and bonds; a trajectory gives the coordinates | van der Waals, by element");

}  // namespace bihive
