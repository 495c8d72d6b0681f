// Another frame of the file on show, made ready on any thread while the viewer goes on drawing the one before.
#pragma once

#include <memory>
#include <utility>

#include "bihive/base/result.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// A frame in its look, with its tree: for Viewer::show_frame().
class PreparedFrame;

/// The choices at the time when it was made (Viewer::frame_maker()): every frame gets the same look, and the ranges of
/// colours by numbers that the frame on show had then. Never changes.
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
