// Films that keep selected spheres in place: how they move from frame to frame.
#pragma once

#include <string>
#include <vector>

#include "bihive/job/frame_source.h"
#include "bihive/job/rigid_motion.h"
#include "bihive/scene/style.h"
#include "film/film_plan.h"

namespace bihive::cli {

/// Camera translation for `follow`, per frame, relative to the first: the mean displacement of the selected spheres.
/// With a periodic cell each sphere moves between frames by the shortest way to an image, and where the first one
/// re-enters the cell at another side, the camera goes there too. A frame that selects none repeats the frame before;
/// if the selection changes between frames, the mean of its centres counts. Reads all frames. Fails with kBadUsage on a
/// wrong selection, or one that selects nothing in the first frame.
std::vector<Vec3d> shifts_of(const FrameSource& source, const FilmPlan& plan, const std::string& selection,
                             const Style& style);

/// The motions that lay each frame over the first one, by the spheres of a selection. Reads all frames. Fails with
/// kBadUsage where it selects fewer than three, or another number of spheres than in the first frame.
std::vector<RigidMotion> motions_of(const FrameSource& source, const FilmPlan& plan, const std::string& selection,
                                    const Style& style);

}  // namespace bihive::cli
