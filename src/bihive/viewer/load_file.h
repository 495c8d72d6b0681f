// Loads a file into the viewer, and opens its other frames for a player.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/frames.h"
#include "bihive/io/read_spheres.h"
#include "bihive/viewer/viewer.h"

namespace bihive {

struct LoadedFile {
  SceneFacts facts;
  std::shared_ptr<const Frames> frames;  ///< null: there is one frame, or the file cannot be read again
};

/// Loads the frame `options.frame` of a file of any format that bihive reads, or of its trajectory. A file of up to
/// `whole_bytes` is read at once; of a larger one, if it is not a scene file, and of a trajectory, only the frame and
/// what open_frames() needs are in memory. Errors: as Viewer::load() and open_frames().
Result<LoadedFile> load_file(Viewer& viewer, const std::string& path, const ReadOptions& options,
                             std::int64_t whole_bytes = 64'000'000);

}  // namespace bihive
