#include "bihive/io/formats/molecules/cif_connections.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/residue_runs.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// What names an atom: chain, residue number, insertion code, residue, name, alternate location.
std::string name_of(std::string_view chain, std::int64_t number, std::string_view insertion, std::string_view residue,
                    std::string_view name, char mark) {
  std::string made(chain);
  const std::string digits = std::to_string(number);
  for (const std::string_view text : {std::string_view(digits), insertion, residue, name})
    made.append("\n").append(text);
  if (mark != 0) made.append("\n").append(1, mark);
  return made;
}

struct End {
  std::string name;
  std::int64_t residue_number = 0;
};

class Connection {
 public:
  explicit Connection(const CifRow& row) : row_(row) {}

  bool is_bond() const {
    const std::string type = lower_case(item({"conn_type_id"}));
    return type.rfind("covale", 0) == 0 || type == "disulf" || type == "metalc" || type == "modres";
  }
  bool goes_to_symmetry_mate() const { return item({"ptnr1_symmetry"}) != item({"ptnr2_symmetry"}); }
  BondOrder order() const {
    const std::string order = lower_case(item({"pdbx_value_order"}));
    if (order == "sing") return BondOrder::single;
    if (order == "doub") return BondOrder::double_bond;
    return order == "trip" ? BondOrder::triple : BondOrder::unknown;
  }
  // The author's names, else the label's, as those of atoms.
  std::optional<End> end(const std::string& partner) const {
    const auto of = [&](const std::string& author, const std::string& label) {
      return item({partner + "_" + author, partner + "_" + label});
    };
    const auto number = parse_int(of("auth_seq_id", "label_seq_id"));
    if (!number) return std::nullopt;
    const std::string mark = item({"pdbx_" + partner + "_label_alt_id"});
    return End{name_of(of("auth_asym_id", "label_asym_id"), *number, item({"pdbx_" + partner + "_pdb_ins_code"}),
                       of("auth_comp_id", "label_comp_id"), of("auth_atom_id", "label_atom_id"),
                       mark.empty() ? char{0} : mark.front()),
               *number};
  }

 private:
  // The first of these that the row has.
  std::string item(std::initializer_list<std::string> names) const {
    for (const std::string& name : names)
      if (const auto found = row_.find("_struct_conn." + name); found != row_.end() && !found->second.empty())
        return found->second;
    return "";
  }

  const CifRow& row_;
};

}  // namespace

void add_connections(const std::vector<CifRow>& rows, const std::string& marks, RawSpheres& spheres) {
  struct Bond {
    End one, other;
    BondOrder order;
  };
  std::vector<Bond> bonds;
  for (const CifRow& row : rows) {
    const Connection connection(row);
    if (!connection.is_bond() || connection.goes_to_symmetry_mate()) continue;
    const std::optional<End> one = connection.end("ptnr1"), other = connection.end("ptnr2");
    if (one && other) bonds.push_back({*one, *other, connection.order()});
  }
  if (bonds.empty()) return;

  // Find the spheres. Most are in residues that no bond names.
  constexpr std::int64_t kNone = 0, kSeveral = -1;
  std::unordered_map<std::string, std::int64_t> position_of;  // from 1
  std::unordered_set<std::int64_t> numbers;
  for (const Bond& bond : bonds)
    for (const End& end : {bond.one, bond.other}) {
      position_of[end.name] = kNone;
      numbers.insert(end.residue_number);
    }
  const SphereAttributes& attributes = spheres.attributes;
  const NamedNumbers* const number = attributes.find_numbers("resid");
  const NamedTexts* const insertion = attributes.find_texts("insertion");
  const NamedTexts* const columns[] = {attributes.find_texts("chain"), attributes.find_texts("resname"),
                                       attributes.find_texts("name")};
  for (const NamedTexts* const column : columns)
    if (column == nullptr || number == nullptr) return;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double of_residue = number->values[i];
    if (!(of_residue > -0x1p53 && of_residue < 0x1p53)) continue;
    const auto whole = static_cast<std::int64_t>(of_residue);
    if (!numbers.contains(whole)) continue;
    const std::string name = name_of(columns[0]->of(i), whole, insertion != nullptr ? insertion->of(i) : "",
                                     columns[1]->of(i), columns[2]->of(i), marks[i]);
    if (const auto wanted = position_of.find(name); wanted != position_of.end())
      wanted->second = wanted->second == kNone ? static_cast<std::int64_t>(i + 1) : kSeveral;
  }
  for (const Bond& bond : bonds)
    add_bond(spheres, position_of[bond.one.name], position_of[bond.other.name], bond.order);
}

