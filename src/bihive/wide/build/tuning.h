// Tuning constants of the builder. They change the tree, and the speed of the build or of rays, but never an answer.
#pragma once

#include <cstdint>

#include "bihive/wide/wide_tree.h"

namespace bihive {

// ---- Work for several threads ----

/// The input is read in chunks of this size, or larger ones so that there are at most kMostChunks.
constexpr std::int64_t kChunkSpheres = 32768;
constexpr std::int64_t kMostChunks = 256;
/// Larger sets are first sorted into the cells of a grid.
constexpr std::int64_t kGridSpheres = 150000;
/// Ranges of more spheres become tasks of their own.
constexpr std::int64_t kTaskSpheres = 8192;
/// Subtrees of at most this many spheres are collapsed by one task.
constexpr std::int64_t kSubtreeSpheres = 65536;

// ---- What a watcher is told (base/watch.h) ----

/// The shares of the time that are over when the first sphere, and when the last one, is in its leaf.
constexpr double kShareBeforeSplit = 0.1;
constexpr double kShareAfterSplit = 0.85;

// ---- Where to split ----

/// At this depth and below, ranges are halved by count: a guard against hostile sets.
constexpr int kDeepestMidpoint = 48;
/// Ranges up to this size choose between the midpoint and a plane that leaves full leaves.
constexpr std::int64_t kChoosingSpheres = 4096;
/// The midpoint must be this much better than full leaves, which save memory: more so in the ranges of up to two nodes'
/// spheres that decide how full the lowest nodes are. Chosen so that molecules stay below 19 bytes per sphere.
constexpr std::int64_t kLowestSpheres = 512;
constexpr float kLowestBias = 0.87F;
constexpr float kMidpointBias = 0.95F;
/// Rounds of the search for a plane by interpolation; after them the floats between are halved.
constexpr int kInterpolations = 4;

// ---- Which children a wide node gets ----

/// In this many last levels, children are chosen by count instead of cost, so that the levels suffice for any set.
constexpr int kLevelsByCost = 40;

// ---- Spheres wholly inside others ----

/// A line through a sphere must cross this many of the spheres inside it, on average, for rays to leave them out: four
/// leaves of them.
constexpr std::int64_t kFewestCrossed = 64;
/// Only a node with sides of at most this many diameters of a sphere is searched for spheres inside that one.
constexpr double kSidesOfCover = 1.25;
/// Enclosed spheres lie this far below the surface, in stored units: deeper than the origins of rays that exit the
/// surface, which binary32 rounds.
constexpr double kDepthOfEnclosed = 0x1p-21;

}  // namespace bihive
