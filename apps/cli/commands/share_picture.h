// Rank 0 reads the input and tells the others.
#pragma once

#include "commands/render_steps.h"
#include "support/communicator.h"

namespace bihive::cli {

/// On rank 0 `prepared` is given, on the others it becomes what rank 0 has, but for the layers, and with this rank's
/// `settings.threads`. With all spheres, or with none.
void share_picture(PreparedPicture& prepared, bool with_spheres, PictureCommunicator& ranks);

}  // namespace bihive::cli
