// From a file of spheres on the disk to a scene.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"
#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"

namespace bihive {

/// As load_scene() of the file's bytes, of which no more than is needed is in memory. For files that are no scene
/// files.
Result<LoadedScene> load_spheres(const std::string& path, const ReadOptions& options = {},
                                 const Style* style = nullptr);

}  // namespace bihive
