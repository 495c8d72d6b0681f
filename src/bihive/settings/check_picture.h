// Checks settings that contradict each other although each is in range.
#pragma once

#include "bihive/base/result.h"
#include "bihive/settings/picture_settings.h"

namespace bihive {

/// Error: which settings, and what to do. `aperture`: the radius of the camera's lens, 0: none.
Status check_picture(const PictureSettings& picture, double aperture = 0);

}  // namespace bihive
