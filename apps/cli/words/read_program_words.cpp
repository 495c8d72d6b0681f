#include "words/read_program_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "bihive/base/parse_number.h"
#include "bihive/base/version.h"
#include "bihive/io/reading_settings.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_options.h"
#include "bihive/job/report_text.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/colour_maps.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/style.h"
#include "bihive/viewer/viewer_json.h"
#include "commands/commands.h"

namespace bihive::cli {
namespace {

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// "N|auto" offers auto: a keyword in lower case means itself, one in upper case for a kind of value.
bool stands_for_itself(std::string_view word) {
  constexpr const char* kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789_-.";
  return !word.empty() && word.find_first_not_of(kAllowed) == std::string::npos;
}

Candidates candidates_of_type(const std::string& type) {
  Candidates found;
  for (const std::string_view part : parts_of(type, '|')) {
    if (stands_for_itself(part)) found.words.emplace_back(part);
    if (part == "FILE") found.files = true;
    if (part == "DIR") found.folders = true;
    if (part == "PRESET")
      for (const auto& [name, rig] : light_presets()) found.words.push_back(name);
    if (part == "NAME") found.words.insert(found.words.end(), style_names().begin(), style_names().end());
  }
  return found;
}

Candidates candidates_of_place(const std::string& place, const std::string& command) {
  Candidates found;
  if (place == "EXPERIMENT") {
    found.words = thesis_experiments();
  } else if (place == "INPUT" || place == "NAME") {
    for (const BuiltInScene& one : kBuiltInScenes)
      if (place == "INPUT" || one.kind != BuiltInKind::file) found.words.emplace_back(one.name);
  }
  found.files = (place == "INPUT" || place == "TRAJECTORY" || place == "FIGURE") && command != "scene";
  return found;
}

OptionWords read_option(const CLI::Option& option, const std::string& command) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (option.get_positional()) words.place = option.get_name(/*positional=*/true);
  words.type = option.get_items_expected_max() > 0 ? option.get_type_name() : "";
  words.help = in_one_line(option.get_description());
  words.required = option.get_required();
  words.takes_value = option.get_items_expected_max() > 0;
  words.repeatable = option.get_expected_max() > 1 || option.get_trigger_on_parse();
  words.candidates = words.place.empty() ? candidates_of_type(words.type) : candidates_of_place(words.place, command);
  return words;
}

// Lines of the footer below "Examples:".
std::vector<std::string> read_examples(const std::string& footer) {
  std::vector<std::string> examples;
  for (const std::string_view line : parts_of(footer, '\n'))
    if (line.starts_with("  ")) examples.emplace_back(line.substr(2));
  return examples;
}

CommandWords read_command(const CLI::App& app) {
  CommandWords words{app.get_name(), in_one_line(app.get_description()), {}, read_examples(app.get_footer())};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) words.options.push_back(read_option(*option, words.name));
  return words;
}

// A line for each option: its command, its name, its value ("-": none), and "files" if that may be one.
std::string list_of_options(const ProgramWords& program) {
  std::string text;
  for (const CommandWords& command : program.commands)
    for (const OptionWords& option : command.options)
      text += command.name + " " + (option.names.empty() ? option.place : option.names.back()) + " " +
              (!option.takes_value   ? "-"
               : option.type.empty() ? option.place
                                     : option.type) +
              (option.candidates.files ? " files\n" : "\n");
  return text;
}

// The options of a command as JSON: {"id":"frame_rate","value":"N","help":"..."}; "value" is empty for a switch.
std::string options_to_json(const CommandWords& command) {
  nlohmann::ordered_json options = nlohmann::ordered_json::array();
  for (const OptionWords& option : command.options) {
    if (option.names.empty()) continue;
    std::string id = option.names.back().substr(2);
    std::replace(id.begin(), id.end(), '-', '_');
    options.push_back({{"id", id}, {"value", option.takes_value ? option.type : ""}, {"help", option.help}});
  }
  return as_text(options, -1);
}

}  // namespace

ProgramWords read_program_words(const CLI::App& app) {
  ProgramWords words{read_command(app), {}, std::string(version())};
  for (const CLI::App* command : app.get_subcommands(/*filter=*/nullptr))
    words.commands.push_back(read_command(*command));
  return words;
}

std::string describe(const CLI::App& app, const std::vector<std::string>& words) {
  const ProgramWords program = read_program_words(app);
  const std::string what = words.empty() ? "" : words.front();
  std::string text;
  if (what == "commands" && words.size() == 1) {
    for (const CommandWords& command : program.commands) text += command.name + "\n";
  } else if (what == "options" && words.size() == 1) {
    text = list_of_options(program);
  } else if (what == "options" && words.size() == 2) {
    for (const CommandWords& command : program.commands)
      if (command.name == words[1]) text = options_to_json(command) + "\n";
  } else if (what == "settings" && words.size() == 1) {
    text = parameters_to_json() + "\n";
  } else if (what == "reading" && words.size() == 1) {
    text = reading_settings_to_json() + "\n";
  } else if (what == "picture" && words.size() == 1) {
    text = picture_options_to_json() + "\n";
  } else if (what == "colour-maps" && words.size() == 1) {
    text = as_text(colour_map_names(), -1) + "\n";
  } else if (what == "man" && words.size() <= 2) {
    text = man_page(program, words.size() == 2 ? words[1] : "");
  } else if (words.size() == 1) {
    if (what == "bash") text = bash_completion(program);
    if (what == "zsh") text = zsh_completion(program);
    if (what == "fish") text = fish_completion(program);
  }
  if (text.empty())
    fail_usage(
        "bihive describe knows: commands, options [COMMAND], settings, reading, picture, colour-maps, man [COMMAND], "
        "bash, zsh, fish",
        "see docs/packages.md");
  return text;
}

}  // namespace bihive::cli
