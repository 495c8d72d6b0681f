#include "bihive/io/frames.h"

#include <utility>

#include "bihive/io/frames/sphere_frames.h"
#include "bihive/io/without_throwing.h"

namespace bihive {

Result<std::shared_ptr<const Frames>> open_frames(const std::string& path, const ReadOptions& options,
                                                  const FramesOptions& of_frames) {
  return without_throwing(path, [&]() -> Result<std::shared_ptr<const Frames>> {
    auto frames = std::make_shared<SphereFrames>(path, options, of_frames);
    if (const Result<SphereFile> first = frames->open(0); !first) return first.error();
    return std::shared_ptr<const Frames>(std::move(frames));
  });
}

}  // namespace bihive
