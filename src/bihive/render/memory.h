// Whether what a picture needs fits this machine's memory, before anything is made. What certainly does not fit is
// refused; what only may not (bih/memory.h, wide/wide_builder.h) is tried.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"

namespace bihive {

/// The tree that the engine builds.
Status check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters);

/// A picture of so many pixels, as film, display values and file. Sides as in RenderSettings.
Status check_picture_memory(int width_px, int height_px);

}  // namespace bihive
