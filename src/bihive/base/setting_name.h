// The names of settings in messages. The library knows a setting by its id, "radius_scale"; a command line calls it
// "--radius-scale", a window by the label of its control.
#pragma once

#include <string>
#include <string_view>

namespace bihive {

/// What the running program calls the setting with this id: the id itself, unless name_settings_by() said otherwise.
std::string setting_name(std::string_view id);

/// "--radius-scale". An id in capitals is that of an argument without an option, and stays: "EXPRESSION".
std::string option_of_setting(std::string_view id);

/// For main() of a program, before it calls anything else.
void name_settings_by(std::string (*name)(std::string_view id));

}  // namespace bihive
