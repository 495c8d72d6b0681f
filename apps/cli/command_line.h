// The command line: the one place that knows its words. (And the one file that takes CLI11 seconds to compile.)
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "commands/commands.h"

namespace bihive::cli {

/// What the command line asks for: a sub-command with its options, or a text to print with an exit code.
struct HelpText {
  std::string text;
  bool asked_for;  ///< true: exit code 0, stdout; false: a sub-command is missing, exit code 2, stderr
};
using Request = std::variant<HelpText, RenderOptions, ViewOptions, StatsOptions, TraceOptions, SceneOptions,
                             InfoOptions, ThesisOptions, WebOptions>;

/// Fails with kBadUsage on anything that is unknown, missing, repeated or out of range.
Request parse_command_line(int argc, const char* const* argv);

}  // namespace bihive::cli
