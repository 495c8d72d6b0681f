// The thesis's Figure 4.4: frames per second of brute force and of trees of several MAX_PRIMS. `bihive thesis
// figure-4.4` and the page's "Run the thesis on this device" are this one experiment.
//
// A frame is the shaded view of primary rays. It is the same for all contestants; only the search for hits differs. The
// contestants of a configuration take turns, round by round. The first round warms up and does not count. The
// measurement proceeds in small steps, so that its caller can show progress and stop it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/image/film.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/thesis/cost_model.h"
#include "bihive/thesis/stated_values.h"

namespace bihive {

/// The plan: every scenario with every number of spheres, by brute force and by a tree of each MAX_PRIMS.
struct FrameRatePlan {
  std::vector<std::int64_t> scenarios, spheres, max_prims;  ///< none empty
  double radius = 1, fov_deg = 30;  ///< of the spheres; of the camera, along the picture's shorter side
  double corner_side = 8;           ///< of the small cubes of Scenarios 2 and 3
  std::uint64_t seed = 1;
  int width_px = 0, height_px = 0;
  int recursion = 1;
  int threads = 0;       ///< 0: all
  int rounds = 9;        ///< rounds that count; >= 1
  double least_ms = 15;  ///< of a round: shorter frames are repeated, so that a single moment does not decide
  bool quick = false;    ///< smaller pictures than in the thesis

  /// The thesis's plan, from the values of Figure 4.4. Error: a value is missing there.
  static Result<FrameRatePlan> from_values(const StatedValues& values);
  /// A fraction of the width and height.
  FrameRatePlan smaller(int divisor) const;
  /// A quarter of the width and height and a single round: seconds instead of minutes, with less precise numbers.
  FrameRatePlan quickly() const;
  /// The largest pictures, an integer fraction of this plan's in width and height, with which the whole run takes about
  /// `seconds` or less; at least an eighth. A few small frames by brute force are measured for that. So the run ends
  /// even on a slow GPU.
  Result<FrameRatePlan> within(double seconds, GlRenderer* gl) const;

  /// Error: there is no such scenario.
  Result<Scene> scene(std::int64_t scenario, std::int64_t count) const;
  RenderSettings settings(const Scene& scene) const;
  int configurations() const;
};

/// How the work of a ray is counted.
enum class Counting {
  each_ray,          ///< its own steps; nodes beyond the closest hit so far are left out
  without_culling,   ///< its own steps, in all nodes that it meets
  lockstep_by_node,  ///< the longest of 8 x 4 rays, which take their next node together, whatever it is
  lockstep_by_leaf,  ///< the longest of 8 x 4 rays, each of which goes down to its next leaf before any tests its
                     ///< spheres
};

/// Counts the primary rays of a plan's picture, of every `stride`-th row and column (or block of rays) alone: their
/// means in the trees of the plan's MAX_PRIMS, in all its configurations. A MAX_PRIMS that no leaf reaches means a
/// single leaf, and is stored under the number of spheres. Error: "cancelled", or there is no such scenario.
Result<FigureWork> counted_figure(const FrameRatePlan& plan, int stride, const CancelToken* cancel = nullptr,
                                  Counting counting = Counting::each_ray);

/// One configuration's times.
struct MeasuredRate {
  std::int64_t scenario = 0, spheres = 0;
  std::optional<std::int64_t> max_prims = {};  ///< unset: brute force
  std::vector<double> frame_ms = {};           ///< one for each round
};

/// The same times by configuration.
EngineTimes times_of(const std::vector<MeasuredRate>& rates);

/// Measures the configurations of a plan in turn: by the reference engine, or, if `gl` is not null, by the graphics
/// processor with the same trees. The renderer must outlive the run, and loses its scene.
class FrameRateRun {
 public:
  FrameRateRun(FrameRatePlan plan, GlRenderer* gl);

  /// Before the first step: continues after the complete rates of an earlier run of the same plan. Rates that are not
  /// whole groups in the order of the plan, with all rounds, are left out, and measured again.
  void resume(const std::vector<MeasuredRate>& rates);

  /// Counts the rounds of an earlier run of the same plan before its own. Both are finished.
  void put_after(const FrameRateRun& earlier);

  /// Runs one round of one contestant. Does nothing after finished(). After an Error the run is over; one of them says
  /// "cancelled".
  Status step(const CancelToken* cancel = nullptr);

  bool finished() const { return finished_; }
  double done() const { return finished_ ? 1 : done_cost_ / all_cost_; }  ///< 0 to 1, a share of the whole time
  double seconds_left() const;  ///< estimated from this run's finished rounds; 0 before the first
  const FrameRatePlan& plan() const { return plan_; }
  /// The complete ones, in the order of scenarios, spheres, brute force before trees.
  const std::vector<MeasuredRate>& rates() const { return rates_; }
  /// The configuration that step() measures next; the last one after the end.
  std::int64_t scenario() const { return plan_.scenarios[std::min(scenario_, plan_.scenarios.size() - 1)]; }
  std::int64_t spheres() const { return plan_.spheres[count_]; }

 private:
  std::vector<MeasuredRate> new_group() const;
  Status build_trees();
  Status measure(const CancelToken* cancel);
  Status draw_frame(const RenderSettings& settings, const CancelToken* cancel);
  Result<double> frame_ms(const CancelToken* cancel);
  void go_on();

  FrameRatePlan plan_;
  GlRenderer* gl_;
  std::size_t scenario_ = 0, count_ = 0;  // the group's configuration: positions in the plan
  bool finished_ = false;
  std::vector<MeasuredRate> rates_;

  // The contestants of a configuration: brute force and a tree of each MAX_PRIMS.
  std::shared_ptr<const Scene> scene_;
  std::vector<Tracer> tracers_;  // one per contestant; empty until the group is built
  std::vector<MeasuredRate> group_;
  std::size_t contestant_ = 0;
  int round_ = 0;  // 0 warms up
  Film film_;

  double all_cost_, done_cost_ = 0;
  double resumed_cost_ = 0;  // of done_cost_: measured by an earlier run
  double spent_ms_ = 0;      // by this one
};

}  // namespace bihive
