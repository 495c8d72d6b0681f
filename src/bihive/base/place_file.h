// Replaces an output by a file that another program has written, or that was made over many runs.
#pragma once

#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// The path that an output resolves to, with its links followed as write_file() follows them. An Error if it cannot be
/// written, or is a pipe, a device or a stream.
Result<std::string> path_behind_links(const std::string& output);

/// The finished file `name` in the open folder `folder` is flushed to the disk and replaces `output`, by the rules of
/// write_file(): links are followed, and owner and permissions of a file that is replaced stay. A new file keeps its
/// own, unless `like` names another output: then it gets the owner and the permissions of the file that is there. Both
/// folders are on one file system. A mount point is written in place. After an Error the finished file is still there.
Status place_file(int folder, const std::string& name, const std::string& output, const std::string& like = "");

}  // namespace bihive
