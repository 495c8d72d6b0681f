// Draws one picture by several processes: tiles are assigned by a shared counter.
#pragma once

#include "commands/draw_picture.h"
#include "support/communicator.h"

namespace bihive::cli {

/// The same bits as one process. `file`: on rank 0, null on the others, which return the counts of their own rays.
/// Fails and throws as draw_picture().
Drawn draw_on_ranks(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                    const ProgressCallback& progress, PictureCommunicator& ranks);

}  // namespace bihive::cli
