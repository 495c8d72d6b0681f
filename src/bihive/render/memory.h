// Checks before a picture is made whether it fits this machine's memory. A picture that certainly does not fit is
// refused; one that perhaps does not fit (bih/memory.h, wide/wide_builder.h) is tried.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"

namespace bihive {

/// The tree that the engine builds.
Status check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters);

/// A picture of this many pixels, as film, display values and file. Sides as in RenderSettings.
Status check_picture_memory(int width_px, int height_px);

}  // namespace bihive
