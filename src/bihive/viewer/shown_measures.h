// Area, volume and cavities of what is shown, as JSON, for the page's worker.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// {"spheres": how many are measured, "area", "area_error", "volume", "volume_error", "components",
/// "undecided_spheres", "cavities": [volumes, from large to small]}, in world units: as measure_union() of those
/// spheres of `input` that the scene shows and the selection names (select/selection.h; empty: all), with the radii of
/// the input. Copies along a cell do not count. Errors: those of the selection and of measure_union(); or no sphere is
/// left.
Result<std::string> shown_measures_to_json(const Scene& scene, const SphereSet& input, std::string_view selection,
                                           double probe);

}  // namespace bihive
