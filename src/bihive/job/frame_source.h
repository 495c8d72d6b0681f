// The frames of an input, each as the scene that load_input() makes of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/job/input.h"
#include "bihive/scene/style.h"

namespace bihive {

class FrameSource {
 public:
  /// A file of spheres stays on the disk; of other inputs the bytes are kept. Fails as load_input() does.
  static FrameSource open(const InputOptions& options, const Style& style, bool asked_for);

  /// 1 for generated scenes.
  std::int64_t count() const { return count_; }

  /// The files that the input names: of a scene, its spheres and its trajectory.
  const std::vector<std::string>& files() const { return files_; }

  /// As load_input() with this frame, LooksOfFile::keep and `style`, without printing warnings; a frame of a file may
  /// have no spheres. Any number of threads may load at a time. Fails with kBadInput.
  Input load(std::int64_t frame, const Style& style) const;

  /// The spheres of the `count` frames before this one, the oldest first; fewer where the file begins. They are kept
  /// for the next call, whose frame is often the next. Threads as load(). Fails with kBadInput.
  std::vector<std::shared_ptr<const SphereSet>> before(std::int64_t frame, std::int64_t count) const;

 private:
  FrameSource() = default;

  // Spheres of frames that were asked for.
  struct Kept {
    std::mutex mutex;
    std::map<std::int64_t, std::shared_ptr<const SphereSet>> spheres;
  };

  InputOptions options_;
  bool asked_for_ = false;    // the style
  std::string name_, bytes_;  // of an input that is not read frame by frame
  std::shared_ptr<const Frames> frames_;
  std::int64_t count_ = 1;
  std::vector<std::string> files_;
  std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
};

}  // namespace bihive
