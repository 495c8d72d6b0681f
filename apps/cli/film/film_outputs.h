// The output and input files of a film.
#pragma once

#include <string>
#include <vector>

namespace bihive::cli {

/// Ends the program as check_outputs() does if the film, its description, its parts or the pictures of a sequence
/// cannot be written or are files that are read.
void check_film_outputs(const std::string& output, const std::vector<std::string>& inputs);

}  // namespace bihive::cli
