// The direction from which most of some spheres is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/scene/framing.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The number of directions that are compared: evenly spread over the sphere, from the front to the back.
inline constexpr int kComparedSides = 200;

/// Of kComparedSides directions the one in whose picture the most pixels show one of these stored spheres. The pictures
/// are orthographic, as large as the ball around the spheres, 64 x 64 pixels; all spheres are opaque in them, and clips
/// cut. Of equal ones the nearest to the front. +y is up (principal_side.h: upright_side). Fails with kBadUsage where
/// no direction shows any. The same for every engine and number of threads.
Side best_side(const Scene& scene, const std::vector<std::int64_t>& ids, int threads);

}  // namespace bihive
