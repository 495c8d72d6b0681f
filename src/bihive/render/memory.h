// Predicts the memory of a picture before it is made, from that of its tree (render/tree_memory.h), film and threads,
// and refuses what would not fit. Sets of a usual kind take 0.7 to 1.5 times what is predicted.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"
#include "bihive/render/tree_memory.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// A picture of this many pixels, as film, display values and file. Sides as in RenderSettings.
Status check_picture_memory(int width_px, int height_px);

/// Bytes of a film of `pixels` pixels, with what adaptive samples keep beside it.
double predict_film_bytes(const RenderSettings& settings, double pixels);

/// Bytes of the buffers of all threads that draw.
double predict_thread_bytes(const RenderSettings& settings);

/// The film of the pixels that are drawn together, and the buffers of all threads. `held_bytes`: of a film that is
/// used again.
Status check_film_memory(const RenderSettings& settings, double held_bytes);

/// All that a picture takes after the spheres: the tree while it is built, or the built tree with the threads' buffers
/// and `band_bytes` of film and file.
Status check_render_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters,
                           const RenderSettings& settings, double band_bytes);

/// Largest picture, in bytes, that is drawn at once: 3840 x 2160 pixels of 8 bits are. The limit sets the memory
/// alone: `bihive render demo --style plain --samples 1 --size 6000x1680` took 0.8 to 0.9 seconds of processor time in
/// bands of 5 to 180 MB.
constexpr double kBandBytes = 256.0 * 1024 * 1024;

/// The rows of a band for render_in_bands(), if a row takes this many bytes as film, display values and file: all, if
/// they take at most kBandBytes and a quarter of the memory; else as many as do, at least one.
int rows_of_band(int rows, double bytes_of_row);

}  // namespace bihive
