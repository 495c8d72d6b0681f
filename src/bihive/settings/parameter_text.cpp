#include "bihive/settings/parameter_text.h"

#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/image/colour_text.h"

namespace bihive {
namespace {

// "R,G,B".
std::optional<Vec3d> three_numbers(std::string_view text) {
  Vec3d vector;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const std::optional<double> number = parse_double(text.substr(0, comma));
    if (!number) return std::nullopt;
    vector[axis] = *number;
    text.remove_prefix(axis < 2 ? comma + 1 : comma);
  }
  return vector;
}

// Nothing: the text does not have the parameter's kind.
std::optional<SettingValue> parsed(const Parameter& parameter, const std::string& text) {
  switch (parameter.kind) {
    case ParameterKind::flag:
      if (text == "true" || text == "false") return text == "true";
      return std::nullopt;
    case ParameterKind::whole:
      if (const auto number = parse_int(text)) return *number;
      return std::nullopt;
    case ParameterKind::number:
      if (const auto number = parse_double(text)) return *number;
      return std::nullopt;
    case ParameterKind::choice: {
      std::int64_t position = 0;
      for (const std::string& name : names_of(parameter)) {
        if (name == text) return position;
        ++position;
      }
      return std::nullopt;
    }
    case ParameterKind::text:
      return text;
    case ParameterKind::colour:
      break;
  }
  if (const auto colour = three_numbers(text)) return *colour;
  if (colour_from_text(text, Transfer::none)) return text;
  return std::nullopt;
}

}  // namespace

Result<SettingValue> value_from_text(const Parameter& parameter, const std::string& text) {
  std::optional<SettingValue> value = parsed(parameter, text);
  if (value && fits(parameter, *value)) return std::move(*value);
  Parameter named = parameter;
  named.nullable = false;  // null is a keyword of JSON
  return Error{"expected " + expected_by(named) + ", found \"" + text + "\"", "", 0, 0, ""};
}

}  // namespace bihive
