// The text output of bihive compare and bihive tune.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bihive/compare/comparison.h"
#include "bihive/compare/ray_path.h"
#include "bihive/compare/sweep.h"
#include "bihive/compare/tune.h"

namespace bihive::cli {

/// A number with about three digits; "-" for NaN.
std::string short_number(double value);

/// The answer in a sentence: which structure is the fastest, and by how much.
std::string answer_of(const workbench::Comparison& comparison);

/// "primary rays", "points".
std::string name_of_kind(const workbench::Comparison& comparison, std::size_t k);
/// "1 and 2 threads".
std::string threads_text(const std::vector<int>& threads);
/// "max-prims 4, max-depth 16", or "its own choice".
std::string text_of(const workbench::StructureParameters& parameters);

/// `name` is the name of the input.
std::string comparison_text(const workbench::Comparison& comparison, const std::string& name);
std::string sweep_text(const workbench::Sweep& sweep, const std::string& name);
std::string tuning_text(const workbench::Tuning& tuning, const std::string& name);
/// `pixel`: x, y of the ray in a square picture of `side_px`.
std::string ray_paths_text(const std::vector<workbench::StructurePath>& paths, const std::string& name,
                           std::pair<int, int> pixel, int side_px);

}  // namespace bihive::cli
