#include "parameter_options.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/settings/parameter_text.h"

namespace bihive::cli {
namespace {

// "--light-points" of the parameter with that id, and "--no-..." where there is one.
void add_parameter(CLI::App& app, const Parameter& parameter, Overrides& chosen) {
  const std::string name = option_of(parameter), id(parameter.id);
  std::string help(parameter.help);
  if (!parameter.usual.empty()) help += " (" + std::string(parameter.usual) + ")";
  if (!parameter.implies.empty() && parameter_named(parameter.implies)->has_option)
    help += "; implies " + option_of(*parameter_named(parameter.implies));
  if (parameter.kind != ParameterKind::flag) {
    const std::string type(parameter.names.empty() ? parameter.value_name : parameter.names);
    const auto take = [&chosen, &parameter, name](const std::string& text) {
      Result<SettingValue> value = value_from_text(parameter, text);
      if (!value) throw CLI::ValidationError(name, value.error().message);
      chosen.set(parameter.id, std::move(*value));
    };
    app.add_option_function<std::string>(name, take, help)->type_name(type);
    return;
  }
  const auto set = [&chosen, id](bool on) { return [&chosen, id, on] { chosen.set(id, on); }; };
  CLI::Option* const on = app.add_flag_callback(name, set(true), help);
  if (!parameter.has_no_option) return;
  app.add_flag_callback("--no" + name.substr(1), set(false), "Switches " + name + " off")->excludes(on);
}

}  // namespace

void add_parameters(CLI::App& app, ParameterGroup group, Overrides& chosen, bool of_window) {
  for (const Parameter& parameter : picture_parameters())
    if (parameter.group == group && parameter.has_option && (parameter.in_window || !of_window))
      add_parameter(app, parameter, chosen);
  // An option that implies a switch excludes the one that turns it off.
  for (const Parameter& parameter : picture_parameters()) {
    const Parameter* const implied = parameter.implies.empty() ? nullptr : parameter_named(parameter.implies);
    if (parameter.group != group || implied == nullptr || !implied->has_no_option) continue;
    app.get_option("--no" + option_of(*implied).substr(1))->excludes(app.get_option(option_of(parameter)));
  }
}

void add_reading(CLI::App& app, std::string_view id, GivenReading& given, const std::string& other_names) {
  const ReadingSetting& row = *reading_setting(id);
  const std::string name = option_of_setting(id);
  const auto take = [&given, id, name](const std::string& text) {
    if (const Status status = given.take(id, text); !status) throw CLI::ValidationError(name, status.error().message);
  };
  CLI::Option* const option = row.value_name.empty()
                                  ? app.add_flag_callback(
                                        name, [take] { take(""); }, in_lines(row.help))
                                  : app.add_option_function<std::string>(other_names + name, take, in_lines(row.help))
                                        ->type_name(std::string(row.value_name));
  if (!row.excludes.empty()) option->excludes(app.get_option(option_of_setting(row.excludes)));
}

std::string in_lines(std::string text) {
  constexpr std::size_t kWidth = 84;
  for (std::size_t begin = 0; text.size() - begin > kWidth;) {
    const std::size_t blank = text.rfind(' ', begin + kWidth);
    text[blank] = '\n';
    begin = blank + 1;
  }
  return text;
}

}  // namespace bihive::cli
