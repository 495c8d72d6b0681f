// The command line. Only this file knows its words, and it alone spends seconds on compiling CLI11.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "commands/commands.h"

namespace bihive::cli {

/// The request of a command line: a sub-command with its options, or a text to print with an exit code.
struct HelpText {
  std::string text;
  bool asked_for;  ///< true: exit code 0, stdout; false: a sub-command is missing, exit code 2, stderr
};
using Request =
    std::variant<HelpText, RenderOptions, FilmOptions, ViewOptions, StatsOptions, TraceOptions, SceneOptions,
                 InfoOptions, SelectOptions, ConvertOptions, StylesOptions, ThesisOptions, WebOptions>;

/// Fails with kBadUsage on any word that is unknown, missing, repeated or out of range.
Request parse_command_line(int argc, const char* const* argv);

}  // namespace bihive::cli
