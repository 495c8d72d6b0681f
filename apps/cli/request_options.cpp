#include "request_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bihive/base/setting_name.h"

namespace bihive::cli {
namespace {

// The request records which settings of a picture were given.
void note(PictureRequest& request, const std::string& id, const std::string& value) {
  request.given.push_back({id, value});
}
template <class Request>
void note(Request&, const std::string&, const std::string&) {}

// Those among the others that the command has.
void exclude_others(CLI::App& app, const std::string& id, const std::vector<std::string>& others) {
  CLI::Option* const option = app.get_option_no_throw(option_of_setting(id));
  for (const std::string& excluded : others)
    if (CLI::Option* const other = app.get_option_no_throw(option_of_setting(excluded)); option && other)
      option->excludes(other);
}

}  // namespace

template <class Request>
void add_option_of(CLI::App& app, const RequestOption<Request>& row, Request& request, const std::string& other_names) {
  const std::string name = option_of_setting(row.id);
  const auto take = [&row, &request, name](const std::string& text) {
    if (const Status status = row.take(request, text); !status)
      throw CLI::ValidationError(name, row.repeatable ? status.error().to_string() : status.error().message);
    note(request, row.id, text);
  };
  const std::string help =
      row.help.find('\n') == std::string::npos && row.theme == OptionTheme::reading ? in_lines(row.help) : row.help;
  CLI::Option* const option =
      row.value_name.empty()
          ? app.add_flag_function(
                name,
                [take](std::int64_t times) {
                  if (times > 0) take("");
                },
                help)
          : app.add_option_function<std::string>(other_names + name, take, help)->type_name(row.value_name);
  // Repeatable options are applied in the order of the command line.
  if (row.repeatable) option->trigger_on_parse();
  exclude_others(app, row.id, row.excludes);
}

template void add_option_of(CLI::App&, const RequestOption<InputOptions>&, InputOptions&, const std::string&);
template void add_option_of(CLI::App&, const RequestOption<TreeParameters>&, TreeParameters&, const std::string&);
template void add_option_of(CLI::App&, const RequestOption<PictureRequest>&, PictureRequest&, const std::string&);

void add_picture_options(CLI::App& app, OptionTheme theme, PictureRequest& request, bool of_window,
                         const std::vector<std::string_view>& without) {
  for (const RequestOption<PictureRequest>& row : picture_options())
    if (row.theme == theme && (row.in_window || !of_window) &&
        std::find(without.begin(), without.end(), row.id) == without.end())
      add_option_of(app, row, request);
  // A row may exclude one that comes after it.
  for (const RequestOption<PictureRequest>& row : picture_options())
    if (row.theme == theme) exclude_others(app, row.id, row.excludes);
}

void add_input_option(CLI::App& app, std::string_view id, InputOptions& input, const std::string& other_names) {
  for (const RequestOption<InputOptions>& row : input_options())
    if (row.id == id) add_option_of(app, row, input, other_names);
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
