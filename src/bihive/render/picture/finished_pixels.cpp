#include "bihive/render/finished_pixels.h"

#include "bihive/render/draw_labels.h"

namespace bihive {

PngPixels finished_pixels(const Film& film, const Scene& scene, const RenderSettings& settings, int bits) {
  const Transfer curve = settings.view == View::shaded ? scene.picture.transfer : Transfer::none;
  const bool has_matte = settings.matte && !film.coverage.empty();
  PngPixels pixels = has_matte ? matted_pixels_from_film(film, curve, bits, *settings.matte, settings.threads)
                               : png_pixels_from_film(film, curve, bits, settings.threads);
  draw_labels(pixels, scene, settings);
  return pixels;
}

}  // namespace bihive
