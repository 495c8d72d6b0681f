// Tests every ray against every sphere, on vectors: the thesis's brute force without the handicap of scalar code. No
// structure, no box, no filter in binary32, no bound by an earlier hit.
#pragma once

#include <cstdint>

#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/ray_batch.h"

namespace bihive {

/// The closest hit of each ray, with the bits of test_all_spheres() (render/query/brute_force.h). An invalid ray hits
/// nothing.
void wide_brute_hits(const SphereSet& spheres, const RaySpan& rays, const HitSpan& hits);

/// Whether each ray hits anything: 1 or 0. It also tests all spheres.
void wide_brute_occluded(const SphereSet& spheres, const RaySpan& rays, std::uint8_t* hidden);

}  // namespace bihive
