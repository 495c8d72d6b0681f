// The options of the command line that the table of parameters describes (bihive/settings/parameter.h).
#pragma once

#include "bihive/settings/overrides.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// Adds an option for each parameter of the group that has one of its own; values that the user gives go to `chosen`. A
/// window has not all of them.
void add_parameters(CLI::App& app, ParameterGroup group, Overrides& chosen, bool of_window);

}  // namespace bihive::cli
