// Constants that choose an order of rays and a traversal, each with the measurement that set it. They change the speed,
// never an answer. wide/trace/tuning.h holds the constants within a traversal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bihive::wide {

// ---- Order by light: shadow rays (docs/decisions/0012-shadow-rays-sorted.md) ----

/// Minimum number of shadow rays: with fewer, blocks of 64 are hardly ever close. A guess, not measured.
constexpr std::int64_t kFewestToLight = 2048;
/// Rays per cross-section of a leaf: sixteen of them must fit into a run one leaf wide.
constexpr double kFewestPerLeaf = 25;
/// Rays sorted at a time.
constexpr std::int64_t kToLightAtATime = 262144;
/// The map of directions has at most 2^bits cells along each side, and this many rays per cell.
constexpr int kMostCellBits = 8;
constexpr std::int64_t kRaysPerLightCell = 4;

/// Sorted rays try beams with this many evenly spread blocks, but with at most one in N of all blocks.
constexpr std::int64_t kSortedTrialBlocks = 16;
constexpr std::int64_t kBlocksPerTrial = 8;
/// Spheres met per ray above which sorted rays are faster as lists than as beams. Measured with limits of 40, 60 and
/// 80: a grid of 4,096 spheres has 8, a million uniform ones have 36, 125 molecules side by side 160.
constexpr std::int64_t kMostSpheresMet = 80;

// ---- Order by cell: scattered rays (docs/decisions/0015-scattered-rays-sorted.md) ----

/// Minimum number of rays and spheres: with fewer, sorting took as long as it saved.
constexpr std::int64_t kFewestScattered = 65536;
constexpr std::int64_t kFewestSpheres = 65536;
/// Coherence samples: neighbours examined, the fraction of them that must be far apart, and that distance. All random
/// rays are far apart; of the third mirrored rays of the benchmark's large scenes 0.3 to 0.8.
constexpr std::int64_t kCoherenceSamples = 256;
constexpr double kScatteredShare = 0.9;
constexpr double kFarInExtents = 1.0 / 16;
/// Mean number of rays per cell of the grid over the spheres, in each octant.
constexpr std::int64_t kRaysPerCell = 32;
/// Rays sorted at a time. More is faster: it takes some 60 bytes per ray, which the thread keeps.
constexpr std::int64_t kScatteredAtATime = 1 << 20;

// ---- Rays that remain after a traversal ----

/// Runs of at least this many rays are answered in place; shorter ones are copied, up to this many rays at a time.
constexpr std::int64_t kLongRun = 4096;
constexpr std::int64_t kRemainingAtATime = 16384;

// ---- Rays shared among threads (RayOptions of wide/queries.h) ----

/// Rays of a beam's block, of which chunks are multiples.
constexpr std::int64_t kRaysOfBlock = 64;
/// The fewest rays of a thread, if the caller states a number of threads and if not: fewer are traced faster
/// than threads are woken.
constexpr std::int64_t kFewestOfThread = kRaysOfBlock;
constexpr std::int64_t kFewestOfOpenThread = 4096;
constexpr std::int64_t kChunksPerThread = 4;
/// Rays per chunk: scattered ones are sorted within it, so the more the better; of all hits fewer, whose sorting ends a
/// chunk.
constexpr std::int64_t kMostRaysOfChunk = 1 << 19;
constexpr std::int64_t kMostRaysOfHits = 1 << 17;
/// Prefetch distance while hits are sorted.
constexpr std::size_t kHitsAhead = 16;
/// Hits that are sorted between two looks whether the call is cancelled.
constexpr std::int64_t kHitsBetweenLooks = 1 << 18;

// ---- Points (wide/point_queries.h): chosen by judgement, no sizes were measured against each other ----

/// Points per task: some milliseconds of work, and few tasks for millions of points.
constexpr std::int64_t kPointsPerChunk = 1024;
/// Minimum numbers of points and spheres for sorting points by cell, and points sorted at a time: so few that a
/// cancelled call ends within some hundredths of a second.
constexpr std::int64_t kFewestPoints = 4096;
constexpr std::int64_t kFewestSpheresOfPoints = 4096;
constexpr std::int64_t kPointsAtATime = 1 << 20;
/// Mean number of points per cell; the grid has at most 2^bits cells along each side.
constexpr std::int64_t kPointsPerCell = 16;
constexpr int kMostPointCellBits = 7;

}  // namespace bihive::wide
