#include "commands/measure_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "bihive/io/column_choice.h"
#include "bihive/io/elements.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/selection.h"

namespace bihive::cli {
namespace {

template <class NameOf>
SphereGroups groups_by(std::int64_t count, const std::uint8_t* mask, const NameOf& name_of) {
  SphereGroups groups;
  groups.group_of_sphere.assign(static_cast<std::size_t>(count), -1);
  std::map<std::string, std::int32_t> known;
  for (std::size_t id = 0; id < groups.group_of_sphere.size(); ++id) {
    if (mask != nullptr && mask[id] == 0) continue;
    const auto [at, is_new] = known.try_emplace(name_of(id), static_cast<std::int32_t>(groups.names.size()));
    if (is_new) groups.names.push_back(at->first);
    groups.group_of_sphere[id] = at->second;
  }
  return groups;
}

}  // namespace

SphereGroups groups_by_column(const SphereSet& spheres, const std::string& column, const std::uint8_t* mask) {
  const SphereAttributes& attributes = spheres.attributes();
  std::vector<std::string_view> names{column};
  if (column == kMoleculeColumns.front()) names.assign(kMoleculeColumns.begin(), kMoleculeColumns.end());
  for (const std::string_view name : names) {
    if (const NamedTexts* const texts = attributes.find_texts(name))
      return groups_by(spheres.size(), mask, [&](std::size_t i) { return texts->of(i); });
    if (const NamedNumbers* const numbers = attributes.find_numbers(name))
      return groups_by(spheres.size(), mask, [&](std::size_t i) { return fmt::format("{:.9g}", numbers->values[i]); });
  }
  if (column == "element" && !attributes.element.empty())
    return groups_by(spheres.size(), mask, [&](std::size_t i) { return element_symbol(attributes.element[i]); });
  if (column == "type" && !attributes.type.empty())
    return groups_by(spheres.size(), mask, [&](std::size_t i) { return fmt::format("{}", attributes.type[i]); });
  std::string known;
  for (const NamedTexts& texts : attributes.texts) known += " " + texts.name;
  for (const NamedNumbers& numbers : attributes.numbers) known += " " + numbers.name;
  if (!attributes.element.empty()) known += " element";
  if (!attributes.type.empty()) known += " type";
  fail_setting("by", ": there is no column \"" + escaped(column) + "\"",
               known.empty() ? "the input has no columns" : "there are" + escaped(known));
}

SphereGroups groups_by_selections(const SphereSet& spheres, const std::vector<std::string>& expressions,
                                  const std::uint8_t* mask) {
  SphereGroups groups;
  groups.names = expressions;
  groups.group_of_sphere.assign(static_cast<std::size_t>(spheres.size()), -1);
  for (std::size_t g = 0; g < expressions.size(); ++g) {
    const std::vector<std::uint8_t> selected = selected_or_fail(spheres, expressions[g], "group");
    bool is_empty = true;
    for (std::size_t i = 0; i < selected.size(); ++i) {
      if (selected[i] == 0 || (mask != nullptr && mask[i] == 0)) continue;
      std::int32_t& group = groups.group_of_sphere[i];
      if (group >= 0)
        fail_setting("group",
                     fmt::format(": sphere {} is in \"{}\" and in \"{}\"", i, escaped(expressions[group]),
                                 escaped(expressions[g])),
                     "groups must not have common spheres");
      group = static_cast<std::int32_t>(g);
      is_empty = false;
    }
    if (is_empty) fail({"no sphere is selected by " + expressions[g], "", 0, 0, "bihive select counts"});
  }
  return groups;
}

}  // namespace bihive::cli
