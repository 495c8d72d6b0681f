// A setting that a user gives as text: one row, from which the options of the command line with their help, the
// keywords of Python and the names of C are generated.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/settings/parameter.h"

namespace bihive {

/// The heading under which help shows an option.
enum class OptionTheme { picture, style, camera, engine, reading, spheres, labels };

/// `Request` takes the value.
template <class Request>
struct RequestOption {
  std::string id = "";          ///< "view_from"
  std::string value_name = "";  ///< name of its value in help; empty: a switch
  std::string help = "";        ///< a sentence without a full stop; may have several lines
  OptionTheme theme = OptionTheme::picture;
  ParameterRanks ranks = ParameterRanks::refused;
  bool in_window = true;
  bool in_page = true;                     ///< with in_window
  bool repeatable = false;                 ///< kept in order with other repeatable options
  std::vector<std::string> excludes = {};  ///< ids of others
  /// The text of a switch is empty. Error: the expected and the found text.
  std::function<Status(Request&, const std::string&)> take = {};
};

}  // namespace bihive
