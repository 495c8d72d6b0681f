// Figure 4.4 by counted work: what its primary rays do in each tree, what the steps cost by measured frames, and the
// diagram of who wins at which costs. For `bihive thesis` and for the page.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/bih/tree.h"
#include "bihive/scene/scene.h"
#include "bihive/thesis/cost_diagram.h"
#include "bihive/thesis/cost_model.h"
#include "bihive/thesis/frame_rates.h"

namespace bihive {

/// The rays of a picture; of every `stride`-th row and column alone.
struct CountedPicture {
  int width_px = 1136, height_px = 640, stride = 1;
};

/// Means per primary ray. Nothing if cancelled.
std::optional<RayWork> counted_work(const Scene& scene, const Tree& tree, const CountedPicture& picture, int threads,
                                    const CancelToken* cancel = nullptr);

/// The trees of a plan's MAX_PRIMS in all its configurations.
Result<FigureWork> counted_figure(const FrameRatePlan& plan, const CountedPicture& picture);

/// The text's pattern: values winner.* and only_rises.*, the last of max_prims_list.
Result<WinPattern> stated_pattern(const StatedValues& values);

/// Whether the whole pattern holds at these costs of an inner node and of a leaf.
bool pattern_holds(const FigureWork& work, const WinPattern& pattern, const std::vector<std::int64_t>& max_prims,
                   double inner, double leaf);

/// The diagram without points: an inner node from 1/4 to 16 sphere tests, a leaf from 0 to 1 inner node. `seeds`: the
/// same work with other seeds, for the share that has the pattern.
CostDiagram cost_diagram(const FigureWork& work, const WinPattern& pattern, const std::vector<std::int64_t>& max_prims,
                         const std::vector<FigureWork>& seeds);

/// The frames of a run as fit_costs() takes them.
EngineTimes times_of_rates(const std::vector<MeasuredRate>& rates);

}  // namespace bihive
