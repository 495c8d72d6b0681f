// The short help of a command with many options, and advice on options that it does not have.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// Hides all but the common options of a command with many, and says where the others are.
void shorten_help(CLI::App& command);

/// Advice on arguments that a command does not take: the nearest option, if one is near, then `otherwise`.
std::string advice_on(const CLI::App* command, const std::vector<std::string>& unknown, const std::string& otherwise);

}  // namespace bihive::cli
