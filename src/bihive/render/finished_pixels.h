// From a film to the finished pixels of a picture: transfer curve, matte and labels.
#pragma once

#include "bihive/image/film.h"
#include "bihive/image/png_pixels.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// `film`: the pixels of settings.crop, or of the whole picture. check_labels() must succeed.
PngPixels finished_pixels(const Film& film, const Scene& scene, const RenderSettings& settings, int bits);

}  // namespace bihive
