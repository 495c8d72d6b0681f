// A file of spheres with any number of frames, opened once.
//
// Opening finds where each frame begins; a frame is read when it is asked for, so that memory holds the frames in use
// and never the file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Any number of threads may read at a time.
class Frames {
 public:
  virtual ~Frames() = default;

  virtual std::int64_t count() const = 0;
  /// Faults of the opening that do not matter for the frames, one line each.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// The same, bit for bit, as read_spheres() of the same file and options with this frame, 0 to count() - 1. Errors:
  /// as there; no such frame; the file changed meanwhile.
  virtual Result<SphereFile> read(std::int64_t frame) const = 0;
};

/// The frame that ReadOptions::frame names among `count` frames.
inline std::int64_t numbered_frame(std::int64_t frame, std::int64_t count) {
  return frame < 0 ? frame + count : frame;
}

struct FramesOptions {
  /// Text on the disk: the places of its frames are kept in FILE.bihive-index, and taken from there if this user made
  /// it for this file as it is now (docs/formats.md). An index of no use is replaced, with a warning; one that cannot
  /// be written, or that another user may have written, is a warning too, and so is another file in its place.
  bool keep_index = false;
  /// A frame without spheres is an empty set, not an error.
  bool empty_frames = false;
};

/// Opens the file of any format that read_spheres() reads, or its trajectory (`options.trajectory`). `options.frame` is
/// not looked at. Errors: as read_spheres() with frame 0.
Result<std::shared_ptr<const Frames>> open_frames(const std::string& path, const ReadOptions& options,
                                                  const FramesOptions& frames = {});

}  // namespace bihive
