#include "bihive/io/formats/molecules/pdb_elements.h"

#include <algorithm>
#include <iterator>

#include "bihive/base/ascii.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr int kHydrogen = 1, kCarbon = 6, kNitrogen = 7, kOxygen = 8, kPhosphorus = 15, kSulfur = 16, kSelenium = 34;

template <class List>
bool is_in(const List& sorted, std::string_view text) {
  return std::binary_search(std::begin(sorted), std::end(sorted), text);
}

struct IonName {
  std::string_view name;
  int element;
};
// Names of ions that are not their symbols: CHARMM's, and those of the Protein Data Bank.
constexpr IonName kIonNames[] = {{"BAR", 56}, {"BRO", 35}, {"CAL", 20}, {"CES", 55}, {"CLA", 17},
                                 {"CLO", 17}, {"FLO", 9},  {"IDO", 53}, {"IOD", 53}, {"LIT", 3},
                                 {"POT", 19}, {"RUB", 37}, {"SOD", 11}};

// A name without charge: "NA+", "Ca2+", "FE2", "3CO" become NA, CA, FE, CO.
std::string without_charge(std::string_view name) {
  std::string bare;
  for (const char c : upper_case(name))
    if (is_letter(c)) bare += c;
  return bare;
}

int ion_of_name(std::string_view bare) {
  for (const IonName& ion : kIonNames)
    if (ion.name == bare) return ion.element;
  constexpr int kLastStable = 83;
  const int element = atomic_number(bare);
  return element <= kLastStable ? element : 0;
}

// The element of an ion, or 0: the residue's name is the ion's, or stands for ions in general.
int ion_element(std::string_view residue, std::string_view name) {
  const std::string of_atom = without_charge(name);
  const int element = ion_of_name(of_atom);
  if (element == 0) return 0;
  const std::string of_residue = without_charge(residue);
  if (of_residue.empty()) return of_atom.size() > 2 ? element : 0;
  if (of_residue == "ION" || of_residue == "IONS") return element;
  return ion_of_name(of_residue) == element && of_residue.size() > 1 ? element : 0;
}

// The name from its first letter on, in upper case.
std::string from_first_letter(std::string_view name) {
  std::string bare = upper_case(trim(name));
  bare.erase(0, std::min(bare.size(),
                         static_cast<std::size_t>(std::find_if(bare.begin(), bare.end(), is_letter) - bare.begin())));
  return bare;
}

// The element where a name begins with the symbol in the column that the format wants: two letters from column 13 on,
// or one in column 14 [wwPDB-3.3]. A digit beside a letter does not count. If two letters make no element, the first
// counts. A symbol behind two blanks stands flush right.
int element_by_columns(const char (&name)[4]) {
  if (name[0] == ' ' && name[1] == ' ') return atomic_number(trim({name, 4}));
  if (name[0] == ' ' || is_digit(name[0])) return atomic_number({&name[1], 1});
  const int of_two = is_letter(name[1]) ? atomic_number({name, 2}) : 0;
  return of_two ? of_two : atomic_number({name, 1});
}

// The element where the name's place says nothing. Molecules consist of few elements, and their names continue with
// any letter: CA, CD, HG, NE and PB are then carbon, hydrogen, nitrogen and phosphorus.
int element_by_likelihood(std::string_view name, bool alone) {
  const std::string bare = from_first_letter(name);
  if (bare.empty()) return 0;
  const int of_two = bare.size() > 1 && is_letter(bare[1]) ? atomic_number(std::string_view(bare).substr(0, 2)) : 0;
  const int of_one = atomic_number(std::string_view(bare).substr(0, 1));
  if (alone && of_two && trim(name).size() < 4) return of_two;
  static constexpr std::string_view two[] = {"BR", "CL", "FE", "PT", "SE", "SI"};
  if (of_two && is_in(two, bare.substr(0, 2))) return of_two;
  constexpr std::string_view common = "BCDFHINOPS";
  if (common.find(bare[0]) != std::string_view::npos) return of_one;
  return of_two ? of_two : of_one;
}

}  // namespace

// The element of an atom in a residue of this class; 0: certainly none (a bead, a place without mass); nothing: unsure.
std::optional<int> PdbElements::element_in(ResidueClass residue_class, std::string_view residue,
                                           std::string_view name) {
  if (const int ion = ion_element(residue, name)) return ion;
  if (residue_class == ResidueClass::unknown) return std::nullopt;
  if (residue_class == ResidueClass::bead) return 0;
  const std::string bare = from_first_letter(name);
  if (bare.empty()) return std::nullopt;
  const char first = bare[0];
  if (first == 'H' || first == 'D') return kHydrogen;
  if (first == 'O') return kOxygen;
  // The fourth and fifth site of some models: M, MW, EP, LP, IW.
  constexpr std::string_view massless = "EILM";
  if (residue_class == ResidueClass::water)
    return massless.find(first) == std::string_view::npos ? std::nullopt : std::optional<int>(0);
  if (residue_class == ResidueClass::protein) {
    // Coarse grains of Martini; sulfur is in cysteine and methionine alone.
    if (bare == "BB" || (bare.size() == 3 && bare.substr(0, 2) == "SC" && is_digit(bare[2]))) return 0;
    const std::string of = upper_case(residue);
    const bool selenium = of == "SEC" || of == "MSE";
    const bool sulfur = of.find("CY") != std::string::npos || of.find("MET") != std::string::npos;
    if (first == 'S' && selenium) return kSelenium;
    if (first == 'S') return sulfur ? std::optional<int>(kSulfur) : std::nullopt;
  }
  if (is_modified(residue_class)) {
    const std::string two = bare.substr(0, 2);
    if (two == "SE") return kSelenium;
    if (two == "AS" || two == "CL" || two == "BR" || two == "FE") return atomic_number(two);
  }
  switch (first) {
    case 'C':
      return kCarbon;
    case 'N':
      return kNitrogen;
    case 'P':
      return residue_class == ResidueClass::protein ? std::nullopt : std::optional<int>(kPhosphorus);
    case 'S':
      return kSulfur;
    default:
      return std::nullopt;
  }
}

