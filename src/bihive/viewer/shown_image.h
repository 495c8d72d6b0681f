// A film as the screen shows it.
#pragma once

#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/image/png_pixels.h"
#include "bihive/image/transfer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// As image_from_film() (render/renderer.h). A film with coverage is drawn over grey checks, which show transparency.
Image image_to_show(const Film& film, View view, Transfer transfer);

/// The image with the labels of these settings that apply. A coarser image is first enlarged to the settings' size, so
/// that letters stay sharp and in place while something moves.
Image labelled(Image image, const Scene& scene, const RenderSettings& settings);
/// The same with opacity, if the pixels have any (8 bits).
PngPixels labelled(PngPixels pixels, const Scene& scene, const RenderSettings& settings);

}  // namespace bihive
