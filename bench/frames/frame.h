// Whole pictures and their times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/scene/scene.h"

namespace bihive::bench {

/// A square picture with shadows, recursion 5.
RenderSettings whole_picture(int threads, int side_px = 1024);
/// The thesis's frames: 1136 x 640 pixels, primary rays, no shadows.
RenderSettings thesis_frame(int threads);

/// Milliseconds of one picture: to linear radiance, then to bytes.
struct FrameMs {
  double render = 0, to_bytes = 0;
  double all() const { return render + to_bytes; }
};

/// The picture's times in order of measurement, its rays, and its hash.
struct FrameTimes {
  std::vector<FrameMs> times;
  RenderCounts rays;
  std::uint64_t hash = 0;
  Film film;  ///< the last one; the next one reuses its memory

  /// Medians.
  double render_ms() const;
  double all_ms() const;
};

/// Draws the picture once more.
void add_frame(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, FrameTimes& times);

}  // namespace bihive::bench
