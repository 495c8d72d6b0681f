// The frames of an input, each as the scene that load_input() makes of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive/io/frames.h"
#include "bihive/job/input.h"
#include "bihive/scene/style.h"

namespace bihive::cli {

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

 private:
  FrameSource() = default;

  InputOptions options_;
  bool asked_for_ = false;    // the style
  std::string name_, bytes_;  // of an input that is not read frame by frame
  std::shared_ptr<const Frames> frames_;
  std::int64_t count_ = 1;
  std::vector<std::string> files_;
};

}  // namespace bihive::cli
