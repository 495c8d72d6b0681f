#include "bihive/viewer/contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "bihive/io/elements.h"
#include "bihive/scene/colour_maps.h"
#include "bihive/scene/legend.h"
#include "bihive/select/attribute_names.h"
#include "bihive/select/number_term.h"
#include "bihive/select/selection.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

constexpr const char* kNoText = "(none)";  // as in legends

bool is_letters_and_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  });
}

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// The test of an attribute for a text. Short values need no quotes, unless they are words of the language.
std::string selection_of(const std::string& attribute, const std::string& value) {
  constexpr std::array kReserved = {"and", "or", "not", "of", "to", "same", "all", "none"};
  const bool is_plain =
      is_letters_and_digits(value) && value.size() <= 4 &&
      std::none_of(kReserved.begin(), kReserved.end(), [&value](const char* word) { return value == word; });
  return (is_letters_and_digits(attribute) ? attribute : quoted(attribute)) + " " + (is_plain ? value : quoted(value));
}

// Distinct texts with their counts, in the order of appearance; those of `mask` alone, if it is given.
std::vector<ContentGroup> groups_of_texts(const NamedTexts& column, const std::string& of,
                                          const std::vector<std::uint8_t>* mask = nullptr) {
  std::vector<std::int64_t> counts(column.texts.size(), 0);
  for (std::size_t id = 0; id < column.text_of_sphere.size(); ++id)
    if (mask == nullptr || (*mask)[id] != 0) ++counts[static_cast<std::size_t>(column.text_of_sphere[id])];
  std::vector<ContentGroup> groups;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string& text = column.texts[i];
    if (counts[i] == 0) continue;
    groups.push_back({of, text.empty() ? kNoText : text, selection_of(column.name, text), counts[i]});
    if (groups.size() > kMostGroups) return {};
  }
  return groups;
}

// Elements and types.
template <class Number, class Name>
std::vector<ContentGroup> groups_of_numbers(const std::vector<Number>& numbers, const std::string& of,
                                            const Name& name) {
  std::map<Number, std::int64_t> counts;
  for (const Number number : numbers) {
    ++counts[number];
    if (counts.size() > kMostGroups) return {};
  }
  std::vector<ContentGroup> groups;
  for (const auto& [number, count] : counts)
    if (const std::string text = name(number); !text.empty()) groups.push_back({of, text, of + " " + text, count});
  return groups;
}

void append(std::vector<ContentGroup>& all, std::vector<ContentGroup> groups, std::size_t least = 2) {
  if (groups.size() < least) return;
  all.insert(all.end(), groups.begin(), groups.end());
}

// Columns whose texts say more of one sphere than of a group.
bool tells_groups(const NamedTexts& column) {
  constexpr std::array kOthers = {"name", "resname", "record", "insertion", "entity", "chain", "type", "element"};
  return std::none_of(kOthers.begin(), kOthers.end(), [&column](const char* other) { return column.name == other; });
}

ordered_json place_json(Vec3d place) {
  return {place.x, place.y, place.z};
}

std::string hex_of(Vec3d colour) {
  const auto byte = [](double value) { return static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x), byte(colour.y), byte(colour.z));
}

std::string selection_of_entry(const std::string& attribute, const std::string& name, const SphereSet& spheres) {
  if (name == "unknown" || attribute.empty() || !find_attribute(spheres, attribute).found()) return "";
  return selection_of(attribute, name == kNoText ? "" : name);
}

ordered_json scale_json(const LegendScale& scale) {
  constexpr int kColours = 17;
  ordered_json json{{"least", scale.range.first}, {"most", scale.range.second}, {"logarithmic", scale.logarithmic}};
  for (int i = 0; i < kColours; ++i) {
    const Vec3f linear = map_colour(scale.map, static_cast<double>(i) / (kColours - 1), Transfer::srgb);
    json["colours"].push_back(hex_of(screen_colour(to_double(linear), Transfer::srgb)));
  }
  return json;
}

}  // namespace

