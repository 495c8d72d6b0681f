// Parses the value of a parameter from the text of an option.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/settings/parameter.h"

namespace bihive {

/// A number in decimal, the name of a choice, "true" or "false", a text, a colour. A colour stays a text if its meaning
/// depends on the transfer curve. Error: the expected and the found text.
Result<SettingValue> value_from_text(const Parameter& parameter, const std::string& text);

}  // namespace bihive
