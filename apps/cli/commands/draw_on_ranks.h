// One picture by several processes: tiles, handed out by a counter that all share.
#pragma once

#include "commands/draw_picture.h"
#include "support/communicator.h"

namespace bihive::cli {

/// The same bits as alone. `file`: that of rank 0, null on the others, whose answer counts their own rays. Fails and
/// throws as draw_picture().
Drawn draw_on_ranks(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                    const ProgressCallback& progress, PictureCommunicator& ranks);

}  // namespace bihive::cli
