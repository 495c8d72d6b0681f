#include "bihive/io/formats/molecules/cif_symmetry.h"

#include <cmath>
#include <cstddef>
#include <gemmi/cif.hpp>
#include <gemmi/symmetry.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

using Operations = std::vector<SymmetryOperation>;

// A face-centred cubic group has 192.
constexpr std::size_t kMostListed = 192;
// Magnetic CIF lists operations and centrings, and its cell may be twice as large.
constexpr std::size_t kMostOperations = 4 * kMostListed;

SymmetryOperation operation_of(const gemmi::Op& op) {
  SymmetryOperation made;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) made.turn[i][j] = double(op.rot[i][j]) / gemmi::Op::DEN;
    made.shift[i] = double(op.tran[i]) / gemmi::Op::DEN;
  }
  return made;
}

// `second` after `first`.
SymmetryOperation product(const SymmetryOperation& second, const SymmetryOperation& first) {
  SymmetryOperation made;
  made.shift = second.shift;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      made.shift[i] += second.turn[i][k] * first.shift[k];
      for (std::size_t j = 0; j < 3; ++j) made.turn[i][j] += second.turn[i][k] * first.turn[k][j];
    }
  return made;
}

// "x+.5, y, z+.333" as "x+12/24, y, z+8/24": gemmi reads fractions. Decimals that are near none stay as they are.
std::string with_fractions(const std::string& text) {
  std::string made;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find_first_not_of("0123456789.", at);
    end = std::min(end, text.size());
    const std::string_view number = std::string_view(text).substr(at, end - at);
    const auto value = number.find('.') == std::string_view::npos ? std::nullopt : parse_double(number);
    const double parts = value ? *value * gemmi::Op::DEN : 0;
    if (value && parts < 1000 && std::abs(parts - std::round(parts)) < 0.02)
      made += std::to_string(std::lround(parts)) + "/" + std::to_string(gemmi::Op::DEN);
    else
      made += number;
    if (end == at) made += text[end++];
    at = end;
  }
  return made;
}

// "x,y,z,-1" as "x,y,z": whether time is reversed changes no position.
std::string without_time(const std::string& text) {
  std::size_t comma = 0;
  for (int commas = 0; commas < 3; ++commas) {
    comma = text.find(',', comma + (commas > 0 ? 1 : 0));
    if (comma == std::string::npos) return text;
  }
  return text.substr(0, comma);
}

// Those under a tag, none if it is not there or has no values.
Result<Operations> listed(gemmi::cif::Block& block, const char* tag, bool is_magnetic) {
  Operations operations;
  gemmi::cif::Column column = block.find_values(tag);
  if (column.length() <= 0) return operations;
  const int line = column.item() ? column.item()->line_number : 0;
  if (static_cast<std::size_t>(column.length()) > kMostListed)
    return Error{"expected at most 192 operations of symmetry", "", line, 0, ""};
  for (int i = 0; i < column.length(); ++i) {
    if (gemmi::cif::is_null(column[i])) continue;
    const std::string text = column.str(i);
    try {
      if (text.size() > 80) throw std::runtime_error("too long");
      const std::string triplet = is_magnetic ? without_time(text) : text;
      operations.push_back(operation_of(gemmi::parse_triplet(with_fractions(triplet))));
    } catch (const std::runtime_error&) {
      return Error{"expected an operation of symmetry such as 'x, y+1/2, -z' but found " + quote(text), "", line, 0,
                   ""};
    }
  }
  return operations;
}

std::string count_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " operation" : " operations");
}

// Magnetic CIF: every operation after every centring.
Result<CifSymmetry> magnetic(gemmi::cif::Block& block) {
  const Result<Operations> operations = listed(block, "_space_group_symop_magn_operation_xyz", true);
  if (!operations) return operations.error();
  Result<Operations> centrings = listed(block, "_space_group_symop_magn_centering_xyz", true);
  if (!centrings) return centrings.error();
  CifSymmetry symmetry;
  if (operations->empty()) return symmetry;
  if (centrings->empty()) centrings->push_back(operation_of(gemmi::Op::identity()));
  if (operations->size() * centrings->size() > kMostOperations)
    return Error{"expected at most " + std::to_string(kMostOperations) + " operations of magnetic symmetry", "", 0, 0,
                 ""};
  for (const SymmetryOperation& centring : *centrings)
    for (const SymmetryOperation& operation : *operations) symmetry.operations.push_back(product(centring, operation));
  symmetry.rule = "symmetry: the " + count_text(symmetry.operations.size()) + " of the magnetic group in the file";
  return symmetry;
}

const gemmi::SpaceGroup* group_of_hall(const std::string& name) {
  for (const gemmi::SpaceGroup& one : gemmi::spacegroup_tables::main)
    if (name == one.hall) return &one;
  return nullptr;
}

