// A scene to be measured: spheres, a camera, a light, and the box in which random rays start.
#pragma once

#include <string>

#include "bihive/scene/scene.h"
#include "options.h"

namespace bihive::bench {

struct BenchScene {
  Scene scene;                 ///< one light
  Vec3d random_lo, random_hi;  ///< local (geometry/sphere_set.h)
  std::string description;
};

/// A scene of the benchmark by its name, else an input of bihive. Fails as bihive does on an unreadable input.
///
/// s1 s2 s3: the thesis's scenarios, 4096 spheres of radius 1 in the cube [-20, 20]^3: a grid, clusters in the corners,
/// half and half, of which 320 pairs coincide. uN: N uniform spheres that fill 10 % of that cube. c1e6: a million of
/// radius 0.05 in the corner cubes. mol: a molecule; mol5: 5 x 5 x 5 copies of it, box by box. Synthetic scenes are
/// seen from (0, 0, 100) under the light of the thesis; molecules, and files without a camera, are framed.
BenchScene load_bench_scene(const BenchOptions& options);

/// Pixels along one side of the picture for about `rays` rays: a multiple of 8.
int picture_side_px(std::int64_t rays);

}  // namespace bihive::bench
