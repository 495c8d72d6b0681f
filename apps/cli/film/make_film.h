// Makes the pictures of a film, several steps at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/scene/style.h"
#include "film/film_plan.h"
#include "film/film_sink.h"
#include "film/frame_source.h"
#include "support/team.h"

namespace bihive::cli {

/// Milliseconds of each step, summed over the pictures. The steps go on at the same time.
struct FilmTimes {
  double read_ms = 0;   ///< from the file to spheres
  double build_ms = 0;  ///< looks and trees
  double trace_ms = 0;  ///< rays, labels and pixels
  double write_ms = 0;  ///< files, or the wait for ffmpeg
  std::int64_t pictures = 0;
};

/// Reads, builds, traces and writes these pictures, each step on a thread of its own; between two steps one picture
/// waits at most. Shows progress. After a signal or a failure the sink has paused: it throws Interrupted, or the
/// failure. The caller has a CancellableSection. `team`: null, or those who draw each picture together; its rank 0 has
/// the sink, and the others have none. Throws OtherRankFailed where another one of them has failed.
FilmTimes make_film(const FrameSource& source, const FilmPlan& plan, const RenderOptions& options, const Style& style,
                    const std::vector<std::int64_t>& pictures, FilmSink* sink, Team* team);

}  // namespace bihive::cli
