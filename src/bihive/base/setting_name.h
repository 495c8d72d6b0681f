// Names of settings in messages. The library knows a setting by its id, "radius_scale"; command lines name options,
// windows the labels of their controls.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// The name of a setting in this program's messages: its id, unless name_settings_by() was called.
std::string setting_name(std::string_view id);

/// The option of a setting: two hyphens, and the id with hyphens for underscores. An id in capitals is that of a
/// positional argument ("EXPRESSION"), and is returned unchanged.
std::string option_of_setting(std::string_view id);

/// The inverse; the leading hyphens may be missing.
std::string setting_of_option(std::string_view option);

/// For main() of a program, before it calls anything else.
void name_settings_by(std::string (*name)(std::string_view id));

}  // namespace bihive
