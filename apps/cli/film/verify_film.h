// Films in one file that say how they were made: drawn again, and compared.
#pragma once

#include <string>

#include "bihive/job/figure.h"
#include "commands/commands.h"

namespace bihive::cli {

/// As verify_figure(). Pictures are compared by SHA-256: those drawn now with those that the record has, which were
/// taken before coding, and of an APNG these with those of the file.
Verdict verify_film(const std::string& path, const std::string& input, const DrawFigure& draw);

/// The request for the film at `path` with these changes of its pictures, whose input replaces the recorded one unless
/// it is empty. Fails as read_film_record() and request_again(), and if its record is none of a film.
FilmOptions film_again(const std::string& path, const RenderOptions& changes);

}  // namespace bihive::cli
