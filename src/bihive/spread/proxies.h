// Proxies: spheres that represent a whole set of which only some is known.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The renderer asks whether some sphere is clear, cut, or has lines of its own, which depths a set has, and what its
/// colours mean. A scene with the proxies alone gives the same answers: some twenty spheres, and one for each entry of
/// the legend. So do the proxies of all chunks of a set together. Their ids ascend.
std::vector<std::int64_t> proxies_of(const Scene& scene, const RenderSettings& settings);

}  // namespace bihive
