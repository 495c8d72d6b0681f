// The constants of the walkers that choose between ways, each with the measurement that set it. They change the speed,
// never an answer. wide/schedule/tuning.h holds the constants that choose between walkers.
#pragma once

#include <cstdint>

namespace bihive {

// ---- Beams ----

/// Closest hits: beams that are wider than so many leaves let each sphere meet only the runs of sixteen rays in whose
/// way it lies. Measured from 0.1 to 0.7: on a million spheres of two pixels all the same, on a hundred thousand of ten
/// 0.15 loses a fifth.
constexpr float kWidestWholeInLeaves = 0.25F;

/// Any hit: a beam that is wider than one leaf is taken apart (measured from 0.7 to 4: flat on small scenes; of sorted
/// rays from 0.35 to 3: half of it is up to a sixth slower, more is the same on most scenes). Its runs of sixteen rays
/// are beams up to this width, if they start at neighbouring pixels (above 2 large scenes lose), and up to one leaf if
/// they were sorted.
constexpr float kWidestRunInLeaves = 1.5F;

/// Rays of a wide beam that leave the same sphere become a beam of their own. Groups of fewer rays go to the
/// lists; after so many small groups all rays of the block do.
constexpr int kFewestOfGroup = 4;
constexpr int kMostSmallGroups = 4;

/// After so many blocks of a call, any-hit beams are judged by the rays that remain.
constexpr std::int64_t kTrialBlocks = 16;

// ---- Lists ----

/// Rays that walk as lists at a time: as many as fit into 5 MB.
constexpr int kTileRays = 32768;

/// Shorter lists go on as rays that walk alone (stream-inl.h), and leaves with fewer rays wait for each other.
constexpr std::uint32_t kShortList = 16;
constexpr std::uint32_t kShortLeafList = 16;

/// Memory is asked for the ray that comes so many places later in a list.
constexpr std::uint32_t kAhead = 8;

/// So many rays walk alone in turn.
constexpr std::uint32_t kStreamRays = 16;

}  // namespace bihive
