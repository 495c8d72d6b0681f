// The options of `bihive render` with which bihive-mpi can distribute spheres over its ranks.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "commands/commands.h"

namespace bihive::cli {

/// How ranks get their spheres. chunks: each rank reads a chunk of the file, if the file has chunks, because the option
/// depends on centres and radii alone. whole: rank 0 reads all, and distributes them.
enum class ReadingByRanks { chunks, whole };

/// The way in which all of these options work; ids as in RenderOptions::given. Error: one that the table of
/// distributed_options.cpp does not know.
Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options);

}  // namespace bihive::cli
