// The constants that choose an order of rays and a walker, each with the measurement that set it. They change the
// speed, never an answer. wide/trace/tuning.h holds the constants that choose
// within a walker.
#pragma once

#include <cstdint>

namespace bihive::wide {

// ---- Order by light: shadow rays (docs/decisions/0012-shadow-rays-sorted.md) ----

/// With fewer shadow rays, blocks of 64 are hardly ever close. A guess, not measured.
constexpr std::int64_t kFewestToLight = 2048;
/// Rays over the cross-section of a leaf: sixteen of them must fit into a run that is one leaf wide.
constexpr double kFewestPerLeaf = 25;
/// Sorted at a time.
constexpr std::int64_t kToLightAtATime = 262144;
/// The map of directions has at most 2^bits cells along each side, and so many rays a cell.
constexpr int kMostCellBits = 8;
constexpr std::int64_t kRaysPerLightCell = 4;

/// Sorted rays try beams with so many blocks from everywhere, but at most with one of so many.
constexpr std::int64_t kSortedTrialBlocks = 16;
constexpr std::int64_t kBlocksPerTrial = 8;
/// Sorted rays of which beams meet more spheres than this are faster as lists. Measured with limits of 40, 60 and 80: a
/// grid of 4,096 spheres has 8, a million uniform ones have 36, 125 molecules side by side 160.
constexpr std::int64_t kMostSpheresMet = 80;

// ---- Order by cell: scattered rays (docs/decisions/0015-scattered-rays-sorted.md) ----

/// With fewer rays or spheres sorting took as long as it saved.
constexpr std::int64_t kFewestScattered = 65536;
constexpr std::int64_t kFewestSpheres = 65536;
/// So many neighbours are looked at, and this share of them must be that far apart. All random rays are; of the third
/// mirrored rays of the benchmark's large scenes 0.3 to 0.8.
constexpr std::int64_t kLooks = 256;
constexpr double kScatteredShare = 0.9;
constexpr double kFarInExtents = 1.0 / 16;
/// In each octant, a cell of the grid over the spheres has so many rays on average.
constexpr std::int64_t kRaysPerCell = 32;
/// Sorted at a time. More is faster: it takes some 60 bytes a ray, which the thread keeps.
constexpr std::int64_t kScatteredAtATime = 1 << 20;

// ---- Rays that remain after a walker ----

/// Runs of at least this many rays are answered where they lie; shorter ones are copied, so many rays at a time.
constexpr std::int64_t kLongRun = 4096;
constexpr std::int64_t kRemainingAtATime = 16384;

// ---- Points (wide/point_queries.h): chosen by judgement, no sizes were measured against each other ----

/// A task of a thread: some milliseconds, and few tasks where there are millions of points.
constexpr std::int64_t kPointsPerChunk = 1024;
/// Points are sorted by cells from so many points and spheres on, so many at a time.
constexpr std::int64_t kFewestPoints = 4096;
constexpr std::int64_t kFewestSpheresOfPoints = 4096;
constexpr std::int64_t kPointsAtATime = 1 << 22;
/// On average a cell holds so many points; the grid has at most 2^bits cells along each side.
constexpr std::int64_t kPointsPerCell = 16;
constexpr int kMostPointCellBits = 7;

}  // namespace bihive::wide