std::vector<ContentGroup> contents_of(const SphereSet& spheres) {
  const SphereAttributes& attributes = spheres.attributes();
  std::vector<ContentGroup> all;
  const NamedTexts* const residues = attributes.find_texts("resname");
  if (residues != nullptr) {
    for (const char* word : {"protein", "nucleic", "ligand", "ion", "water"}) {
      const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, word);
      const std::int64_t count = mask ? std::count(mask->begin(), mask->end(), std::uint8_t{1}) : 0;
      if (count == 0) continue;
      all.push_back({"kind", word, word, count});
      if (all.back().name == "ligand") append(all, groups_of_texts(*residues, "ligand", &*mask), 1);
    }
    // The ligands by name stand after the kinds.
    std::stable_partition(all.begin(), all.end(), [](const ContentGroup& group) { return group.of == "kind"; });
  }
  if (const NamedTexts* chains = attributes.find_texts("chain")) append(all, groups_of_texts(*chains, "chain"));
  append(all, groups_of_numbers(attributes.element, "element", [](std::uint8_t number) {
           return number == 0 ? std::string() : element_symbol(number);
         }));
  if (const NamedTexts* labels = attributes.find_texts("type"))
    append(all, groups_of_texts(*labels, "type"));
  else
    append(all, groups_of_numbers(attributes.type, "type", [](std::int32_t type) { return std::to_string(type); }));
  for (const NamedTexts& column : attributes.texts)
    if (tells_groups(column)) append(all, groups_of_texts(column, column.name));
  return all;
}

std::string contents_to_json(const SphereSet& spheres) {
  ordered_json json{{"groups", ordered_json::array()}};
  for (const ContentGroup& group : contents_of(spheres))
    json["groups"].push_back(
        {{"of", group.of}, {"name", group.name}, {"select", group.selection}, {"count", group.count}});
  const SphereSet::Bounds bounds = spheres.bounds();
  json["low"] = place_json(bounds.lo);
  json["high"] = place_json(bounds.hi);
  return json.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
}

std::string legend_to_json(const Scene& scene) {
  ordered_json json = ordered_json::array();
  for (const LegendKey& key : legend_of(scene)) {
    ordered_json one{{"title", key.title}, {"entries", ordered_json::array()}, {"scale", nullptr}};
    for (const LegendEntry& entry : key.entries)
      one["entries"].push_back({{"name", entry.name},
                                {"colour", hex_of(entry.colour)},
                                {"select", key.scale ? "" : selection_of_entry(key.title, entry.name, scene.spheres)}});
    if (key.scale) one["scale"] = scale_json(*key.scale);
    json.push_back(std::move(one));
  }
  return json.dump(-1, ' ', /*ensure_ascii=*/false, ordered_json::error_handler_t::replace);
}

Result<std::string> histogram_to_json(const SphereSet& spheres, std::string_view attribute, int bins) {
  const Result<FoundAttribute> found = find_numbers(spheres, attribute);
  if (!found) return found.error();
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::int64_t id = 0; id < spheres.size() && found->has_numbers(); ++id) {
    const double number = found->number_of(spheres, id);
    if (!std::isfinite(number)) continue;
    least = std::min(least, number);
    most = std::max(most, number);
  }
  if (least > most) return Error{"there are no numbers of " + std::string(attribute), "", 0, 0, ""};
  std::vector<std::int64_t> counts(static_cast<std::size_t>(bins), 0);
  // The width may be beyond binary64, the halves never are.
  const double half_width = most / 2 - least / 2;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double number = found->number_of(spheres, id);
    if (!std::isfinite(number)) continue;
    const double share = half_width > 0 ? (number / 2 - least / 2) / half_width : 0;
    ++counts[static_cast<std::size_t>(std::clamp(static_cast<int>(share * bins), 0, bins - 1))];
  }
  return ordered_json{{"least", least}, {"most", most}, {"counts", counts}}.dump();
}

}  // namespace bihive
