#include "bihive/select/words.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "bihive/io/text/text_scanner.h"
#include "bihive/select/residue_words.h"

namespace bihive {
namespace {

using WordMask = std::vector<std::uint8_t>;

constexpr std::string_view kWords[] = {"all",     "none",    "hydrogen", "water",    "ion",       "ligand",
                                       "protein", "nucleic", "polymer",  "backbone", "sidechain", "hetero"};
struct OtherForm {
  std::string_view other, word;
};
constexpr OtherForm kOtherForms[] = {{"hydrogens", "hydrogen"}, {"waters", "water"},   {"solvent", "water"},
                                     {"ions", "ion"},           {"ligands", "ligand"}, {"sidechains", "sidechain"},
                                     {"hetatm", "hetero"},      {"hetatom", "hetero"}};

constexpr int kHydrogen = 1;

Error missing_column(std::string_view word, const std::string& column, const std::string& meaning) {
  return {quote(word) + " needs " + meaning + ", and the input has no " + quote(column), "", 0, 0,
          "PDB, mmCIF and GRO files have it; bihive info says what an input has"};
}

template <class Test>
std::vector<bool> decide(const std::vector<std::string>& texts, const Test& test) {
  std::vector<bool> answers;
  answers.reserve(texts.size());
  for (const std::string& text : texts) answers.push_back(test(text));
  return answers;
}

std::size_t text_at(const NamedTexts& column, std::size_t sphere) {
  return static_cast<std::size_t>(column.text_of_sphere[sphere]);
}

template <class Test>
Result<WordMask> by_residue(std::string_view word, const SphereSet& spheres, const Test& test) {
  const NamedTexts* const residues = spheres.attributes().find_texts("resname");
  if (residues == nullptr) return missing_column(word, "resname", "the names of residues");
  const std::vector<bool> wanted = decide(residues->texts, test);
  WordMask mask(static_cast<std::size_t>(spheres.size()));
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = wanted[text_at(*residues, i)] ? 1 : 0;
  return mask;
}

bool is_polymer_residue(const std::string& residue) {
  return is_protein_residue(residue) || is_nucleic_residue(residue);
}

bool is_ligand_residue(const std::string& residue) {
  return !is_polymer_residue(residue) && !is_water_residue(residue) && !is_ion_residue(residue);
}

Result<WordMask> backbone(const SphereSet& spheres);

// The atoms of polymers that are not of their backbone, and no hydrogen.
Result<WordMask> sidechain(const SphereSet& spheres) {
  Result<WordMask> mask = backbone(spheres);
  if (!mask) {
    Error error = mask.error();
    if (const std::size_t at = error.message.find("backbone"); at != std::string::npos)
      error.message.replace(at, 8, "sidechain");
    return error;
  }
  const Result<WordMask> polymer = by_residue("sidechain", spheres, is_polymer_residue);
  const std::vector<std::uint8_t>& element = spheres.attributes().element;
  for (std::size_t i = 0; i < mask->size(); ++i) {
    const bool is_hydrogen = !element.empty() && element[i] == kHydrogen;
    (*mask)[i] = (*polymer)[i] != 0 && (*mask)[i] == 0 && !is_hydrogen ? 1 : 0;
  }
  return mask;
}

Result<WordMask> backbone(const SphereSet& spheres) {
  const NamedTexts* const residues = spheres.attributes().find_texts("resname");
  const NamedTexts* const names = spheres.attributes().find_texts("name");
  if (residues == nullptr) return missing_column("backbone", "resname", "the names of residues");
  if (names == nullptr) return missing_column("backbone", "name", "the names of atoms");
  const std::vector<bool> protein = decide(residues->texts, is_protein_residue);
  const std::vector<bool> nucleic = decide(residues->texts, is_nucleic_residue);
  const std::vector<bool> of_protein = decide(names->texts, is_protein_backbone);
  const std::vector<bool> of_nucleic = decide(names->texts, is_nucleic_backbone);
  WordMask mask(static_cast<std::size_t>(spheres.size()));
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const std::size_t residue = text_at(*residues, i), name = text_at(*names, i);
    mask[i] = (protein[residue] && of_protein[name]) || (nucleic[residue] && of_nucleic[name]) ? 1 : 0;
  }
  return mask;
}

Result<WordMask> hydrogen(const SphereSet& spheres) {
  const std::vector<std::uint8_t>& element = spheres.attributes().element;
  if (element.empty()) return missing_column("hydrogen", "element", "elements");
  WordMask mask(element.size());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = element[i] == kHydrogen ? 1 : 0;
  return mask;
}

Result<WordMask> hetero(const SphereSet& spheres) {
  const NamedTexts* const records = spheres.attributes().find_texts("record");
  if (records == nullptr) return missing_column("hetero", "record", "the marks ATOM and HETATM");
  WordMask mask(static_cast<std::size_t>(spheres.size()));
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = records->of(i) == "HETATM" ? 1 : 0;
  return mask;
}

std::string_view usual_form(std::string_view word) {
  for (const OtherForm& form : kOtherForms)
    if (form.other == word) return form.word;
  return word;
}

}  // namespace

std::vector<std::string> selection_words() {
  return {std::begin(kWords), std::end(kWords)};
}

bool is_selection_word(std::string_view word) {
  return std::find(std::begin(kWords), std::end(kWords), usual_form(word)) != std::end(kWords);
}

Result<WordMask> mask_of_word(std::string_view word, const SphereSet& spheres) {
  word = usual_form(word);
  const auto n = static_cast<std::size_t>(spheres.size());
  if (word == "all") return WordMask(n, 1);
  if (word == "none") return WordMask(n, 0);
  if (word == "hydrogen") return hydrogen(spheres);
  if (word == "hetero") return hetero(spheres);
  if (word == "backbone") return backbone(spheres);
  if (word == "sidechain") return sidechain(spheres);
  if (word == "polymer") return by_residue(word, spheres, is_polymer_residue);
  if (word == "ligand") return by_residue(word, spheres, is_ligand_residue);
  if (word == "ion") return by_residue(word, spheres, is_ion_residue);
  if (word == "protein") return by_residue(word, spheres, is_protein_residue);
  if (word == "nucleic") return by_residue(word, spheres, is_nucleic_residue);
  return by_residue(word, spheres, is_water_residue);
}

}  // namespace bihive
