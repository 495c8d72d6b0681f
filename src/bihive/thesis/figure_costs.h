// Figure 4.4 by counted work: the steps of its primary rays in each tree, the cost of each step by measured frames, and
// the diagram of the winner by cost. For `bihive thesis` and for the page.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/thesis/cost_diagram.h"
#include "bihive/thesis/cost_model.h"
#include "bihive/thesis/frame_rates.h"

namespace bihive {

/// Counts the primary rays of a plan's picture, of every `stride`-th row and column alone: their means in the trees of
/// the plan's MAX_PRIMS, in all its configurations. A MAX_PRIMS that no leaf reaches means a single leaf, and is stored
/// under the number of spheres. Error: "cancelled", or there is no such scenario.
Result<FigureWork> counted_figure(const FrameRatePlan& plan, int stride, const CancelToken* cancel = nullptr);

/// The text's pattern: values winner.* and only_rises.*, the last of max_prims_list.
Result<WinPattern> stated_pattern(const StatedValues& values);

/// The diagram without points: an inner node from 1/4 to 16 sphere tests, a leaf from 0 to 1 inner node. `seeds`: the
/// same work with other seeds, for the share that has the pattern.
CostDiagram cost_diagram(const FigureWork& work, const WinPattern& pattern, const std::vector<FigureWork>& seeds);

}  // namespace bihive
