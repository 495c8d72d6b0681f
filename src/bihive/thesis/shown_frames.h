// Frames shown per second: the configurations of Figure 4.4 on a real screen, at the text's size, at rest and turning.
//
// This class draws the pictures and keeps the times. Its caller brings each picture to the screen, and says when it is
// there; so the window and the page measure the same thing. Each configuration is drawn twice: by the wide engine, and
// by the tree reconstructed from the text in scalar code. At rest the same picture is drawn again for each frame;
// turning, the camera orbits the scene once in the time of the measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bihive/image/image.h"
#include "bihive/thesis/frame_rates.h"

namespace bihive {

/// The figure's plan without its rounds. Its only MAX_PRIMS is the one that the text calls the best.
struct ShownFramesPlan : FrameRatePlan {
  double seconds = 2;  ///< minimum duration of a measurement, which ends with a frame; > 0

  /// The thesis's configurations. Error: a value is missing.
  static Result<ShownFramesPlan> from_values(const StatedValues& values);
};

/// One measurement.
struct ShownRate {
  std::int64_t scenario = 0, spheres = 0;
  std::optional<std::int64_t> max_prims;  ///< of the text's tree; unset: the wide engine
  bool turning = false;
  std::int64_t frames = 0;
  double seconds = 0;  ///< in which they were shown

  double fps() const { return seconds > 0 ? static_cast<double>(frames) / seconds : 0; }
};

class ShownFrames {
 public:
  explicit ShownFrames(ShownFramesPlan plan);

  /// Draws the next picture; it stays until the next call. Call it only before finished(). An Error ends the run.
  Result<const Image*> draw();
  /// Reports that the last picture is on the screen, at this time of any steady clock.
  void shown(double now_ms);

  bool finished() const { return failed_ || next_ == rates_.size(); }
  const ShownFramesPlan& plan() const { return plan_; }
  /// All measurements in order; those after the current one have no frames yet.
  const std::vector<ShownRate>& rates() const { return rates_; }
  std::size_t measured() const { return next_; }

  /// {"experiment": "shown-frames", "by", "device", "width_px", "height_px", "seconds", "threads", "complete",
  /// "configurations": [{"scenario", "spheres", "max_prims" (null: the wide engine), "turning", "frames", "seconds",
  /// "fps"}]}, of the measurements that are complete. `by`: "window" or "page".
  std::string json(const std::string& by, const std::string& device) const;

 private:
  Status prepare();

  ShownFramesPlan plan_;
  std::vector<ShownRate> rates_;
  std::size_t next_ = 0;
  bool failed_ = false;
  std::optional<std::size_t> prepared_;  // the measurement whose scene and tracer these are
  std::optional<Scene> scene_;
  std::optional<Tracer> tracer_;
  Film film_;
  Image image_;
  std::optional<double> warm_since_ms_, since_ms_;
  double turned_ = 0;  // fraction of the orbit, 0 to 1
};

}  // namespace bihive
