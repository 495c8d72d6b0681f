// The options of a command line as they were given, for a film that keeps them for its pictures.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
class Option;
}  // namespace CLI

namespace bihive::cli {

/// An option as it stands on the command line, with its value: one word or two.
struct GivenOption {
  const CLI::Option* option = nullptr;
  std::string name, value;
  std::vector<std::string> words;
};

/// The options among these words of a command. A word that is neither an option nor its value has no option.
std::vector<GivenOption> given_options(const CLI::App& command, const std::vector<std::string>& words);

/// Whether an option of `bihive film` belongs to each picture: all do but those that decide how the film is made.
bool is_of_picture(const GivenOption& given);

/// The words of a picture among those of `bihive film`.
std::vector<std::string> picture_words(const CLI::App& command, int argc, const char* const* argv);

/// Whether the value is a path, where the option takes one.
bool names_file(const GivenOption& given);

}  // namespace bihive::cli
