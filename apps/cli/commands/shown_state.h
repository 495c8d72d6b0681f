// The first state of window and page, from a command line or from a request in a scene file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "commands/commands.h"

namespace bihive::cli {

/// If the input is a scene file with a request, takes its input and its options (job/scene_request.h). Those that
/// window and page do not have are left out, with a warning that names them. `of_page`: those that the page lacks too.
void take_request_to_show(ViewOptions& options, bool of_page);

/// Whether the user has placed the camera: it is not the scene's own, nor one from which the whole set is seen.
bool places_camera(const ViewOptions& options);

/// Fails with kBadUsage on a style, element colours or options that window and page do not have.
void check_shown(const ViewOptions& options);

/// `settings` and `look` as in viewer/viewer_json.h. Reads the input to compute the camera if that depends on the
/// spheres: with selections, a turn, a zoom, `principal` or `best`; `with_side`: also with `--view-from SIDE`. The
/// camera fits windows of every size.
nlohmann::ordered_json settings_to_show(const ViewOptions& options, bool with_side);
nlohmann::ordered_json look_to_show(const ViewOptions& options);

}  // namespace bihive::cli
