// The work of primary rays in the trees of Figure 4.4: each ray alone, or rays in lockstep.
#include <algorithm>

#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/scene/camera.h"
#include "bihive/thesis/frame_rates.h"

namespace bihive {
namespace {

// A part of a ray's way: inner nodes, then at most one leaf with its spheres.
struct Stretch {
  std::int64_t inner = 0, leaves = 0, tests = 0;
};
using Way = std::vector<Stretch>;

// Writes down the way: a stretch for each leaf, or for each node.
struct WayObserver {
  bool by_node;
  Way way = {{}};

  void node_visit() { ++next().inner; }
  void leaf_visit() { ++next().leaves; }
  void empty_gap() {}
  void sphere_test() { ++way.back().tests; }
  Stretch& next() { return by_node || way.back().leaves > 0 ? way.emplace_back() : way.back(); }
};

// The answer of a traversal that never ends early.
struct EveryNode {
  bool take(double, std::int64_t) { return false; }
  double limit() const { return std::numeric_limits<double>::infinity(); }
};

// Rays in lockstep wait for each other at the end of each stretch. A ray alone waits for none: its work is the sum.
RayWork together(const std::vector<WayObserver>& rays) {
  RayWork sum;
  bool longer = true;
  for (std::size_t at = 0; longer; ++at) {
    Stretch most;
    longer = false;
    for (const WayObserver& ray : rays) {
      if (at >= ray.way.size()) continue;
      longer = true;
      most = {std::max(most.inner, ray.way[at].inner), std::max(most.leaves, ray.way[at].leaves),
              std::max(most.tests, ray.way[at].tests)};
    }
    sum.inner += static_cast<double>(most.inner);
    sum.leaves += static_cast<double>(most.leaves);
    sum.tests += static_cast<double>(most.tests);
  }
  return sum;
}

// Means per ray; meaningless after cancellation.
RayWork counted_work(const Scene& scene, const Tree& tree, const FrameRatePlan& plan, int stride,
                     const CancelToken* cancel, Counting counting) {
  const bool by_node = counting == Counting::lockstep_by_node;
  const bool lockstep = by_node || counting == Counting::lockstep_by_leaf;
  const int width = lockstep ? 8 : 1, height = lockstep ? 4 : 1;  // of a block of rays
  const PixelRays pixels(scene.camera, plan.width_px, plan.height_px);
  const auto trace = [&](const Ray& ray, WayObserver& observer) {
    const ScaledRay scaled(ray, scene.spheres);
    EveryNode every;
    if (counting == Counting::without_culling)
      walk(tree, scene.spheres, scaled, every, observer);
    else
      traverse<false>(tree, scene.spheres, scaled, observer);
  };
  const auto blocks = [stride](int pixels_px, int block) {
    return (pixels_px + stride * block - 1) / (stride * block);
  };
  const int rows = blocks(plan.height_px, height), columns = blocks(plan.width_px, width);
  std::vector<RayWork> of_rows(static_cast<std::size_t>(rows));
  parallel_for(plan.threads, rows, [&](std::int64_t row) {
    if (cancel != nullptr && cancel->cancelled()) return;
    std::vector<WayObserver> rays(static_cast<std::size_t>(width * height), WayObserver{by_node});
    const double top = static_cast<double>(row) * stride * height + 0.5;
    for (int column = 0; column < columns; ++column) {
      const double left = column * stride * width + 0.5;
      for (int i = 0; i < width * height; ++i) {
        WayObserver& ray = rays[static_cast<std::size_t>(i)];
        ray.way.assign(1, {});
        trace(pixels.at(left + i % width, top + i / width), ray);
      }
      of_rows[static_cast<std::size_t>(row)] += together(rays);
    }
  });
  RayWork sum;
  for (const RayWork& row : of_rows) sum += row;
  const double all = static_cast<double>(rows) * columns;
  return {sum.inner / all, sum.leaves / all, sum.tests / all};
}

}  // namespace

Result<FigureWork> counted_figure(const FrameRatePlan& plan, int stride, const CancelToken* cancel, Counting counting) {
  FigureWork work;
  for (const std::int64_t scenario : plan.scenarios)
    for (const std::int64_t spheres : plan.spheres) {
      const Result<Scene> scene = plan.scene(scenario, spheres);
      if (!scene) return scene.error();
      for (const std::int64_t max_prims : plan.max_prims)
        work[{scenario, spheres}][std::min(max_prims, spheres)] = counted_work(
            *scene, build_reference_tree(scene->spheres, {max_prims, kUnlimited}), plan, stride, cancel, counting);
      if (cancel != nullptr && cancel->cancelled()) return cancelled_error();
    }
  return work;
}

}  // namespace bihive
