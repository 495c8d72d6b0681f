// The options of a command line as given, for a film that keeps them for its pictures.
#pragma once

#include <string>
#include <vector>

#include "bihive/job/picture_request.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
class Option;
}  // namespace CLI

namespace bihive::cli {

/// An option on the command line, with its value: one argument or two.
struct GivenOption {
  const CLI::Option* option = nullptr;
  std::string name, value;
  std::vector<std::string> words;
};

/// The options among these arguments of a command. An argument that is neither an option nor its value has no option.
std::vector<GivenOption> given_options(const CLI::App& command, const std::vector<std::string>& words);

/// Whether an option of `bihive film` belongs to each picture: all except those about making the film.
bool is_of_picture(const GivenOption& given);

/// The arguments of a picture among those of `bihive film`.
std::vector<std::string> picture_words(const CLI::App& command, int argc, const char* const* argv);

/// The same of a picture's settings.
std::vector<std::string> picture_words(const std::vector<GivenSetting>& settings);

/// Whether the value of this option is a path.
bool names_file(const GivenOption& given);

}  // namespace bihive::cli
