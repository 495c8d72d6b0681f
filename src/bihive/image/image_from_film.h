// From a film to the picture that is shown or written.
#pragma once

#include "bihive/image/film.h"
#include "bihive/image/image.h"
#include "bihive/image/transfer.h"

namespace bihive {

/// byte_from_radiance() of every pixel. `threads` 0: all.
Image image_from_film(const Film& film, Transfer curve, int threads = 0);

}  // namespace bihive
