#include "bihive/io/write_molecules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/base/readable.h"
#include "bihive/io/elements.h"

namespace bihive {
namespace {

constexpr std::int64_t kMostInColumns = 999;
constexpr std::size_t kLongestTitleLine = 300;

std::string symbol_or(const SphereSet& spheres, std::int64_t id, const char* of_none) {
  const std::vector<std::uint8_t>& element = spheres.attributes().element;
  const std::string symbol = element.empty() ? "" : element_symbol(element[static_cast<std::size_t>(id)]);
  return symbol.empty() ? of_none : symbol;
}

// A field between blanks.
std::string one_field(std::string_view text, const std::string& of_none) {
  std::string field;
  for (const char c : text) field += static_cast<unsigned char>(c) <= ' ' ? '_' : c;
  return field.empty() ? of_none : field;
}

// The shortest decimal whose value in binary32 is that of the coordinate, or in binary64 if binary32 has no such one.
std::string coordinate_text(double value) {
  const auto single = static_cast<float>(value);
  return double(single) == value && std::abs(value) < 3.4e38 ? fmt::format("{}", single) : fmt::format("{}", value);
}

// Whether four decimals in ten columns read as the same binary32.
bool fits_columns(double value) {
  const std::string text = fmt::format("{:.4f}", value);
  return text.size() <= 10 && static_cast<float>(parse_double(text).value_or(0)) == static_cast<float>(value);
}

// Attributes that have no place in the format.
void note_attributes(const SphereSet& spheres, const std::vector<std::string>& held, WrittenSpheres& written) {
  const SphereAttributes& attributes = spheres.attributes();
  std::string names = "radius";
  const auto note = [&](const std::string& name) {
    if (std::find(held.begin(), held.end(), name) == held.end()) names += ", " + name;
  };
  for (const NamedNumbers& numbers : attributes.numbers) note(numbers.name);
  for (const NamedTexts& texts : attributes.texts) note(texts.name);
  if (!attributes.colour.empty()) note("colour");
  if (!attributes.opacity.empty()) note("opacity");
  written.left_out.push_back(names + ": the format has no place for them");
}

// The charges to write; null: the set has none, or some are not whole.
const NamedNumbers* whole_charges(const SphereSet& spheres) {
  const NamedNumbers* const charge = spheres.attributes().find_numbers("charge");
  if (charge == nullptr) return nullptr;
  const bool are_whole = std::all_of(charge->values.begin(), charge->values.end(), [](double one) {
    return std::isnan(one) || (std::floor(one) == one && std::abs(one) <= 15);
  });
  return are_whole ? charge : nullptr;
}

int type_of_sdf(BondOrder order) {
  return order == BondOrder::unknown ? 1 : static_cast<int>(order);
}

const char* type_of_mol2(BondOrder order) {
  constexpr const char* kTypes[] = {"un", "1", "2", "3", "ar"};
  return kTypes[static_cast<std::size_t>(order)];
}

void append_v2000(const SphereSet& spheres, const NamedNumbers* charges, std::string& out) {
  const auto& bonds = spheres.attributes().bonds.list;
  fmt::format_to(std::back_inserter(out), "{:3}{:3}  0  0  0  0  0  0  0  0999 V2000\n", spheres.size(), bonds.size());
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d at = spheres.centre(id);
    fmt::format_to(std::back_inserter(out), "{:10.4f}{:10.4f}{:10.4f} {:<3} 0  0  0  0  0  0  0  0  0  0  0  0\n", at.x,
                   at.y, at.z, symbol_or(spheres, id, "*"));
  }
  for (const StatedBond& bond : bonds)
    fmt::format_to(std::back_inserter(out), "{:3}{:3}{:3}  0\n", bond.one + 1, bond.other + 1, type_of_sdf(bond.order));
  if (charges == nullptr) return;
  std::vector<std::size_t> charged;
  for (std::size_t i = 0; i < charges->values.size(); ++i)
    if (std::abs(charges->values[i]) > 0) charged.push_back(i);
  constexpr std::size_t kOfLine = 8;
  for (std::size_t first = 0; first < charged.size(); first += kOfLine) {
    const std::size_t end = std::min(first + kOfLine, charged.size());
    fmt::format_to(std::back_inserter(out), "M  CHG{:3}", end - first);
    for (std::size_t k = first; k < end; ++k)
      fmt::format_to(std::back_inserter(out), " {:3} {:3}", charged[k] + 1, int(charges->values[charged[k]]));
    out += '\n';
  }
}

void append_v3000(const SphereSet& spheres, const NamedNumbers* charges, std::string& out) {
  const auto& bonds = spheres.attributes().bonds.list;
  fmt::format_to(std::back_inserter(out),
                 "  0  0  0     0  0            999 V3000\nM  V30 BEGIN CTAB\nM  V30 COUNTS {} {} 0 0 0\n"
                 "M  V30 BEGIN ATOM\n",
                 spheres.size(), bonds.size());
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d at = spheres.centre(id);
    fmt::format_to(std::back_inserter(out), "M  V30 {} {} {} {} {} 0", id + 1, symbol_or(spheres, id, "*"),
                   coordinate_text(at.x), coordinate_text(at.y), coordinate_text(at.z));
    const double charge = charges == nullptr ? 0 : charges->values[static_cast<std::size_t>(id)];
    if (std::abs(charge) > 0) fmt::format_to(std::back_inserter(out), " CHG={}", int(charge));
    out += '\n';
  }
  out += "M  V30 END ATOM\nM  V30 BEGIN BOND\n";
  std::size_t number = 0;
  for (const StatedBond& bond : bonds)
    fmt::format_to(std::back_inserter(out), "M  V30 {} {} {} {}\n", ++number, type_of_sdf(bond.order), bond.one + 1,
                   bond.other + 1);
  out += "M  V30 END BOND\nM  V30 END CTAB\n";
}

}  // namespace