// Some groups have hexagonal and rhombohedral axes; the cell's angles tell which these are.
const gemmi::SpaceGroup* group_named(const std::string& name, double alpha, double gamma) {
  if (name.empty() || name.size() >= 80) return nullptr;
  const auto number = parse_int(name);
  if (!number) return gemmi::find_spacegroup_by_name(name, alpha, gamma);
  if (*number < 1 || *number > 230) return nullptr;
  const gemmi::SpaceGroup* const numbered = gemmi::find_spacegroup_by_number(static_cast<int>(*number));
  return numbered != nullptr ? gemmi::find_spacegroup_by_name(numbered->hm, alpha, gamma) : nullptr;
}

// The first tag with a value that states symmetry in a form that is not read; empty: there is none.
std::string unread_symmetry(const gemmi::cif::Block& block) {
  const auto states_symmetry = [](const std::string& tag) {
    const std::string lower = lower_case(tag);
    for (const char* const harmless : {"_space_group_crystal_system", "_space_group_id", "_symmetry_cell_setting"})
      if (lower == harmless) return false;
    for (const char* const category : {"_space_group", "_symmetry", "_magnetic_space_group", "_parent_space_group"})
      if (lower.rfind(category, 0) == 0) return true;
    return false;
  };
  const auto is_null = [](const std::string& value) { return gemmi::cif::is_null(value); };
  for (const gemmi::cif::Item& item : block.items) {
    if (item.type == gemmi::cif::ItemType::Pair && states_symmetry(item.pair[0]) && !is_null(item.pair[1]))
      return item.pair[0];
    if (item.type != gemmi::cif::ItemType::Loop) continue;
    const gemmi::cif::Loop& loop = item.loop;
    for (std::size_t i = 0; i < loop.tags.size(); ++i) {
      if (!states_symmetry(loop.tags[i])) continue;
      for (std::size_t at = i; at < loop.values.size(); at += loop.tags.size())
        if (!is_null(loop.values[at])) return loop.tags[i];
    }
  }
  return "";
}

}  // namespace

Vec3d SymmetryOperation::of(Vec3d f) const {
  Vec3d image;
  for (int i = 0; i < 3; ++i) {
    const auto& row = turn[static_cast<std::size_t>(i)];
    image[i] = row[0] * f.x + row[1] * f.y + row[2] * f.z + shift[static_cast<std::size_t>(i)];
  }
  return image;
}

Result<CifSymmetry> symmetry_of(gemmi::cif::Block& block, double alpha, double gamma) {
  // The operations that the file lists come before those of the group that it names.
  CifSymmetry symmetry;
  for (const char* const tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz"}) {
    Result<Operations> operations = listed(block, tag, false);
    if (!operations) return operations.error();
    if (operations->empty()) continue;
    symmetry.operations = std::move(*operations);
    symmetry.rule = "symmetry: the " + count_text(symmetry.operations.size()) + " of the file";
    return symmetry;
  }
  Result<CifSymmetry> of_magnetic = magnetic(block);
  if (!of_magnetic || !of_magnetic->operations.empty()) return of_magnetic;

  std::string name;
  const gemmi::SpaceGroup* group = nullptr;
  const auto look_for = [&](const char* tag, auto find) {
    const std::string* const value = block.find_value(tag);
    if (value == nullptr || group != nullptr || gemmi::cif::is_null(*value)) return;
    name = gemmi::cif::as_string(*value);
    group = find(name);
  };
  for (const char* const tag : {"_space_group_name_Hall", "_symmetry_space_group_name_Hall"})
    look_for(tag, group_of_hall);
  for (const char* const tag : {"_space_group_name_H-M_alt", "_symmetry_space_group_name_H-M",
                                "_space_group_name_H-M_full", "_space_group_IT_number", "_symmetry_Int_Tables_number"})
    look_for(tag, [alpha, gamma](const std::string& text) { return group_named(text, alpha, gamma); });
  if (group != nullptr) {
    for (const gemmi::Op& op : group->operations()) symmetry.operations.push_back(operation_of(op));
    symmetry.rule = "symmetry: the " + count_text(symmetry.operations.size()) + " of the group " + group->xhm();
    return symmetry;
  }

  symmetry.operations.push_back(operation_of(gemmi::Op::identity()));
  if (!name.empty())
    symmetry.warning = "the space group " + quote(name) + " is unknown, so the atoms stay without their images";
  else if (const std::string tag = unread_symmetry(block); !tag.empty())
    symmetry.warning =
        "symmetry is stated, but not in a form that is read (" + printable(tag) + "), so the atoms stay without images";
  else
    symmetry.rule = "symmetry: none, as the file states none";
  return symmetry;
}

}  // namespace bihive
