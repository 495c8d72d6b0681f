// The short help of a command with many options, and advice on unknown options.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// Hides all except the common options of a command with many, and tells where the others are.
void shorten_help(CLI::App& command);

/// Advice on unknown arguments of a command: the nearest option, if one is near, then `otherwise`.
std::string advice_on(const CLI::App* command, const std::vector<std::string>& unknown, const std::string& otherwise);

}  // namespace bihive::cli
