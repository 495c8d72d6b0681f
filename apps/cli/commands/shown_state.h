// The first state of window and page, from a command line or from a request in a scene file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bihive/job/values.h"
#include "commands/commands.h"

namespace bihive::cli {

/// If the input is a scene file with a request, takes its input and its options (job/scene_request.h). Those that
/// window and page do not have are left out, with a warning that names them.
void take_request_to_show(ViewOptions& options);

/// Fails with kBadUsage on a style, element colours or options that window and page do not have.
void check_shown(const ViewOptions& options);

/// `settings` and `look` as in viewer/viewer_json.h. A camera that follows from selections, a turn or the like is that
/// of the picture of this size, for which the input is read; `with_side`: that of a side from which the whole set is
/// seen too.
nlohmann::ordered_json settings_to_show(const ViewOptions& options, PictureSize size, bool with_side);
nlohmann::ordered_json look_to_show(const ViewOptions& options);

}  // namespace bihive::cli
