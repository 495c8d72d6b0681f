// The work of each primary ray of a picture in a tree: nodes, leaves, gaps and sphere tests, counted without a clock.
#pragma once

#include <vector>

#include "bihive/bih/observer.h"
#include "bihive/bih/tree.h"
#include "bihive/scene/scene.h"
#include "experiment.h"
#include "support/values.h"

namespace bihive::thesis {

/// An entry a pixel, row by row; of every `stride`-th row and column alone. Empty if cancelled.
struct RayCounts {
  int width = 0, height = 0;  ///< of the entries
  std::vector<CountingObserver> rays;

  /// The mean over all rays.
  struct Mean {
    double nodes = 0, leaves = 0, gaps = 0, tests = 0;
  };
  Mean mean() const;
};
RayCounts count_rays(const StepContext& context, const Scene& scene, const Tree& tree, cli::PictureSize size,
                     int stride = 1);

}  // namespace bihive::thesis
