// The options that the tables of settings describe (job/picture_options.h), as CLI11 takes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bihive/job/picture_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace bihive::cli {

/// Adds the option of a row, whose values go to `request`. `other_names`: precede its own, each with a comma.
template <class Request>
void add_option_of(CLI::App& app, const RequestOption<Request>& row, Request& request,
                   const std::string& other_names = "");

/// The options of a picture under one heading. `without`: ids of some that the command does not have.
void add_picture_options(CLI::App& app, OptionTheme theme, PictureRequest& request, bool of_window,
                         const std::vector<std::string_view>& without = {});

/// The setting of an input with that id.
void add_input_option(CLI::App& app, std::string_view id, InputOptions& input, const std::string& other_names = "");

/// Wraps a text of --help at 84 characters.
std::string in_lines(std::string text);

}  // namespace bihive::cli
