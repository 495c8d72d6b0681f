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

/// A picture of at most so many bytes is drawn at once: 3840 x 2160 pixels of 8 bits are. The limit sets the memory
/// alone: `bihive render demo --style plain --samples 1 --size 6000x1680` took 0.8 to 0.9 seconds of processor time in
/// bands of 5 to 180 MB.
constexpr double kBandBytes = 256.0 * 1024 * 1024;

/// The rows of a band for render_in_bands(), if a row takes so many bytes as film, display values and file: all, if
/// they take at most kBandBytes and a quarter of the memory; else as many as do, at least one.
int rows_of_band(int rows, double bytes_of_row);

}  // namespace bihive
