// The command line. Only its source knows the options, and it alone spends seconds on compiling CLI11.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "commands/commands.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// The request of a command line: a sub-command with its options, or a text to print with an exit code.
struct HelpText {
  std::string text;
  bool asked_for;  ///< true: exit code 0, stdout; false: a sub-command is missing, exit code 2, stderr
};
using Request =
    std::variant<HelpText, RenderOptions, AgainOptions, VerifyOptions, FilmOptions, ViewOptions, StatsOptions,
                 CompareOptions, TuneCommandOptions, TraceOptions, SceneOptions, SceneSaveOptions, InfoOptions,
                 SelectOptions, MeasureCommandOptions, ConvertOptions, StylesOptions, ThesisOptions, WebOptions>;

/// The text of `bihive describe WORDS...`, from the description of the command line (words/read_program_words.h).
using Describe = std::function<std::string(const CLI::App& app, const std::vector<std::string>& words)>;

/// Fails with kBadUsage on any argument that is unknown, missing, repeated or out of range. Without `describe` there is
/// no such command: only the program knows the names of all experiments.
Request parse_command_line(int argc, const char* const* argv, const Describe& describe = {});

}  // namespace bihive::cli
