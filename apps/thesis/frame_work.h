// What the primary rays of Figure 4.4 do in each tree, counted without a clock.
#pragma once

#include "bihive/thesis/cost_model.h"
#include "experiment.h"

namespace bihive::thesis {

/// How a figure's rays are counted: the scene and the picture, with what may be otherwise than usual.
struct FigurePicture {
  std::uint64_t seed = 1;
  double radius = 1, fov_deg = 30;
  int width_px = 1136, height_px = 640;
  int stride = 1;  ///< of every so many rows and columns alone
};
/// As the values say.
FigurePicture counted_picture(const StepContext& context);

/// [{"scenario", "spheres", "max_prims", "inner", "leaves", "tests"}], means per ray of the trees of these MAX_PRIMS
/// below the number of spheres, and with `one_leaf` of that of all spheres in one leaf. Null if cancelled.
Json count_work(const StepContext& context, std::int64_t scenario, const FigurePicture& picture,
                const std::vector<std::int64_t>& max_prims, bool one_leaf);

/// The same rows as work, added to `work`.
void add_work(const Json& rows, FigureWork& work);

}  // namespace bihive::thesis
