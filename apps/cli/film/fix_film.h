// Makes the description of a film from the user's options.
#pragma once

#include <cstdint>

#include "bihive/job/frame_source.h"
#include "bihive/scene/style.h"
#include "film/film_plan.h"

namespace bihive::cli {

/// For an input with this number of frames. Fails if options contradict each other or the input.
FilmPlan::Asked film_asked_for(const FilmOptions& options, std::int64_t frames);

/// Camera, size and ranges of colours, from the film's first frame; the ranges from all its frames if the user wants
/// that, which reads all of them.
FilmPlan::Fixed fixed_by_film(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options,
                              const Style& style);

}  // namespace bihive::cli
