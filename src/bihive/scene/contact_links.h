// Links between spheres in contact (measure/union_measures.h).
#pragma once

#include "bihive/base/result.h"
#include "bihive/scene/links.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The contacts of the scene's spheres, each radius grown by the probe, with the column `area`: the rows that `bihive
/// measure --contacts` writes. Periodic images do not count. Errors: those of measure_union().
Result<LinkTable> contact_links(const Scene& scene, double probe, int threads = 0);

}  // namespace bihive
