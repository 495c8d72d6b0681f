// The memory in which a tile of rays walks the tree as lists. One a thread, kept between calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "bihive/base/aligned_buffer.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

constexpr int kTileRays = 32768;
constexpr int kMostRivals = 4096;
constexpr int kQueue = 64;
constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();

/// A ray and a sphere slot whose order only binary64 can tell.
struct Rival {
  std::uint32_t ray;
  std::uint32_t slot;
};

/// Candidates that passed the first look of the filter: lanes in arrays, finished many at a time.
struct alignas(64) CandidateQueue {
  float b[kQueue + 32];
  float dp[kQueue + 32];
  float r_squared[kQueue + 32];  // (r + e)^2
  std::uint32_t slot[kQueue + 32];
  std::uint32_t ray[kQueue + 32];
  int count = 0;
};

/// Rays that wait for a leaf, for leaves with few of them.
struct LeafPair {
  std::uint32_t ray;
  std::uint32_t first;  // slot
  std::uint32_t count;  // 1 to 16
};
constexpr int kMostLeafPairs = 64;

struct ListTile {
  alignas(64) FilterRay rays[kTileRays + 4];
  alignas(64) float s_best[kTileRays + 16];
  alignas(64) std::uint32_t winner[kTileRays + 16];
  alignas(64) float s_min[kTileRays + 16];
  // Only if some ray goes into the sphere that it leaves: its id, or kNoSphere.
  alignas(64) std::uint32_t inward_id[kTileRays + 16];
  // Only if some spheres are equal. 1: the sphere that it leaves has equals.
  alignas(64) std::uint32_t careful[kTileRays + 16];
  alignas(64) std::uint32_t by_octant[8][kTileRays + 16];
  std::uint32_t far_rays[kTileRays];  // for the scalar traversal
  Rival rivals[kMostRivals + 16];
  int rival_count;
  CandidateQueue queue;
  LeafPair pairs[kMostLeafPairs + 16];
  int pair_count;
  AlignedBuffer arena;
  AlignedBuffer stream;

  // On huge pages: rays are looked up all over it.
  static void* operator new(std::size_t bytes) { return allocate_aligned(bytes); }
  static void operator delete(void* tile) { std::free(tile); }
};

}  // namespace bihive::kernels
