#include "bihive/settings/check_picture.h"

#include "bihive/base/setting_name.h"

namespace bihive {

Status check_picture(const PictureSettings& picture, double aperture) {
  if (picture.fog && !(picture.fog->start < picture.fog->end))
    return Error{setting_name("fog_start") + " must be below " + setting_name("fog_end"), "", 0, 0,
                 "fog begins at 0 and ends at 1 unless stated"};
  if (picture.adaptive_samples && aperture > 0)
    return Error{"adaptive samples look for edges, and depth of field needs many samples everywhere", "", 0, 0,
                 "give a number: " + setting_name("samples") + " 64"};
  return Done{};
}

}  // namespace bihive
