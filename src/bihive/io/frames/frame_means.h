// Mean coordinates over neighbouring frames, in place of those of one frame (ReadOptions::smooth).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Keeps the coordinates of frames that were read last. Any number of threads may use it at a time.
class FrameMeans {
 public:
  using ReadFrame = std::function<Result<RawSpheres>(std::int64_t frame)>;

  /// Replaces the coordinates of frame `frame` by their means over `options.smooth` frames, it in the middle. Near the
  /// first and the last frame there are fewer, as many before as after, so that nothing runs ahead; those two stay as
  /// they are. From frame to frame a sphere moves by the shortest way to an image. `read`: other frames of the file,
  /// with coordinates, cell, elements and the column `id`. Errors: the frames have different spheres; those of `read`.
  Status smooth(std::int64_t frame, RawSpheres& spheres, const ReadOptions& options, const std::string& file,
                const ReadFrame& read);

 private:
  using Kept = std::shared_ptr<const RawSpheres>;
  Result<Kept> at(std::int64_t frame, std::int64_t middle, std::int64_t width, const ReadFrame& read);

  std::mutex lock_;
  std::map<std::int64_t, Kept> kept_;
};

}  // namespace bihive
