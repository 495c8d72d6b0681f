// Makes a scene of a file of spheres on the disk.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"

namespace bihive {

/// As load_scene() of the file's bytes, without holding more of them in memory than needed. For files that are not
/// scene files.
Result<LoadedScene> load_spheres(const std::string& path, const ReadOptions& options = {},
                                 const Style* style = nullptr);

}  // namespace bihive
