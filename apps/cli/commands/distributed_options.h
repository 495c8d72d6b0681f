// The options of `bihive render` with which bihive-mpi can distribute spheres over its ranks.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "commands/commands.h"

namespace bihive::cli {

/// How the spheres come to the ranks. chunks: each rank reads a chunk of the file, where the file has chunks, as the
/// option looks at no sphere but by its centre and radius. whole: rank 0 reads all, and the others get theirs from it.
enum class ReadingByRanks { chunks, whole };

/// The way in which all of these options work; they are named as RenderOptions::given does. Error: one that the table
/// of distributed_options.cpp does not know.
Result<ReadingByRanks> reading_by_ranks(const RenderOptions& options);

}  // namespace bihive::cli
