#include "bihive/select/attribute_names.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bihive/base/near_name.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/select/number_term.h"

namespace bihive {
namespace {

using Number = FoundAttribute::Number;

struct BuiltInName {
  std::string_view name;
  Number number;
};
constexpr BuiltInName kBuiltInNames[] = {
    {"x", Number::x},
    {"y", Number::y},
    {"z", Number::z},
    {"r", Number::radius},
    {"radius", Number::radius},
    {"index", Number::index},
    {"element", Number::element},
    {"type", Number::type},
    {"opacity", Number::opacity},
};

// Names in VMD, PyMOL, MDAnalysis and OVITO for what the readers call otherwise.
struct OtherName {
  std::string_view other, ours;
};
constexpr OtherName kOtherNames[] = {
    {"b", "b_factor"},     {"beta", "b_factor"},   {"bfactor", "b_factor"}, {"tempfactor", "b_factor"},
    {"q", "occupancy"},    {"occ", "occupancy"},   {"resi", "resid"},       {"resnum", "resid"},
    {"resn", "resname"},   {"chainid", "chain"},   {"segid", "chain"},      {"elem", "element"},
    {"symbol", "element"}, {"icode", "insertion"}, {"atomname", "name"},    {"serial", "id"},
    {"id", "serial"},
};

bool is_known(Number number, const SphereAttributes& attributes) {
  if (number == Number::element) return !attributes.element.empty();
  if (number == Number::type) return !attributes.type.empty();
  if (number == Number::opacity) return !attributes.opacity.empty();
  return true;
}

// The length of the velocity, unless a column of the input has that name.
FoundAttribute find_speed(const SphereAttributes& attributes) {
  FoundAttribute speed;
  speed.column = attributes.find_numbers("vx");
  speed.others[0] = attributes.find_numbers("vy");
  speed.others[1] = attributes.find_numbers("vz");
  if (speed.column == nullptr || speed.others[0] == nullptr || speed.others[1] == nullptr) return {};
  speed.number = Number::speed;
  return speed;
}

// The built-in name or the column of exactly this name; with `lower`, of this name in lower case.
FoundAttribute find_named(const SphereSet& spheres, std::string_view name, bool lower) {
  const SphereAttributes& attributes = spheres.attributes();
  const auto same = [name, lower](std::string_view other) { return lower ? lower_case(other) == name : other == name; };
  FoundAttribute found;
  for (const BuiltInName& built_in : kBuiltInNames)
    if (same(built_in.name) && is_known(built_in.number, attributes)) found.number = built_in.number;
  if (found.number == Number::none)
    for (const NamedNumbers& column : attributes.numbers)
      if (found.column == nullptr && same(column.name)) {
        found.number = Number::column;
        found.column = &column;
      }
  for (const NamedTexts& column : attributes.texts)
    if (found.texts == nullptr && same(column.name)) found.texts = &column;
  return found;
}

}  // namespace

double FoundAttribute::number_of(const SphereSet& spheres, std::int64_t id) const {
  const auto i = static_cast<std::size_t>(spheres.stored_id(id));
  const SphereAttributes& attributes = spheres.attributes();
  switch (number) {
    case Number::x:
      return spheres.centre(id).x;
    case Number::y:
      return spheres.centre(id).y;
    case Number::z:
      return spheres.centre(id).z;
    case Number::radius:
      return spheres.radius(id);
    case Number::index:
      return static_cast<double>(id);
    case Number::element:
      return attributes.element[i];
    case Number::type:
      return attributes.type[i];
    case Number::opacity:
      return double(attributes.opacity[i]);
    case Number::column:
      return column->values[i];
    case Number::expression:
      return term->value(spheres, id);
    case Number::speed: {
      const double x = column->values[i], y = others[0]->values[i], z = others[1]->values[i];
      return std::sqrt(x * x + y * y + z * z);
    }
    case Number::none:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

bool FoundAttribute::differs_by_image() const {
  if (number == Number::expression) return term->differs_by_image();
  return number == Number::x || number == Number::y || number == Number::z || number == Number::index;
}

FoundAttribute find_attribute(const SphereSet& spheres, std::string_view name) {
  if (const FoundAttribute found = find_named(spheres, name, false); found.found()) return found;
  const std::string lower = lower_case(name);
  if (const FoundAttribute found = find_named(spheres, lower, true); found.found()) return found;
  for (const OtherName& other : kOtherNames)
    if (other.other == lower) return find_named(spheres, other.ours, false);
  if (lower == "speed") return find_speed(spheres.attributes());
  return {};
}

std::vector<std::string> attribute_names(const SphereSet& spheres) {
  const SphereAttributes& attributes = spheres.attributes();
  std::vector<std::string> names;
  const auto add = [&names](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  };
  for (const BuiltInName& built_in : kBuiltInNames)
    if (built_in.name != "radius" && is_known(built_in.number, attributes)) add(built_in.name);
  for (const NamedNumbers& column : attributes.numbers) add(column.name);
  for (const NamedTexts& column : attributes.texts) add(column.name);
  if (find_speed(attributes).found()) add("speed");
  return names;
}

std::string list_of_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) list += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMost) list += " ...";
  return list;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = near_name(name, candidates);
  const std::string all = "there are " + list_of_names(candidates);
  if (name == "exposed_area") return setting_name("exposed_area") + " measures it when a file is read; " + all;
  return nearest.empty() ? all : "did you mean " + quote(nearest) + "? " + all;
}

}  // namespace bihive
