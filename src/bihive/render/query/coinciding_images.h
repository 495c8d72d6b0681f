// Do spheres of a set with images share places? Where they do not, a ray knows the sphere that it leaves by its id.
#pragma once

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// False only if no two spheres of the set, images counted, have equal centres: rounding to binary32 cannot bring them
/// together. True also where spheres are very close, or where it would take long to know. Takes time and memory in
/// proportion to the stored spheres.
bool images_may_coincide(const SphereSet& spheres);

}  // namespace bihive
