#include "bihive/thesis/figure_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/parallel.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/scene/camera.h"
#include "bihive/thesis/frame_rates_report.h"

namespace bihive {
namespace {

// Axes of the diagram: an inner node in sphere tests, a leaf in inner nodes.
constexpr double kLeastInner = 0.25, kMostInner = 16, kMostLeaf = 1;
constexpr int kColumns = 120, kRows = 51;

// Means per ray; meaningless after cancellation.
RayWork counted_work(const Scene& scene, const Tree& tree, const FrameRatePlan& plan, int stride,
                     const CancelToken* cancel) {
  const PixelRays pixels(scene.camera, plan.width_px, plan.height_px);
  const std::int64_t rows = (plan.height_px + stride - 1) / stride, columns = (plan.width_px + stride - 1) / stride;
  std::vector<CountingObserver> of_rows(static_cast<std::size_t>(rows));
  parallel_for(plan.threads, rows, [&](std::int64_t row) {
    if (cancel != nullptr && cancel->cancelled()) return;
    for (std::int64_t column = 0; column < columns; ++column) {
      const Ray ray = pixels.at(static_cast<double>(column * stride) + 0.5, static_cast<double>(row * stride) + 0.5);
      traverse<false>(tree, scene.spheres, ScaledRay(ray, scene.spheres), of_rows[static_cast<std::size_t>(row)]);
    }
  });
  RayWork sum;
  for (const CountingObserver& row : of_rows) {
    sum.inner += static_cast<double>(row.node_visits);
    sum.leaves += static_cast<double>(row.leaf_visits);
    sum.tests += static_cast<double>(row.sphere_tests);
  }
  const double rays = static_cast<double>(rows * columns);
  return {sum.inner / rays, sum.leaves / rays, sum.tests / rays};
}

}  // namespace

Result<FigureWork> counted_figure(const FrameRatePlan& plan, int stride, const CancelToken* cancel) {
  FigureWork work;
  for (const std::int64_t scenario : plan.scenarios)
    for (const std::int64_t spheres : plan.spheres) {
      const Result<Scene> scene = plan.scene(scenario, spheres);
      if (!scene) return scene.error();
      for (const std::int64_t max_prims : plan.max_prims)
        work[{scenario, spheres}][std::min(max_prims, spheres)] =
            counted_work(*scene, build_reference_tree(scene->spheres, {max_prims, kUnlimited}), plan, stride, cancel);
      if (cancel != nullptr && cancel->cancelled()) return Error{"cancelled", "", 0, 0, ""};
    }
  return work;
}

Result<WinPattern> stated_pattern(const StatedValues& values) {
  WinPattern pattern;
  for (const auto& [name, number] : {std::pair{"winner.max_prims", &pattern.max_prims},
                                     {"winner.wins", &pattern.wins},
                                     {"only_rises.scenario", &pattern.exception.first},
                                     {"only_rises.spheres", &pattern.exception.second}}) {
    const Result<std::int64_t> value = values.integer(name);
    if (!value) return value.error();
    *number = *value;
  }
  Result<std::vector<std::int64_t>> among = values.integers("max_prims_list");
  if (!among) return among.error();
  pattern.exception_max_prims = among->back();
  pattern.among = std::move(*among);
  return pattern;
}

CostDiagram cost_diagram(const FigureWork& work, const WinPattern& pattern, const std::vector<FigureWork>& seeds) {
  const std::string winner = tree_name(pattern.max_prims);
  CostDiagram diagram;
  diagram.title = fmt::format("Configurations won by {}", winner);
  diagram.wins_label = "won:";
  diagram.pattern_label =
      fmt::format("the text: {} wins {}, {} Scenario {} with {} spheres", winner, pattern.wins,
                  tree_name(pattern.exception_max_prims), pattern.exception.first, pattern.exception.second);
  diagram.share_label = fmt::format("the same with at least half of {} seeds", seeds.size());
  diagram.most_wins = static_cast<int>(work.size());
  for (int i = 0; i < kColumns; ++i)
    diagram.inner.push_back(kLeastInner * std::pow(kMostInner / kLeastInner, i / (kColumns - 1.0)));
  for (int i = 0; i < kRows; ++i) diagram.leaf.push_back(kMostLeaf * i / (kRows - 1));
  for (const double leaf : diagram.leaf)
    for (const double inner : diagram.inner) {
      const StepCosts costs{inner, leaf, 0};
      diagram.wins.push_back(static_cast<int>(wins_of(work, pattern, costs)));
      diagram.pattern.push_back(pattern_holds(work, pattern, costs));
      if (seeds.empty()) continue;
      const auto with = std::count_if(seeds.begin(), seeds.end(),
                                      [&](const FigureWork& seed) { return pattern_holds(seed, pattern, costs); });
      diagram.share.push_back(static_cast<double>(with) / static_cast<double>(seeds.size()));
    }
  return diagram;
}

}  // namespace bihive
