// A picture drawn again by the request of its record, where there are neither files of figures nor a graphics
// processor.
#pragma once

#include "bihive/image/png_pixels.h"
#include "bihive/job/picture_request.h"
#include "bihive/render/renderer.h"

namespace bihive {

/// The pixels of the request's picture, as a PNG holds them. `progress`: the finished share; may be empty. Fails if a
/// graphics processor drew it, and as load_input() and prepare_picture() do.
PngPixels draw_again(const PictureRequest& request, const ProgressCallback& progress = {});

}  // namespace bihive
