// CIF of monomers, such as those of the Chemical Component Dictionary: the category _chem_comp_atom. Each data block
// with coordinates is a frame.
#include "bihive/io/formats/molecules/chem_comp.h"

#include <algorithm>
#include <array>
#include <gemmi/cif.hpp>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/formats/molecules/cif_connections.h"
#include "bihive/io/formats/molecules/cif_elements.h"
#include "bihive/io/formats/molecules/cif_errors.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// The places of an atom, the best first. Of ideal ones and those of a structure each may be unknown.
struct PlaceTags {
  const char* name;
  std::array<const char*, 3> tags;
};
constexpr PlaceTags kPlaceTags[] = {
    {"ideal coordinates", {"pdbx_model_Cartn_x_ideal", "pdbx_model_Cartn_y_ideal", "pdbx_model_Cartn_z_ideal"}},
    {"coordinates of a structure", {"model_Cartn_x", "model_Cartn_y", "model_Cartn_z"}},
    {"coordinates", {"x", "y", "z"}},
};
constexpr const char* kAtomPrefix = "_chem_comp_atom.";

gemmi::cif::Table places_of(gemmi::cif::Block& block, const PlaceTags& place) {
  return block.find(kAtomPrefix, {place.tags[0], place.tags[1], place.tags[2], "?type_symbol", "?atom_id", "?comp_id",
                                  "?charge", "?pdbx_leaving_atom_flag"});
}

std::int64_t known_places(gemmi::cif::Table& table) {
  std::int64_t known = 0;
  for (gemmi::cif::Table::Row row : table) known += row.has2(0) && row.has2(1) && row.has2(2);
  return known;
}

// The places that most atoms have; null if none has any.
const PlaceTags* best_places(gemmi::cif::Block& block) {
  const PlaceTags* best = nullptr;
  std::int64_t most = 0;
  for (const PlaceTags& place : kPlaceTags) {
    gemmi::cif::Table table = places_of(block, place);
    const std::int64_t known = table.ok() ? known_places(table) : 0;
    if (known > most) best = &place;
    most = std::max(most, known);
  }
  return best;
}

// Bonds go by the names of the atoms.
void take_bonds(gemmi::cif::Block& block, const NamedTexts& names, StatedBonds& bonds) {
  enum { kOne, kOther, kOrder, kAromatic };
  std::unordered_map<std::string, std::int32_t> sphere_of;
  for (std::size_t i = 0; i < names.text_of_sphere.size(); ++i)
    sphere_of.emplace(names.of(i), static_cast<std::int32_t>(i));
  gemmi::cif::Table table =
      block.find("_chem_comp_bond.", {"atom_id_1", "atom_id_2", "?value_order", "?pdbx_aromatic_flag"});
  for (gemmi::cif::Table::Row row : table) {
    const auto one = sphere_of.find(row.str(kOne)), other = sphere_of.find(row.str(kOther));
    if (one == sphere_of.end() || other == sphere_of.end()) continue;
    const std::string order = row.has2(kOrder) ? row.str(kOrder) : "";
    bonds.add(one->second, other->second,
              order_of_component_bond(order, row.has2(kAromatic) && row.str(kAromatic) == "Y"));
  }
  bonds.are_all = !bonds.empty();
}

Result<RawSpheres> read_monomer(gemmi::cif::Block& block, const PlaceTags& place, const std::string& file) {
  enum { kX, kY, kZ, kSymbol, kAtom, kComponent, kCharge };
  RawSpheres spheres;
  spheres.format = "mmCIF";
  NamedNumbers charge{"charge", {}};
  TextCollector names, residues;
  std::int64_t without_place = 0;
  bool has_charges = false;
  gemmi::cif::Table table = places_of(block, place);
  for (gemmi::cif::Table::Row row : table) {
    const std::string atom = row.has2(kAtom) ? row.str(kAtom) : "";
    if (!row.has2(kX) || !row.has2(kY) || !row.has2(kZ)) {
      ++without_place;
      continue;
    }
    std::array<double, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string text = row.str(axis);
      const auto number = parse_double(std::string_view(text).substr(0, text.find('(')));
      const std::string what = std::string(kAtomPrefix) + place.tags[axis] + " of the atom " + quote(atom);
      if (!number) return Error{"expected a number for " + what + " but found " + quote(text), file, 0, 0, ""};
      if (const char* fault = coordinate_fault(*number))
        return Error{what + " " + fault + ": " + quote(text), file, 0, 0, ""};
      at[axis] = *number;
    }
    spheres.x.push_back(at[0]);
    spheres.y.push_back(at[1]);
    spheres.z.push_back(at[2]);
    const std::string symbol = row.has2(kSymbol) ? row.str(kSymbol) : "";
    spheres.attributes.element.push_back(static_cast<std::uint8_t>(element_of_type_symbol(symbol)));
    const auto charged = row.has2(kCharge) ? parse_double(row.str(kCharge)) : std::nullopt;
    charge.values.push_back(charged.value_or(0));
    has_charges = has_charges || charge.values.back() != 0;
    names.add(atom);
    residues.add(row.has2(kComponent) ? row.str(kComponent) : "");
  }
  if (has_charges) spheres.attributes.numbers.push_back(std::move(charge));
  const NamedTexts names_of_atoms = names.take("name");
  take_bonds(block, names_of_atoms, spheres.attributes.bonds);
  spheres.attributes.texts.push_back(printable_texts(names_of_atoms));
  spheres.attributes.texts.push_back(printable_texts(residues.take("resname")));
  spheres.rules.push_back("atoms: the monomer " + quote(block.name) + ", " + place.name);
  if (without_place > 0)
    spheres.warnings.push_back(file + ": " + spheres_have(without_place) +
                               " no place ('?'), so the file's other atoms are shown");
  return spheres;
}

}  // namespace

Result<std::optional<RawSpheres>> read_chem_comp(std::string_view text, const std::string& file, std::int64_t frame) {
  namespace cif = gemmi::cif;
  cif::Document document;
  tao::pegtl::memory_input<> input(text.data(), text.size(), file);
  tao::pegtl::parse<cif::rules::file, CifActions, CifErrors>(input, document);
  std::vector<std::pair<cif::Block*, const PlaceTags*>> monomers;
  for (cif::Block& block : document.blocks)
    if (const PlaceTags* place = best_places(block)) monomers.emplace_back(&block, place);
  if (monomers.empty()) return std::optional<RawSpheres>();
  const auto frames = static_cast<std::int64_t>(monomers.size());
  if (frame < 0 || frame >= frames) return no_such_frame(file, frame, frames);
  const auto& [block, place] = monomers[static_cast<std::size_t>(frame)];
  Result<RawSpheres> spheres = read_monomer(*block, *place, file);
  if (!spheres) return spheres.error();
  spheres->frames = frames;
  return std::optional<RawSpheres>(std::move(*spheres));
}

}  // namespace bihive
