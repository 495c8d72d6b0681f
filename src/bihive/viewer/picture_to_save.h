// A picture of any size for a file, drawn in steps, so that its caller can show progress and stop it.
#pragma once

#include <optional>

#include "bihive/base/result.h"
#include "bihive/image/png_pixels.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"
#include "bihive/viewer/gpu_pictures.h"

namespace bihive {

class PictureToSave {
 public:
  /// Scene and tracer must outlive it and must not change.
  static Result<PictureToSave> by_cpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings);
  /// As above. The scene must have been set; its lights may be new. Any other picture that `gpu` begins meanwhile ends
  /// this one.
  static Result<PictureToSave> by_gpu(GpuPictures& gpu, const Scene& scene, bool new_lights,
                                      const RenderSettings& settings);

  /// Draws for about `budget_ms`, at least one tile.
  Status advance(double budget_ms);
  bool finished() const;
  double done() const;  ///< share of the picture, 0 to 1; 1 at the end
  /// Returns the finished picture, once: display values of 8 bits, with opacity if its background is transparent, and
  /// with the labels that apply.
  Result<PngPixels> take();

 private:
  PictureToSave(const Scene& scene, const RenderSettings& settings) : scene_(&scene), settings_(settings) {}

  const Scene* scene_;
  RenderSettings settings_;
  std::optional<SlicedPicture> sliced_;  // on the CPU
  GpuPictures* gpu_ = nullptr;
};

}  // namespace bihive
