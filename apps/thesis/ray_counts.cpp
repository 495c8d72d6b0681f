#include "ray_counts.h"

#include "bihive/base/parallel.h"
#include "bihive/bih/traversal.h"
#include "bihive/scene/camera.h"

namespace bihive::thesis {

RayCounts count_rays(const StepContext& context, const Scene& scene, const Tree& tree, cli::PictureSize size,
                     int stride) {
  const PixelRays pixels(scene.camera, size.width_px, size.height_px);
  RayCounts counts{(size.width_px + stride - 1) / stride, (size.height_px + stride - 1) / stride, {}};
  counts.rays.resize(static_cast<std::size_t>(counts.width) * static_cast<std::size_t>(counts.height));
  parallel_for(context.settings.threads, counts.height, [&](std::int64_t y) {
    if (context.cancel.cancelled()) return;
    for (int x = 0; x < counts.width; ++x) {
      const Ray ray = pixels.at(x * stride + 0.5, static_cast<double>(y) * stride + 0.5);
      CountingObserver& observer = counts.rays[static_cast<std::size_t>(y * counts.width + x)];
      traverse<false>(tree, scene.spheres, ScaledRay(ray, scene.spheres), observer);
    }
  });
  if (context.cancel.cancelled()) counts.rays.clear();
  return counts;
}

RayCounts::Mean RayCounts::mean() const {
  Mean sum;
  for (const CountingObserver& ray : rays) {
    sum.nodes += static_cast<double>(ray.node_visits);
    sum.leaves += static_cast<double>(ray.leaf_visits);
    sum.gaps += static_cast<double>(ray.empty_gaps);
    sum.tests += static_cast<double>(ray.sphere_tests);
  }
  const double n = static_cast<double>(rays.empty() ? 1 : rays.size());
  return {sum.nodes / n, sum.leaves / n, sum.gaps / n, sum.tests / n};
}

}  // namespace bihive::thesis
