// Prepares another frame of the shown file on any thread, while the viewer continues to draw the current one.
#pragma once

#include <memory>
#include <utility>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// A frame with its appearance and tree, for Viewer::show_frame().
class PreparedFrame;

/// A snapshot of the user's choices (Viewer::frame_maker()): every frame gets the same appearance, and the colour
/// ranges of the frame shown at that time. Immutable.
class FrameMaker {
 public:
  struct Choices;
  explicit FrameMaker(std::shared_ptr<const Choices> choices) : choices_(std::move(choices)) {}

  /// Any number of threads at a time. Errors: as Viewer::set_look() (a selection without its attribute, every sphere
  /// hidden), or not enough memory.
  Result<std::shared_ptr<PreparedFrame>> make(SphereFile frame) const;

 private:
  std::shared_ptr<const Choices> choices_;
};

}  // namespace bihive
