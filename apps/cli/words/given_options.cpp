#include "words/given_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bihive/base/setting_name.h"
#include "bihive/job/picture_options.h"

namespace bihive::cli {

std::vector<GivenOption> given_options(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<GivenOption> given;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    GivenOption& one = given.emplace_back();
    one.words = {word};
    if (word.size() < 2 || word.front() != '-') continue;
    one.name = word[1] == '-' ? word.substr(0, word.find('=')) : word.substr(0, 2);
    one.option = command.get_option_no_throw(one.name);
    if (one.option == nullptr) continue;
    if (one.name.size() < word.size()) one.value = word.substr(one.name.size() + (word[1] == '-' ? 1 : 0));
    if (one.option->get_items_expected_max() == 0 || one.name.size() < word.size() || i + 1 == words.size()) continue;
    one.value = words[++i];
    one.words.push_back(one.value);
  }
  return given;
}

bool is_of_picture(const GivenOption& given) {
  static const std::vector<std::string> of_film{
      "-o",           "--output",      "--frames",       "--pictures", "--fps",
      "--turntable",  "--camera-keys", "--colour-range", "--codec",    "--shard",
      "--join",       "--hold-first",  "--hold-last",    "--reverse",  "--ping-pong",
      "--json",       "--threads",     "--trajectory",   "-h",         "--help",
      "--help-all",   "--turn-axis",   "--follow",       "--align",    "--fit-frames",
      "--no-metadata"};
  return given.option != nullptr && std::find(of_film.begin(), of_film.end(), given.name) == of_film.end();
}

std::vector<std::string> picture_words(const CLI::App& command, int argc, const char* const* argv) {
  std::vector<std::string> words;
  for (const GivenOption& given : given_options(command, {argv + 2, argv + argc}))
    if (is_of_picture(given)) words.insert(words.end(), given.words.begin(), given.words.end());
  return words;
}

std::vector<std::string> picture_words(const std::vector<GivenSetting>& settings) {
  std::vector<std::string> words;
  for (const GivenSetting& one : settings) {
    if (one.id == "threads" || one.id == "trajectory") continue;
    const bool is_switch = picture_option(one.id)->value_name.empty();
    words.push_back(option_of_setting(one.id) + (is_switch ? "" : "=" + one.value));
  }
  return words;
}

bool names_file(const GivenOption& given) {
  if (const std::string id = setting_of_option(given.name); picture_option(id) != nullptr)
    return bihive::names_file(id, given.value);
  return given.option->get_type_name().find("FILE") != std::string::npos;
}

}  // namespace bihive::cli
