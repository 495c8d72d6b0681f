// From a scene to a film: tiles over threads, the same bits for any number of them.
#pragma once

#include <cstdint>
#include <functional>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"
#include "bihive/image/image.h"
#include "bihive/render/film.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// shaded: Whitted's pictures. recursion: the deepest generation that hit something. traversal: gaps passed (green) and
/// nodes entered (blue) by the primary ray. normal, distance, id: of the first hit. tree: a drawing of the tree itself
/// (render/tree_picture.h). All but `shaded` are display values.
enum class View { shaded, recursion, traversal, normal, distance, id, tree };

struct RenderSettings {
  int width_px = 1280;        ///< 1 to 65535
  int height_px = 720;        ///< 1 to 65535
  int samples_per_pixel = 4;  ///< 1 to 4096; 1 = the pixel's centre
  int recursion = 5;          ///< 1 to 16
  bool shadows = true;
  View view = View::shaded;
  int threads = 0;  ///< 0 = as many as the machine runs at once
};

struct RenderCounts {
  std::int64_t primary = 0, shadow = 0, reflected = 0, transmitted = 0;  ///< rays traced
};

struct Rendered {
  Film film;
  RenderCounts rays;
  double render_ms = 0;
};

/// Called now and then, from one thread at a time, with the share of the picture that is done, 0 to 1.
using ProgressCallback = std::function<void(double done)>;

/// Settings of a scene's own defaults.
RenderSettings settings_from(const PictureDefaults& defaults);

/// Settings must be in range (a programmer's error otherwise). The traversal and tree views need a tracer of the
/// reference engine: an Error without one. An Error "cancelled" when the token was set before the picture was done.
/// `film`: whose memory becomes the new film's, so that frame after frame is drawn into the same; its contents are
/// lost. Each thread that took part keeps its buffers for the next picture, usually a few MB
/// (render/wave_integrator.h).
Result<Rendered> render(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                        const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr, Film film = {});

/// Applies the transfer curve to a shaded film; any other view is written as it is. `threads` 0: all.
Image image_from_film(const Film& film, View view, Transfer transfer, int threads = 0);

}  // namespace bihive
