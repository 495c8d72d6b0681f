// Completion for zsh: a specification for _arguments for each command.

#include "words/program_words.h"

namespace bihive::cli {
namespace {

// For a description in single quotes, where brackets and colons have a meaning.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string action_of(const Candidates& candidates) {
  std::string words;
  for (const std::string& word : candidates.words) words += (words.empty() ? "" : " ") + word;
  const std::string paths = candidates.files ? "_files" : candidates.folders ? "_files -/" : "";
  if (words.empty()) return paths.empty() ? " " : paths;
  if (paths.empty()) return "(" + words + ")";
  return "{ compadd -- " + words + "; " + paths + " }";
}

std::string specifications(const OptionWords& option) {
  std::string text;
  const std::string repeated = option.repeatable ? "*" : "";
  for (const std::string& name : option.names) {
    text += " \\\n        '" + repeated + name + "[" + zsh_text(option.help) + "]";
    if (option.takes_value)
      text += ":" + zsh_text(option.type.empty() ? option.place : option.type) + ":" + action_of(option.candidates);
    text += "'";
  }
  if (option.place.empty()) return text;
  return text + " \\\n        '" +
         (option.repeatable ? "*:"
          : option.required ? ":"
                            : "::") +
         option.place + ":" + action_of(option.candidates) + "'";
}

}  // namespace

std::string zsh_completion(const ProgramWords& words) {
  std::string text =
      "#compdef bihive\n"
      "# Completion of bihive for zsh. Written by: bihive describe zsh\n"
      "_bihive() {\n"
      "  local -a commands=(\n";
  for (const CommandWords& command : words.commands)
    text += "    '" + command.name + ":" + zsh_text(command.help) + "'\n";
  text +=
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    if [[ $PREFIX == -* ]]; then\n"
      "      _arguments";
  for (const OptionWords& option : words.program.options) text += specifications(option);
  text +=
      "\n    else\n"
      "      _describe command commands\n"
      "    fi\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const CommandWords& command : words.commands) {
    text += "    " + command.name + ")\n      _arguments -s";
    for (const OptionWords& option : command.options) text += specifications(option);
    text += "\n      ;;\n";
  }
  // Called by the completion system, or read by `source`.
  return text +
         "  esac\n"
         "}\n"
         "if [ \"$funcstack[1]\" = _bihive ]; then\n"
         "  _bihive \"$@\"\n"
         "else\n"
         "  compdef _bihive bihive\n"
         "fi\n";
}

}  // namespace bihive::cli
