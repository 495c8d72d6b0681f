// Rank 0 reads the input and sends it to the others.
#pragma once

#include "commands/render_steps.h"
#include "support/communicator.h"

namespace bihive::cli {

/// On rank 0 `prepared` is the input; on the others it becomes a copy, except for the layers, and with this rank's
/// `settings.threads`. With all spheres, or with none.
void share_picture(PreparedPicture& prepared, bool with_spheres, PictureCommunicator& ranks);

}  // namespace bihive::cli
