// The command line as data. Manual pages and completions are generated from it, so that they match --help.
#pragma once

#include <string>
#include <vector>

namespace bihive::cli {

/// The candidates for a value, as far as a shell can offer them.
struct Candidates {
  std::vector<std::string> words;  ///< "shaded", "tree"
  bool files = false;
  bool folders = false;
};

struct OptionWords {
  std::vector<std::string> names;  ///< "-o", "--output"; none: a positional argument
  std::string place;               ///< "INPUT", if it is a positional argument; else empty
  std::string type;                ///< "WxH"; empty: a switch, or an argument that its name describes
  std::string help;                ///< in one line
  bool required = false;
  bool takes_value = false;
  bool repeatable = false;
  Candidates candidates;
};

struct CommandWords {
  std::string name;  ///< "render"; that of the program itself: "bihive"
  std::string help;
  std::vector<OptionWords> options;  ///< in the order of --help
  std::vector<std::string> examples;
};

struct ProgramWords {
  CommandWords program;
  std::vector<CommandWords> commands;
  std::string version;  ///< "0.2.0"
};

/// The manual page of the program (`command` empty) or of a command, for man(1). An unknown command has none: "".
std::string man_page(const ProgramWords& words, const std::string& command);

std::string bash_completion(const ProgramWords& words);
std::string zsh_completion(const ProgramWords& words);
std::string fish_completion(const ProgramWords& words);

}  // namespace bihive::cli