// Names of one to three characters show whether the file keeps to the columns: a one-letter symbol belongs into the
// second.
void PdbElements::count_evidence(const ElementClues& clues, std::optional<int> element) {
  if (!names_in_columns_ || clues.name.size() < 2 || (clues.name.size() == 4 && clues.name[3] != ' ')) return;
  const std::string bare = from_first_letter(clues.name);
  if (bare.empty()) return;
  const bool one_letter_symbol =
      element ? atomic_number(std::string_view(bare).substr(0, 1)) == *element && *element != 0
              : atomic_number(std::string_view(bare).substr(0, 1)) != 0 && (bare.size() == 1 || is_digit(bare[1]));
  if (!one_letter_symbol) return;
  if (clues.name[0] == ' ' && is_letter(clues.name[1]))
    ++in_columns_;
  else if (is_letter(clues.name[0]))
    ++flush_left_;
}

void PdbElements::add(const ElementClues& clues) {
  // Look a residue up once.
  if (clues.place != place_ || clues.residue != residue_ || elements_.empty()) {
    end_residue();
    place_ = clues.place;
    residue_ = clues.residue;
    class_ = class_of_residue(clues.residue);
    if (class_ == ResidueClass::unknown) class_ = class_of_residue(clues.residue.substr(0, 3));
  }
  ++residue_size_;

  // The columns of the element come first. X stands for an unknown one; other letters that are no symbol say nothing.
  const std::string_view stated = trim(clues.stated);
  const int stated_element = atomic_number(stated);
  const std::optional<int> expected = element_in(class_, clues.residue, clues.name);
  if (stated_element != 0 || stated == "X" || stated == "x") {
    const bool sure = expected && *expected != 0 && !is_modified(class_) && class_ != ResidueClass::sugar;
    if (stated_element != 0 && sure && *expected != stated_element) {
      if (contradictions_++ == 0) {
        first_contradiction_ = clues.line_number;
        contradiction_ = quote(trim(clues.name)) + " of " + quote(clues.residue) + " is stated as " + quote(stated);
      }
    }
    count_evidence(clues, stated_element);
    elements_.push_back(static_cast<std::uint8_t>(stated_element));
    return;
  }
  count_evidence(clues, expected);
  elements_.push_back(static_cast<std::uint8_t>(expected.value_or(0)));
  if (expected) return;
  Undecided atom{elements_.size() - 1, residue_sizes_.size(), {' ', ' ', ' ', ' '}};
  clues.name.copy(atom.name, 4);
  undecided_.push_back(atom);
  residue_undecided_ = true;
}

void PdbElements::end_residue() {
  if (residue_undecided_) residue_sizes_.push_back(residue_size_);
  residue_undecided_ = false;
  residue_size_ = 0;
}

void PdbElements::take(RawSpheres& spheres, const std::string& file) {
  end_residue();
  const bool columns_count = names_in_columns_ && flush_left_ <= in_columns_;
  for (const Undecided& atom : undecided_) {
    // A name of four characters begins in column 13 anyway.
    const bool alone = residue_sizes_[atom.residue] == 1;
    const bool place_counts = columns_count && (atom.name[3] == ' ' || !is_letter(atom.name[0]));
    const int element = place_counts ? element_by_columns(atom.name) : element_by_likelihood({atom.name, 4}, alone);
    elements_[atom.index] = static_cast<std::uint8_t>(element);
  }
  spheres.attributes.element = std::move(elements_);
  if (!names_in_columns_)
    spheres.rules.push_back("elements: by residue, else by name");
  else if (!columns_count)
    spheres.rules.push_back(
        "elements: columns 77-78, else by residue, else by name; names begin in column 13 whatever "
        "their element");
  if (contradictions_ > 0)
    spheres.warnings.push_back(file + ":" + std::to_string(first_contradiction_) + ": " +
                               std::to_string(contradictions_) + (contradictions_ == 1 ? " atom has" : " atoms have") +
                               (names_in_columns_ ? " an element in columns 77-78" : " an element behind the radius") +
                               " that contradicts the atom's name (" + contradiction_ +
                               (names_in_columns_ ? "); the columns count" : "); that element counts"));
}

}  // namespace bihive
