// The table of all options of a picture. Rows of parameters (settings/parameter.h) and of reading
// (io/reading_settings.h) are among them; those of camera, appearance of spheres, lights and engine are only here.
//
// To add one: a row in picture_options.cpp, a member of PictureRequest, and the code that uses it.
#pragma once

#include <string>
#include <vector>

#include "bihive/job/picture_request.h"
#include "bihive/job/request_option.h"

namespace bihive {

/// The most threads that may be asked for.
inline constexpr std::int64_t kMostThreads = 4096;

/// In the order of help.
const std::vector<RequestOption<PictureRequest>>& picture_options();
/// Those of the input alone: `count`, `seed` and all of reading.
const std::vector<RequestOption<InputOptions>>& input_options();
/// `max_prims` and `max_depth`.
const std::vector<RequestOption<TreeParameters>>& tree_options();

/// The table, for code generated from it in other languages.
std::string picture_options_to_json();

/// The samples per pixel, at most `most`.
RequestOption<PictureRequest> samples_option(std::int64_t most);

/// The row of an id; null: none.
const RequestOption<PictureRequest>* picture_option(std::string_view id);

/// Whether the value of this setting is a path.
bool names_file(std::string_view id, const std::string& value);
/// The files that the settings of a request name, besides its input: settings and paths.
std::vector<GivenSetting> files_named_by(const PictureRequest& request);

/// Sets one setting by its id. Fails with kBadUsage on an unknown id, a value out of range, an option given twice, or
/// one that another excludes.
void take_setting(PictureRequest& request, const std::string& id, const std::string& value);
/// The same for the arguments of a command line, "--light-points=4", "--light-points" "4" or "--ao", in their order.
/// The argument after "--" is the input.
void take_words(PictureRequest& request, const std::vector<std::string>& words);

}  // namespace bihive
