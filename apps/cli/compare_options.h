// The options of bihive compare and bihive tune, beside those of their input.
#pragma once

#include "commands/commands.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// `options` must live as long as the command.
void add_compare_options(CLI::App& command, CompareOptions& options);
void add_tune_options(CLI::App& command, TuneCommandOptions& options);

}  // namespace bihive::cli
