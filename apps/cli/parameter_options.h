// The options that the tables of settings describe: of pictures (settings/parameter.h) and of reading
// (io/reading_settings.h).
#pragma once

#include <string>
#include <string_view>

#include "bihive/io/reading_settings.h"
#include "bihive/settings/overrides.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// Adds an option for each parameter of the group that has one of its own; values that the user gives go to `chosen`. A
/// window has not all of them.
void add_parameters(CLI::App& app, ParameterGroup group, Overrides& chosen, bool of_window);

/// Adds the option of a setting of reading. `other_names`: before its own, each with a comma.
void add_reading(CLI::App& app, std::string_view id, GivenReading& given, const std::string& other_names = "");

/// A text of --help in lines of at most 84 characters.
std::string in_lines(std::string text);

}  // namespace bihive::cli
