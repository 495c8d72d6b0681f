// Tuning constants of the traversals, each with the measurement that set it. They change the speed, never an answer.
// wide/schedule/tuning.h holds the constants that choose between traversals.
#pragma once

#include <cstdint>

namespace bihive {

// ---- Beams ----

/// Closest hits: in beams wider than this many leaves, each sphere is tested only against the runs of sixteen rays in
/// whose way it lies. Measured from 0.1 to 0.7: no difference on a million spheres of two pixels; on 100,000 spheres of
/// ten pixels 0.15 is a fifth slower.
constexpr float kWidestWholeInLeaves = 0.25F;

/// Any hit: a beam that is wider than one leaf is split (measured from 0.7 to 4: flat on small scenes; sorted rays from
/// 0.35 to 3: half the width is up to a sixth slower, more makes no difference on most scenes). Its runs of sixteen
/// rays are beams up to this width, if they start at neighbouring pixels (above 2 large scenes lose), and up to one
/// leaf if they were sorted.
constexpr float kWidestRunInLeaves = 1.5F;

/// Depths, for which no ray ends early: a beam up to this width is traced as a whole (measured from 1 to 8 in a
/// protein, whose rays start on many layers: 4 leaves no beam to be split, and gains 8 %).
constexpr float kWidestForDepthsInLeaves = 4;

/// Rays of a wide beam that start on the same sphere become a beam of their own. Groups with fewer rays than the first
/// limit go to the lists; after as many small groups as the second, all rays of the block do.
constexpr int kFewestOfGroup = 4;
constexpr int kMostSmallGroups = 4;

/// After this many blocks of a call, any-hit beams are judged by the rays that remain.
constexpr std::int64_t kTrialBlocks = 16;

// ---- Lists ----

/// Rays per tile of lists: as many as fit into 5 MB.
constexpr int kTileRays = 32768;

/// Shorter lists continue as single rays (stream-inl.h), and leaves with fewer rays wait for each other.
constexpr std::uint32_t kShortList = 16;
constexpr std::uint32_t kShortLeafList = 16;

/// Prefetch distance, in list entries.
constexpr std::uint32_t kPrefetchDistance = 8;

/// Number of single rays traversed in turn.
constexpr std::uint32_t kStreamRays = 16;

}  // namespace bihive
