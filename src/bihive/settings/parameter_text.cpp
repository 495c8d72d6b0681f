#include "bihive/settings/parameter_text.h"

#include <optional>

#include "bihive/base/parse_number.h"
#include "bihive/image/colour_text.h"
#include "bihive/math/vector_text.h"

namespace bihive {
namespace {

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
  if (const auto colour = vector_from_text(text)) return *colour;
  if (colour_from_text(text, Transfer::none)) return text;
  return std::nullopt;
}

}  // namespace

Result<SettingValue> value_from_text(const Parameter& parameter, const std::string& text) {
  std::optional<SettingValue> value = parsed(parameter, text);
  if (value && fits(parameter, *value)) return std::move(*value);
  Parameter named = parameter;
  named.nullable = false;  // null is a keyword of JSON
  return unexpected(expected_by(named), text);
}

}  // namespace bihive
