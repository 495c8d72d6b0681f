#include "words/short_help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <set>

#include "bihive/base/near_name.h"
#include "words/foreign_options.h"

namespace bihive::cli {
namespace {

// The options that the short help of a long command shows.
constexpr std::array kCommonOptions{
    "--help",    "--help-all",   "--output",     "--frames", "--fps",       "--turntable", "--size",
    "--samples", "--style",      "--background", "--light",  "--ao",        "--view-from", "--turn",
    "--zoom",    "--projection", "--select",     "--colour", "--colour-by", "--hide",      "--opacity",
    "--radius",  "--frame",      "--legend",     "--title",  "--port",      "--bind",      "--no-browser",
    "--html",    "--structures", "--rays",       "--sweep",  "--pixel",     "--boxes"};
// A command with more options than this has a short help and a long one.
constexpr std::size_t kLongHelp = 30;

}  // namespace

void shorten_help(CLI::App& command) {
  std::vector<CLI::Option*> named;
  for (CLI::Option* option : command.get_options())
    if (option->nonpositional()) named.push_back(option);
  if (named.size() <= kLongHelp) return;
  for (CLI::Option* option : named) {
    const auto is_common = [option](const char* name) { return option->check_name(name); };
    const bool has_place = !option->get_name(true).empty() && option->get_name(true).front() != '-';
    if (!has_place && std::none_of(kCommonOptions.begin(), kCommonOptions.end(), is_common)) option->group("");
    // Exclusions are listed in the long help.
    const std::set<CLI::Option*> excluded = option->get_excludes();
    for (CLI::Option* other : excluded) option->remove_excludes(other);
  }
  command.footer("bihive " + command.get_name() + " --help-all shows all " + std::to_string(named.size()) +
                 " options.\n\n" + command.get_footer());
}

std::string advice_on(const CLI::App* command, const std::vector<std::string>& unknown, const std::string& otherwise) {
  if (command == nullptr) return otherwise;
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& word : unknown) {
    const std::string name = word.substr(0, word.find('='));
    for (const ForeignOption& foreign : kForeignOptions) {
      if (foreign.names.find(" " + name + " ") == std::string_view::npos) continue;
      if (foreign.option.empty()) return std::string(kSpheresAlone);
      if (std::find(names.begin(), names.end(), foreign.option) != names.end())
        return "did you mean " + std::string(foreign.usage) + "? " + otherwise;
    }
    const std::string near = name.rfind("--", 0) == 0 ? near_name(name, names) : "";
    if (!near.empty()) return "did you mean " + near + "? " + otherwise;
  }
  return otherwise;
}

}  // namespace bihive::cli
