// A film as the screen shows it.
#pragma once

#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/image/transfer.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// As image_from_film() (render/renderer.h). A film with coverage lies over grey checks, so that people see what is
/// transparent.
Image image_to_show(const Film& film, View view, Transfer transfer);

}  // namespace bihive