BondOrder order_of_component_bond(const std::string& value_order, bool is_aromatic) {
  const std::string value = lower_case(value_order);
  if (is_aromatic || value.starts_with("arom")) return BondOrder::aromatic;
  if (value.starts_with("sing")) return BondOrder::single;
  if (value.starts_with("doub")) return BondOrder::double_bond;
  return value.starts_with("trip") ? BondOrder::triple : BondOrder::unknown;
}

void add_component_bonds(const std::vector<CifRow>& rows, const std::string& marks, RawSpheres& spheres) {
  struct BondOfNames {
    std::int32_t one, other;  // positions of names in the column
    BondOrder order;
  };
  const SphereAttributes& attributes = spheres.attributes;
  const NamedTexts* const names = attributes.find_texts("name");
  const NamedTexts* const residues = attributes.find_texts("resname");
  const NamedNumbers* const number = attributes.find_numbers("resid");
  if (names == nullptr || residues == nullptr || number == nullptr) return;

  // Find the components and names of the rows in the columns.
  const auto positions = [](const NamedTexts& column) {
    std::unordered_map<std::string, std::int32_t> position_of;
    for (std::size_t k = 0; k < column.texts.size(); ++k)
      position_of.emplace(column.texts[k], static_cast<std::int32_t>(k));
    return position_of;
  };
  std::unordered_map<std::string, std::int32_t> position_of_name, position_of_residue;
  std::vector<std::vector<BondOfNames>> bonds_of(residues->texts.size());
  bool any = false;
  for (const CifRow& row : rows) {
    const auto item = [&row](const char* name) {
      const auto found = row.find(std::string("_chem_comp_bond.") + name);
      return found == row.end() ? std::string() : found->second;
    };
    const std::string component = item("comp_id");
    if (component.empty()) continue;
    if (position_of_residue.empty()) {
      position_of_residue = positions(*residues);
      position_of_name = positions(*names);
    }
    const auto of = position_of_residue.find(component);
    const auto one = position_of_name.find(item("atom_id_1")), other = position_of_name.find(item("atom_id_2"));
    if (of == position_of_residue.end() || one == position_of_name.end() || other == position_of_name.end()) continue;
    bonds_of[static_cast<std::size_t>(of->second)].push_back(
        {one->second, other->second, order_of_component_bond(item("value_order"), item("pdbx_aromatic_flag") == "Y")});
    any = true;
  }
  if (!any) return;

  // Go through the residues.
  const std::vector<std::int32_t> run =
      residue_runs(attributes, spheres.size(), [number](std::size_t i) { return number->values[i]; });
  std::vector<std::pair<std::int32_t, std::int32_t>> atoms;  // name and position
  for (std::size_t begin = 0, end = 0; begin < spheres.size(); begin = end) {
    while (end < spheres.size() && run[end] == run[begin]) ++end;
    const std::vector<BondOfNames>& bonds = bonds_of[static_cast<std::size_t>(residues->text_of_sphere[begin])];
    if (bonds.empty()) continue;
    atoms.clear();
    for (std::size_t i = begin; i < end; ++i)
      atoms.emplace_back(names->text_of_sphere[i], static_cast<std::int32_t>(i));
    std::sort(atoms.begin(), atoms.end());
    const auto first_named = [&atoms](std::int32_t name) {
      return std::lower_bound(atoms.begin(), atoms.end(), std::pair(name, std::int32_t{0}));
    };
    for (const BondOfNames& bond : bonds)
      for (auto one = first_named(bond.one); one != atoms.end() && one->first == bond.one; ++one)
        for (auto other = first_named(bond.other); other != atoms.end() && other->first == bond.other; ++other) {
          const char mark = marks[static_cast<std::size_t>(one->second)];
          const char of_other = marks[static_cast<std::size_t>(other->second)];
          if (mark == 0 || of_other == 0 || mark == of_other)
            spheres.attributes.bonds.add(one->second, other->second, bond.order);
        }
  }
}

}  // namespace bihive
