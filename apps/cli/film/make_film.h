// Makes the pictures of a film, several steps at a time.
#pragma once

#include "bihive/job/frame_source.h"
#include "bihive/scene/style.h"
#include "film/film_plan.h"
#include "film/film_sink.h"
#include "film/picture_numbers.h"
#include "support/communicator.h"

namespace bihive::cli {

/// Reads, builds, traces and writes these pictures, each step on its own thread; at most one picture waits between two
/// steps. Shows progress. After a signal or a failure the sink has paused: it throws Interrupted, or the failure. The
/// caller has a CancellableSection. `ranks`: null, or those that draw each picture together; its rank 0 has the sink,
/// and the others have none. Throws OtherRankFailed if another one of them has failed.
FilmTimes make_film(const FrameSource& source, const FilmPlan& plan, const RenderOptions& options, const Style& style,
                    const PictureNumbers& pictures, FilmSink* sink, PictureCommunicator* ranks);

}  // namespace bihive::cli
