// Requests in scene files: `bihive scene save` writes the input and all options of a picture, and every front end takes
// them again (scene/saved_request.h).
#pragma once

#include <functional>
#include <string>

#include "bihive/job/picture_request.h"

namespace bihive {

/// The scene file `path` of this request. Relative paths of files become relative to its folder; maps of colours from a
/// file become colours. Fails with kBadUsage if the input cannot be named: the standard input, or spheres in memory.
std::string scene_of_request(const PictureRequest& request, const std::string& path);

/// If the input is a scene file with such a request, takes its input and its options. Options of `request` replace them
/// as changes of a figure do (picture_record.h). Returns whether it is one. Fails with kBadUsage as take_setting(), and
/// on an unreadable file. `takes`: which of the file's options the command has, by their ids; others are left out.
bool take_saved_request(PictureRequest& request, const std::function<bool(const std::string& id)>& takes = {});

/// The same for a command that draws nothing: it takes the input, how to read it and, unless null, the parameters of
/// its tree.
void take_saved_input(InputOptions& input, TreeParameters* tree = nullptr);

}  // namespace bihive
