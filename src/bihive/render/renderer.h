// From a scene to a film. Threads share the tiles; the bits are the same for any number of threads.
#pragma once

#include <functional>
#include <memory>

#include "bihive/base/cancel.h"
#include "bihive/base/result.h"
#include "bihive/base/watch.h"
#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/image/image_from_film.h"
#include "bihive/render/ray_counts.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

struct Rendered {
  Film film;
  RenderCounts rays;
  double render_ms = 0;
};

/// A stereo picture is that of render_stereo() (render/stereo.h). Settings must be in range (a programmer's error
/// otherwise). The traversal and tree views need a tracer of the reference engine: an Error without one. The Error is
/// cancelled_error() if the token was set before the picture was complete. Without `progress` and `cancel` those of the
/// thread's Watch count (base/watch.h). The new film takes the memory of `film`, whose contents are lost; so all frames
/// can share one film. Each thread that took part keeps its buffers for the next picture, usually a few MB
/// (render/shade/wave/wave_integrator.h).
Result<Rendered> render(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                        const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr, Film film = {});

/// Takes the next rows of a picture: the light of these pixels. An Error ends the picture.
using BandCallback = std::function<Status(const Film& film, const Tile& pixels)>;

struct RenderedBands {
  RenderCounts rays;
  double render_ms = 0;  ///< without the time in the callback
};

/// The next part to draw, some of drawn_pixels(); nothing: there are no more.
using NextPart = std::function<std::optional<Tile>()>;

/// Views that are drawn whole, because no part of them has the bits of the picture, and stereo pictures.
bool is_drawn_whole(const RenderSettings& settings);

/// Parts of a picture in any order, so that several processes can share it. Each has the bits of the whole picture.
/// Progress is that of the part. Not for views that are drawn whole (a programmer's error).
Result<RenderedBands> render_parts(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                   const NextPart& next, const BandCallback& take,
                                   const ProgressCallback& progress = {}, const CancelToken* cancel = nullptr);

/// The same picture from the top in bands of `band_rows` rows, at least one; the last may have fewer. So a picture
/// needs the memory of a band (render/memory.h). Each band has the bits of the whole picture. The views distance and
/// tree and stereo pictures are drawn whole, in one band. Progress is that of the whole picture.
Result<RenderedBands> render_in_bands(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                      int band_rows, const BandCallback& take, const ProgressCallback& progress = {},
                                      const CancelToken* cancel = nullptr);

/// The same picture in slices, for callers that have other work in between.
class SlicedPicture {
 public:
  /// As render(). Scene and tracer must outlive it and must not change.
  static Result<SlicedPicture> begin(const Scene& scene, const Tracer& tracer, const RenderSettings& settings,
                                     Film film = {});
  SlicedPicture(SlicedPicture&& other) noexcept;
  SlicedPicture& operator=(SlicedPicture&& other) noexcept;
  ~SlicedPicture();

  /// Renders tiles until about `budget_ms` have passed, at least one tile. View::tree is made in one slice.
  void advance(double budget_ms);

  bool finished() const;
  double done() const;  ///< finished share of the picture, 0 to 1
  /// Returns the finished picture, once; render_ms is the time spent in advance().
  Rendered take();

 private:
  class Implementation;
  explicit SlicedPicture(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// Applies the transfer curve to a shaded film; any other view is written as it is. `threads` 0: all.
inline Image image_from_film(const Film& film, View view, Transfer transfer, int threads = 0) {
  return image_from_film(film, view == View::shaded ? transfer : Transfer::none, threads);
}

}  // namespace bihive
