// The thesis's Figure 4.4 on the device at hand: how many frames a second brute force and trees of several MAX_PRIMS
// make, measured in small steps, so that whoever asks can show progress and stop.
//
// A frame is the shaded view of primary rays, the same for all but for what finds the hits. Brute force and the trees
// of one pair of scenario and number of spheres take turns, round by round; the first round warms up and does not
// count.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/timer.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// What is measured: every scenario with every number of spheres, by brute force and by a tree of each MAX_PRIMS.
struct FrameRatePlan {
  std::vector<std::int64_t> scenarios, spheres, max_prims;  ///< none empty
  double radius = 1;
  int width_px = 0, height_px = 0;
  int recursion = 1;
  int rounds = 9;        ///< that count; >= 1
  double least_ms = 15;  ///< of a round: shorter frames are drawn again and again
  bool quick = false;    ///< smaller pictures and fewer rounds than the thesis's

  /// The thesis's, from the text of thesis/figure-4.4/values.json. Error: a value is missing there.
  static Result<FrameRatePlan> from_values(std::string_view values_json);
  /// A quarter of the width and height, one round: seconds instead of minutes, and rougher numbers.
  FrameRatePlan quickly() const;

  int configurations() const;
};

/// One configuration's times.
struct MeasuredRate {
  std::int64_t scenario = 0, spheres = 0;
  std::optional<std::int64_t> max_prims;  ///< unset: brute force
  std::vector<double> frame_ms;           ///< a round each

  double fps() const;  ///< by the median of the rounds
};

class FrameRateRun {
 public:
  /// On the graphics processor where a renderer is given, whose scene is lost; it must outlive the run. Else by the
  /// reference engine on all threads.
  FrameRateRun(FrameRatePlan plan, GlRenderer* gl);

  /// One round of one configuration. Nothing once finished(). After an Error the run is over.
  Status step();

  bool finished() const;
  double done() const;          ///< 0 to 1, of the time that it takes
  double seconds_left() const;  ///< by what was done so far; 0 before anything is
  const FrameRatePlan& plan() const { return plan_; }
  /// Complete ones, in the order of scenarios, spheres, brute force before trees.
  const std::vector<MeasuredRate>& rates() const { return rates_; }
  /// What step() measures next; the last when finished.
  std::int64_t scenario() const { return plan_.scenarios[std::min(scenario_, plan_.scenarios.size() - 1)]; }
  std::int64_t spheres() const { return plan_.spheres[count_]; }

 private:
  // Brute force or a tree, and its times so far.
  struct Contestant {
    MeasuredRate rate;
    std::optional<Tracer> tracer;  // on the CPU
    std::optional<Tree> tree;      // on the graphics processor; none is brute force
  };

  Status begin_group();
  Result<double> frame_ms();
  Status draw_frame(Film& film);

  FrameRatePlan plan_;
  GlRenderer* gl_;
  std::size_t scenario_ = 0, count_ = 0;  // the group: positions in the plan
  Scene scene_;
  RenderSettings settings_;
  std::vector<Contestant> group_;  // refer to scene_
  std::size_t contestant_ = 0;
  int round_ = 0;  // 0 warms up
  bool finished_ = false;
  std::vector<MeasuredRate> rates_;
  double done_weight_ = 0, all_weight_ = 0, spent_ms_ = 0;
  Film film_;
};

}  // namespace bihive
