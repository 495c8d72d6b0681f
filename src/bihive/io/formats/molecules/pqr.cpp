// PQR [PDB2PQR]: PDB's records with a charge and a radius behind the coordinates, as fields with blanks between them:
//   ATOM serial name residue [chain] number x y z charge radius
// pdb2pqr keeps to columns unless it is asked for blanks, so large numbers may touch. Then the columns count.
#include <algorithm>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/formats/molecules/atom_columns.h"
#include "bihive/io/formats/molecules/pdb_elements.h"
#include "bihive/io/formats/molecules/pqr_line.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {

extern const Format kPdb;

namespace {

class PqrReader {
 public:
  PqrReader(const TextScanner& scanner, const FramePass& pass) : scanner_(scanner), pass_(pass), frame_(pass.wanted) {
    spheres_.format = "PQR";
  }

  Result<RawSpheres> read() {
    // Models as in PDB.
    FrameNotes notes(pass_.made, scanner_);
    bool in_model = false;
    std::int64_t models = pass_.first;
    while (scanner_.next_line()) {
      const std::string_view record = scanner_.line().substr(0, 6);
      if (is_atom_record(scanner_.line())) {
        if (!in_model) ++models;
        in_model = true;
        if (models - 1 != frame_) continue;
        if (Status atom = read_atom(); !atom) return atom.error();
      } else if (record == "ENDMDL" || trim(record) == "MODEL" || trim(record) == "END") {
        if (in_model) notes.end_frame(scanner_);
        in_model = false;
      }
    }
    if (in_model) notes.end_frame(scanner_);
    if (models == 0) return Error{"there is no ATOM or HETATM record in it", scanner_.file(), 0, 0, ""};
    if (pass_.reads_none()) return std::move(spheres_);
    if (frame_ < 0 || frame_ >= models) return no_such_frame(scanner_.file(), frame_, models);
    finish(pass_.index != nullptr ? pass_.index->count() : models);
    return std::move(spheres_);
  }

 private:
  Status read_atom() {
    const std::optional<PqrLine> atom = split_pqr_line(scanner_.line());
    if (!atom)
      return scanner_.line_error(
          "expected 'ATOM serial name residue [chain] number x y z charge radius' but found " + quote(scanner_.line()),
          scanner_.at_end() && !scanner_.ends_in_newline() ? "the file is cut on this line" : "");

    // The last five fields are numbers, which may be too large or negative.
    static constexpr const char* names[] = {"x", "y", "z", "the charge", "the radius"};
    double numbers[5] = {};
    for (std::size_t i = 0; i < 5; ++i) {
      const std::string_view field = atom->numbers[i];
      numbers[i] = *parse_double(field);
      if (const char* fault = i == 4 ? radius_fault(numbers[i]) : coordinate_fault(numbers[i]))
        return scanner_.column_error(field.data() - scanner_.line().data() + 1,
                                     std::string(names[i]) + " " + fault + ": " + quote(field));
    }
    spheres_.x.push_back(numbers[0]);
    spheres_.y.push_back(numbers[1]);
    spheres_.z.push_back(numbers[2]);
    charge_.values.push_back(numbers[3]);
    spheres_.r.push_back(numbers[4]);

    AtomNames of_atom;
    of_atom.record = atom->hetero ? "HETATM" : "ATOM";
    of_atom.serial = atom->serial;
    of_atom.chain = atom->chain;
    of_atom.residue_number = atom->residue_number;
    of_atom.insertion = atom->insertion;
    of_atom.residue = atom->residue;
    of_atom.name = atom->name;
    columns_.add(of_atom, 1, 0);
    has_elements_ = has_elements_ || !atom->element.empty();
    elements_.add({atom->element, atom->name, atom->residue, atom->place, scanner_.line_number()});
    return Done{};
  }

  void finish(std::int64_t models) {
    spheres_.frames = models;
    spheres_.rules.push_back("atoms: ATOM and HETATM records of model " + std::to_string(frame_) + " (from 0)");
    spheres_.rules.push_back("radii: the file's");
    if (has_elements_) spheres_.rules.push_back("elements: the symbols behind the radii first");
    elements_.take(spheres_, scanner_.file());
    columns_.take(spheres_.attributes);

    // The format has neither occupancy nor B factor.
    std::vector<NamedNumbers>& numbers = spheres_.attributes.numbers;
    numbers.erase(
        std::remove_if(numbers.begin(), numbers.end(),
                       [](const NamedNumbers& one) { return one.name == "occupancy" || one.name == "b_factor"; }),
        numbers.end());
    numbers.push_back(std::move(charge_));
  }

  TextScanner scanner_;
  FramePass pass_;
  std::int64_t frame_;
  RawSpheres spheres_;
  NamedNumbers charge_{"charge", {}};
  AtomColumns columns_;
  PdbElements elements_{false};
  bool has_elements_ = false;
};

// PQR has PDB's records, with fields of its own. Its atoms do not fit PDB's columns, or the name says it. A file that
// is named PDB stays PDB: shifted columns are an error there, and its B factors are no radii.
bool is_pqr(const FileHead& head) {
  if (!is_pdb_record(head.text.line()) || is_named_so(kPdb.files, head.name)) return false;
  const bool named_so = is_named_so(".pqr", head.name);
  TextScanner scanner = head.text;
  bool any = false, one_does_not_fit_pdb = false;
  do {
    if (!is_atom_record(scanner.line()) || (scanner.at_end() && any)) continue;
    if (!may_be_pqr(scanner.line())) return named_so && !any && !may_be_pdb(scanner.line());
    any = true;
    one_does_not_fit_pdb = one_does_not_fit_pdb || is_pqr_only(scanner.line());
  } while (!one_does_not_fit_pdb && scanner.next_line());
  return named_so || one_does_not_fit_pdb;
}

Result<RawSpheres> read_pqr(const TextScanner& scanner, const FramePass& pass) {
  return PqrReader(scanner, pass).read();
}

}  // namespace

extern constexpr Format kPqr(
    "PQR", ".pqr", Format::kText | Format::kFrames, is_pqr, read_pqr,
    "records of PDB with fields that do not fit its columns, or that the ending names | ATOM and "
    "HETATM lines of one model, with charges | the file's",
    1);

}  // namespace bihive
