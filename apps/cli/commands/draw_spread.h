// Draws one picture of spheres distributed over several processes.
#pragma once

#include "bihive/spread/spread_scene.h"
#include "commands/draw_picture.h"
#include "support/communicator.h"

namespace bihive::cli {

/// Draws the same bits as one process that has all spheres. `settings.threads`: those of this rank.
/// `file`: on rank 0, null on the others, which return the counts of their own rays. Fails and throws as
/// draw_picture(). The channel has begun, and ends here.
Drawn draw_spread(const SpreadScene& spread, const RenderSettings& settings, PictureFile* file,
                  const ProgressCallback& progress, PictureCommunicator& ranks, TileChannel& channel);

/// Rank 0 alone draws pictures that cannot be shared, and the others answer its rays.
Drawn draw_spread_alone(const SpreadScene::Artist& artist, RenderEngine engine, const RenderSettings& settings,
                        const std::vector<Layer>& layers, PictureFile* file, const ProgressCallback& progress,
                        TileChannel& channel);

}  // namespace bihive::cli
