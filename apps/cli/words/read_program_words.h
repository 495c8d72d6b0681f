// Converts CLI11's description of the command line to plain data.
#pragma once

#include <string>
#include <vector>

#include "words/program_words.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

ProgramWords read_program_words(const CLI::App& app);

/// The answer to `bihive describe WORDS...`, a command that --help does not list because only the build calls it:
///   commands              the names of all commands, one per line
///   man [COMMAND]         the manual page of the program or of a command
///   bash, zsh, fish       the completion for a shell
/// Fails with kBadUsage on anything else.
std::string describe(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace bihive::cli
