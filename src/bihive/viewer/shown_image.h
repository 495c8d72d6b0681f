// A film as the screen shows it.
#pragma once

#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/image/transfer.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// As image_from_film() (render/renderer.h). A film with coverage lies over grey checks, so that people see what is
/// transparent.
Image image_to_show(const Film& film, View view, Transfer transfer);

/// The image with the labels of a picture of these settings, those that it can have. A
/// coarser image is enlarged to the settings' size before, so that letters stay sharp and in place while something
/// moves.
Image labelled(Image image, const Scene& scene, const RenderSettings& settings);

}  // namespace bihive
