#include "commands/info_content.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "bihive/io/bonds.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/residue_runs.h"
#include "bihive/select/selection.h"

namespace bihive::cli {
namespace {

// Kinds of residues as selections know them.
constexpr const char* kKinds[] = {"protein", "nucleic", "water", "ion", "ligand"};

void count(std::vector<CountedName>& names, const std::string& name, bool begins_residue) {
  auto found = std::find_if(names.begin(), names.end(), [&](const CountedName& one) { return one.name == name; });
  if (found == names.end()) found = names.insert(names.end(), {name});
  ++found->spheres;
  found->residues += begins_residue ? 1 : 0;
}

// Whether a sphere is of another residue than the one before it.
class ResidueBegins {
 public:
  explicit ResidueBegins(const SphereSet& spheres) {
    const NamedNumbers* const number = spheres.attributes().find_numbers("resid");
    residues_ = residue_runs(spheres.attributes(), static_cast<std::size_t>(spheres.size()),
                             [number](std::size_t i) { return number == nullptr ? 0 : number->values[i]; });
  }
  bool operator()(std::size_t i) const { return i == 0 || residues_[i] != residues_[i - 1]; }

 private:
  std::vector<std::int32_t> residues_;
};

void count_residues(const SphereSet& spheres, const ResidueBegins& begins, InfoContent& content) {
  const NamedTexts* const names = spheres.attributes().find_texts("resname");
  if (names == nullptr) return;
  for (const std::string kind : kKinds) {
    const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, kind);
    if (!mask) continue;
    for (std::size_t i = 0; i < mask->size(); ++i) {
      if ((*mask)[i] == 0) continue;
      count(content.kinds, kind, begins(i));
      if (kind == "ion" || kind == "ligand") count(content.ligands, names->of(i), begins(i));
    }
  }
}

}  // namespace

InfoContent content_of(const SphereSet& spheres) {
  InfoContent content;
  const SphereAttributes& attributes = spheres.attributes();
  const ResidueBegins begins(spheres);
  if (const NamedTexts* const chain = attributes.find_texts("chain")) {
    std::vector<CountedName> of_text;
    for (const std::string& name : chain->texts) of_text.push_back({name});
    for (std::size_t i = 0; i < chain->text_of_sphere.size(); ++i) {
      CountedName& one = of_text[static_cast<std::size_t>(chain->text_of_sphere[i])];
      ++one.spheres;
      one.residues += begins(i) ? 1 : 0;
    }
    for (const CountedName& one : of_text)
      if (one.spheres > 0) content.chains.push_back(one);
  }
  count_residues(spheres, begins, content);
  for (const std::string_view name : kMoleculeColumns)
    if (const NamedNumbers* const column = attributes.find_numbers(name); column != nullptr && !content.molecules) {
      std::vector<double> numbers = column->values;
      std::erase_if(numbers, [](double number) { return std::isnan(number); });
      std::sort(numbers.begin(), numbers.end());
      content.molecules = std::unique(numbers.begin(), numbers.end()) - numbers.begin();
    }
  return content;
}

InfoBonds bonds_of(const SphereSet& spheres) {
  constexpr std::pair<BondOrder, const char*> kOrders[] = {{BondOrder::single, "single"},
                                                           {BondOrder::double_bond, "double"},
                                                           {BondOrder::triple, "triple"},
                                                           {BondOrder::aromatic, "aromatic"}};
  constexpr std::int64_t kMostAtoms = 1 << 20;
  const StatedBonds& stated = spheres.attributes().bonds;
  InfoBonds bonds;
  bonds.stated = static_cast<std::int64_t>(stated.list.size());
  for (const auto& [order, name] : kOrders) {
    const std::int64_t count = std::count_if(stated.list.begin(), stated.list.end(),
                                             [order = order](const StatedBond& bond) { return bond.order == order; });
    if (count > 0) bonds.orders.emplace_back(name, count);
  }
  if (stated.are_all || spheres.size() > kMostAtoms) return bonds;
  const Result<std::vector<ImagePair>> automatic = automatic_bonds(spheres, Sticks().reach);
  if (automatic) bonds.by_distance = static_cast<std::int64_t>(automatic->size()) - bonds.stated;
  return bonds;
}

}  // namespace bihive::cli
