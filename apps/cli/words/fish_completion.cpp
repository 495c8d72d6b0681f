// Completion for fish: one line for each option.

#include "words/program_words.h"

namespace bihive::cli {
namespace {

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string words_of(const Candidates& candidates) {
  std::string text;
  for (const std::string& word : candidates.words) text += (text.empty() ? "" : " ") + word;
  if (candidates.folders) text += (text.empty() ? "" : " ") + std::string("(__fish_complete_directories)");
  return text;
}

std::string option_line(const std::string& condition, const OptionWords& option) {
  std::string text = "complete -c bihive -n " + fish_quoted(condition);
  for (const std::string& name : option.names)
    text += name.compare(0, 2, "--") == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.takes_value) {
    // -r: a value follows; -f: it is not a file; -F: it is.
    text += option.candidates.files ? " -r -F" : " -r -f";
    const std::string words = words_of(option.candidates);
    if (!words.empty()) text += " -a " + fish_quoted(words);
  }
  return text + " -d " + fish_quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completion(const ProgramWords& words) {
  std::string text =
      "# Completion of bihive for fish. Written by: bihive describe fish\n"
      "complete -c bihive -f\n";
  for (const OptionWords& option : words.program.options) text += option_line("__fish_use_subcommand", option);
  for (const CommandWords& command : words.commands)
    text +=
        "complete -c bihive -n '__fish_use_subcommand' -a " + command.name + " -d " + fish_quoted(command.help) + "\n";
  for (const CommandWords& command : words.commands) {
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionWords& option : command.options) {
      if (!option.place.empty()) {
        text += "complete -c bihive -n " + fish_quoted(condition) + (option.candidates.files ? " -F" : " -f");
        const std::string offered = words_of(option.candidates);
        if (!offered.empty()) text += " -a " + fish_quoted(offered) + " -d " + option.place;
        text += "\n";
      }
      if (!option.names.empty()) text += option_line(condition, option);
    }
  }
  return text;
}

}  // namespace bihive::cli
