// The thesis's Figure 4.4 on the device at hand: frames a second of brute force and of trees of several MAX_PRIMS. The
// measurement goes in small steps, so that its caller can show progress and stop it.
//
// A frame is the shaded view of primary rays. It is the same for all contestants; only the search for hits differs.
// Brute force and the trees of one pair of scenario and number of spheres take turns, round by round. The first round
// warms up and does not count.
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

/// The plan: every scenario with every number of spheres, by brute force and by a tree of each MAX_PRIMS.
struct FrameRatePlan {
  std::vector<std::int64_t> scenarios, spheres, max_prims;  ///< none empty
  double radius = 1;
  int width_px = 0, height_px = 0;
  int recursion = 1;
  int rounds = 9;        ///< rounds that count; >= 1
  double least_ms = 15;  ///< of a round: shorter frames are repeated
  bool quick = false;    ///< smaller pictures and fewer rounds than in the thesis

  /// The thesis's plan, from the text of thesis/figure-4.4/values.json. Error: a value is missing there.
  static Result<FrameRatePlan> from_values(std::string_view values_json);
  /// A quarter of the width and height, one round: seconds instead of minutes, and rougher numbers.
  FrameRatePlan quickly() const;

  int configurations() const;
};

/// One configuration's times.
struct MeasuredRate {
  std::int64_t scenario = 0, spheres = 0;
  std::optional<std::int64_t> max_prims;  ///< unset: brute force
  std::vector<double> frame_ms;           ///< one for each round

  double fps() const;  ///< by the median of the rounds
};

class FrameRateRun {
 public:
  /// If a renderer is given, the graphics processor draws; the renderer loses its scene and must outlive the run. Else
  /// the reference engine draws on all threads.
  FrameRateRun(FrameRatePlan plan, GlRenderer* gl);

  /// Runs one round of one configuration. Does nothing after finished(). After an Error the run is over.
  Status step();

  bool finished() const;
  double done() const;          ///< 0 to 1, a share of the whole time
  double seconds_left() const;  ///< estimated from the rounds so far; 0 before the first
  const FrameRatePlan& plan() const { return plan_; }
  /// The complete ones, in the order of scenarios, spheres, brute force before trees.
  const std::vector<MeasuredRate>& rates() const { return rates_; }
  /// The configuration that step() measures next; the last one after the end.
  std::int64_t scenario() const { return plan_.scenarios[std::min(scenario_, plan_.scenarios.size() - 1)]; }
  std::int64_t spheres() const { return plan_.spheres[count_]; }

 private:
  // Brute force or a tree, and its times so far.
  struct Contestant {
    MeasuredRate rate;
    std::optional<Tracer> tracer;  // on the CPU
    std::optional<Tree> tree;      // on the graphics processor; null is brute force
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