WrittenSpheres write_sdf(const SphereSet& spheres, std::string_view title) {
  WrittenSpheres written;
  const auto& bonds = spheres.attributes().bonds.list;
  const NamedNumbers* const charges = whole_charges(spheres);
  bool in_columns = spheres.size() <= kMostInColumns && static_cast<std::int64_t>(bonds.size()) <= kMostInColumns;
  for (std::int64_t id = 0; in_columns && id < spheres.size(); ++id) {
    const Vec3d at = spheres.centre(id);
    in_columns = fits_columns(at.x) && fits_columns(at.y) && fits_columns(at.z);
  }
  // "$$$$" would end the record.
  const std::string line = one_line(title, kLongestTitleLine);
  written.bytes = (line.starts_with("$$$$") ? " " + line : line) + "\n  bihive          3D\n\n";
  if (in_columns)
    append_v2000(spheres, charges, written.bytes);
  else
    append_v3000(spheres, charges, written.bytes);
  written.bytes += "M  END\n$$$$\n";

  std::vector<std::string> held{"symbol"};
  if (charges != nullptr) held.emplace_back("charge");
  note_attributes(spheres, held, written);
  if (std::any_of(bonds.begin(), bonds.end(), [](const StatedBond& bond) { return bond.order == BondOrder::unknown; }))
    written.left_out.emplace_back("bonds of unknown order became single");
  return written;
}

WrittenSpheres write_mol2(const SphereSet& spheres, std::string_view title) {
  WrittenSpheres written;
  const SphereAttributes& attributes = spheres.attributes();
  const NamedNumbers* const charges = attributes.find_numbers("charge");
  const NamedNumbers* const numbers = attributes.find_numbers("resid");
  const NamedTexts* const names = attributes.find_texts("name");
  const NamedTexts* const residues = attributes.find_texts("resname");
  const NamedTexts* const types = attributes.find_texts("type");
  std::string& out = written.bytes;
  const std::string line = one_line(title, kLongestTitleLine);
  fmt::format_to(std::back_inserter(out), "@<TRIPOS>MOLECULE\n{}\n{} {} 1\nSMALL\n{}\n\n@<TRIPOS>ATOM\n",
                 line.starts_with('@') || line.starts_with('#') ? " " + line : line, spheres.size(),
                 attributes.bonds.list.size(), charges == nullptr ? "NO_CHARGES" : "USER_CHARGES");
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const auto i = static_cast<std::size_t>(id);
    const Vec3d at = spheres.centre(id);
    const std::string symbol = symbol_or(spheres, id, "Du");
    // The type of SYBYL that the file had, if it is one of this element.
    const std::string label = types == nullptr ? "" : one_field(types->of(i), "");
    const std::string type = label.substr(0, label.find('.')) == symbol ? label : symbol;
    const double number = numbers == nullptr ? 1 : numbers->values[i];
    const bool has_number = std::floor(number) == number && std::abs(number) < 0x1p53;
    fmt::format_to(std::back_inserter(out), "{} {} {} {} {} {} {} {}", id + 1,
                   names == nullptr ? fmt::format("{}{}", symbol, id + 1) : one_field(names->of(i), symbol),
                   coordinate_text(at.x), coordinate_text(at.y), coordinate_text(at.z), type,
                   has_number ? static_cast<std::int64_t>(number) : 1,
                   residues == nullptr ? "UNL" : one_field(residues->of(i), "UNL"));
    if (charges != nullptr)
      fmt::format_to(std::back_inserter(out), " {}", std::isfinite(charges->values[i]) ? charges->values[i] : 0);
    out += '\n';
  }
  out += "@<TRIPOS>BOND\n";
  std::size_t number = 0;
  for (const StatedBond& bond : attributes.bonds.list)
    fmt::format_to(std::back_inserter(out), "{} {} {} {}\n", ++number, bond.one + 1, bond.other + 1,
                   type_of_mol2(bond.order));
  note_attributes(spheres, {"charge", "resid", "name", "resname", "type"}, written);
  return written;
}

}  // namespace bihive
