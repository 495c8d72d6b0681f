#include "bihive/settings/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/setting_name.h"
#include "bihive/image/colour_text.h"

namespace bihive {
namespace {

std::string number_text(double value) {
  return fmt::format("{}", value);
}

// The largest float means "any finite number".
bool is_bounded(double limit) {
  return std::abs(limit) < 3e38;
}

std::string range_of(const Parameter& p) {
  if (p.or_zero) return "0, or a number from " + number_text(p.least) + " to " + number_text(p.most);
  if (is_bounded(p.most)) return "from " + number_text(p.least) + " to " + number_text(p.most);
  if (!is_bounded(p.least)) return "";
  return (p.above_least ? "above " : "of at least ") + number_text(p.least);
}

bool in_range(const Parameter& p, double value) {
  if (p.or_zero && value == 0) return true;
  return (p.above_least ? value > p.least : value >= p.least) && value <= p.most;
}

// The items of "none|soft|filmic".
std::vector<std::string> items_of(std::string_view list) {
  std::vector<std::string> items;
  for (std::string_view rest = list; !rest.empty();) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    items.emplace_back(rest.substr(0, bar));
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return items;
}

}  // namespace

const Parameter* first_cpu_only(const PictureSettings& settings) {
  static const PictureSettings defaults;
  for (const Parameter& row : picture_parameters())
    if (row.cpu_only && row.group != ParameterGroup::lines && row.get(settings) != row.get(defaults)) return &row;
  return nullptr;
}

const Parameter* parameter_named(std::string_view id) {
  for (const Parameter& parameter : picture_parameters())
    if (parameter.id == id || (!parameter.alias.empty() && parameter.alias == id)) return &parameter;
  return nullptr;
}

std::vector<std::string> names_of(const Parameter& parameter) {
  return items_of(parameter.names);
}

std::vector<std::string> choice_labels_of(const Parameter& parameter) {
  return items_of(parameter.choice_labels.empty() ? parameter.names : parameter.choice_labels);
}

std::vector<const Parameter*> controls_of(ParameterGroup group) {
  std::vector<const Parameter*> controls;
  for (const Parameter& parameter : picture_parameters())
    if (parameter.group == group && parameter.in_window && !parameter.label.empty()) controls.push_back(&parameter);
  std::stable_sort(controls.begin(), controls.end(),
                   [](const Parameter* a, const Parameter* b) { return a->place < b->place; });
  return controls;
}

std::string expected_by(const Parameter& parameter) {
  const std::string range = range_of(parameter);
  const std::string null = parameter.nullable ? ", or null" : "";
  std::string names;
  switch (parameter.kind) {
    case ParameterKind::flag:
      return "true or false";
    case ParameterKind::whole:
      return "a whole number " + range + null;
    case ParameterKind::number:
      if (parameter.or_zero) return range + null;
      return (range.empty() ? "a number" : "a number " + range) + null;
    case ParameterKind::choice:
      for (const std::string& name : names_of(parameter)) names += (names.empty() ? "" : ", ") + name;
      return "one of " + names;
    case ParameterKind::text:
      return parameter.nullable ? "a text or null" : "a text";
    case ParameterKind::colour:
      break;
  }
  return "#rrggbb, three numbers from 0 to 1, or the name of a colour";
}

bool fits(const Parameter& parameter, const SettingValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return parameter.nullable;
  switch (parameter.kind) {
    case ParameterKind::flag:
      return std::holds_alternative<bool>(value);
    case ParameterKind::whole: {
      const auto* const number = std::get_if<std::int64_t>(&value);
      return number != nullptr && in_range(parameter, static_cast<double>(*number));
    }
    case ParameterKind::number: {
      const auto* const number = std::get_if<double>(&value);
      return number != nullptr && in_range(parameter, *number);
    }
    case ParameterKind::choice: {
      const auto* const position = std::get_if<std::int64_t>(&value);
      return position != nullptr && *position >= 0 && *position < std::ssize(names_of(parameter));
    }
    case ParameterKind::text:
      return std::holds_alternative<std::string>(value);
    case ParameterKind::colour:
      break;
  }
  if (const auto* const text = std::get_if<std::string>(&value))
    return colour_from_text(*text, Transfer::none).has_value();
  const auto* const colour = std::get_if<Vec3d>(&value);
  if (colour == nullptr) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (!((*colour)[axis] >= 0 && (*colour)[axis] <= 1)) return false;
  return true;
}

std::string option_of(const Parameter& parameter) {
  return option_of_setting(parameter.id);
}

}  // namespace bihive
