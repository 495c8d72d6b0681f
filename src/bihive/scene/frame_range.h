// The frames of an animation: every STEP-th of a range of a trajectory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/base/result.h"

namespace bihive {

/// A range as the user states it. Frames count from 0. A negative `begin` or `end` counts from the trajectory's end.
struct FrameRange {
  std::int64_t begin = 0;
  std::optional<std::int64_t> end;  ///< the frame after the last one; unset: up to the end
  std::int64_t step = 1;            ///< at least 1
};

/// "A:B:STEP", "A:B", or one frame "A"; A and B may be empty in the first two. An error states what was expected.
Result<FrameRange> frame_range_from_text(const std::string& text);

/// A range of a trajectory whose length is known: first, first + step, ...; `count` of them, at least one.
struct FrameList {
  std::int64_t first = 0, step = 1, count = 1;

  std::int64_t frame(std::int64_t picture) const { return first + picture * step; }
  /// The position of a frame; nothing if it is not in the list.
  std::optional<std::int64_t> picture_of(std::int64_t frame) const;
};

/// An end after the trajectory's is clamped. Error: the range holds no frame of a trajectory of `frames` frames.
Result<FrameList> frames_in(const FrameRange& range, std::int64_t frames);

}  // namespace bihive
