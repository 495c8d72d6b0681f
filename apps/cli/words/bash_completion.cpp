// Completion for bash, without the package bash-completion's helpers.

#include "words/program_words.h"

namespace bihive::cli {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

// "render:--view" of a case statement, and its candidates.
std::string value_case(const std::string& command, const OptionWords& option) {
  std::vector<std::string> patterns;
  for (const std::string& name : option.names) patterns.push_back(command + ":" + name);
  return "    " + joined(patterns, "|") + ") words='" + joined(option.candidates.words, " ") + "'" +
         (option.candidates.files ? " files=1" : "") + (option.candidates.folders ? " folders=1" : "") + " ;;\n";
}

std::string command_case(const CommandWords& command) {
  std::vector<std::string> names;
  Candidates places;
  for (const OptionWords& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.place.empty()) continue;
    places.files = places.files || option.candidates.files;
    places.words.insert(places.words.end(), option.candidates.words.begin(), option.candidates.words.end());
  }
  return "      " + command.name + ") options='" + joined(names, " ") + "' words='" + joined(places.words, " ") + "'" +
         (places.files ? " files=1" : "") + " ;;\n";
}

// Before a value: "--view tree", "--view=tree"; bash cuts the line at "=".
constexpr const char* kBegin = R"(# Completion of bihive for bash. Written by: bihive describe bash
_bihive() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
  local words='' options='' files='' folders=''
  COMPREPLY=()
  if [ "$current" = = ]; then
    current=
  elif [ "$before" = = ] && [ "$COMP_CWORD" -ge 3 ]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

constexpr const char* kBetween = R"(  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
    return
  fi
  # The value of the option before, if it takes one.
  local value=1
  case $command:$before in
)";

constexpr const char* kAfterValues = R"(    *) value= ;;
  esac
  if [ -z "$value" ]; then
    case $command in
)";

constexpr const char* kEnd = R"(    esac
    case $current in
      -*) words=$options files= ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  local IFS=$'\n'
  if [ -n "$files" ]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY+=($(compgen -f -- "$current"))
  elif [ -n "$folders" ]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY+=($(compgen -d -- "$current"))
  fi
}
complete -F _bihive bihive
)";

}  // namespace

std::string bash_completion(const ProgramWords& words) {
  std::vector<std::string> commands;
  for (const CommandWords& command : words.commands) commands.push_back(command.name);
  for (const OptionWords& option : words.program.options)
    commands.insert(commands.end(), option.names.begin(), option.names.end());
  std::string text = std::string(kBegin) + "  local commands='" + joined(commands, " ") + "'\n" + kBetween;
  for (const CommandWords& command : words.commands)
    for (const OptionWords& option : command.options)
      if (option.takes_value && !option.names.empty()) text += value_case(command.name, option);
  text += kAfterValues;
  for (const CommandWords& command : words.commands) text += command_case(command);
  return text + kEnd;
}

}  // namespace bihive::cli
