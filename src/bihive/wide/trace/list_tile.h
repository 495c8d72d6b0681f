// Working memory of a tile of rays. One per thread, kept between calls.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bihive/base/aligned_buffer.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/trace/undecided_pairs.h"

namespace bihive {

constexpr int kQueue = 64;

/// Candidates that passed the first test of the filter: lanes in arrays, finished many at a time.
struct alignas(64) CandidateQueue {
  float b[kQueue + 32];
  float dp[kQueue + 32];
  float r_squared[kQueue + 32];  // (r + e)^2
  std::uint32_t slot[kQueue + 32];
  std::uint32_t ray[kQueue + 32];
  int count = 0;
};

/// A ray that waits for a leaf entered by few rays.
struct LeafEntry {
  std::uint32_t ray;
  std::uint32_t slot;   // of the first sphere
  std::uint32_t count;  // 1 to 16
};
constexpr int kMostLeafEntries = 64;

struct ListTile {
  alignas(64) LocalRay rays[kTileRays + 4];
  alignas(64) float s_best[kTileRays + 16];
  alignas(64) std::uint32_t winner[kTileRays + 16];
  alignas(64) float s_min[kTileRays + 16];
  // The id of the sphere that the ray goes into, or kNoSphere. Written only if some ray goes into a sphere.
  alignas(64) std::uint32_t inward_id[kTileRays + 16];
  // 1: the sphere that the ray exits has equals, around this centre. Written only if some spheres are equal.
  alignas(64) std::uint32_t careful[kTileRays + 16];
  alignas(64) float left_centre[3][kTileRays + 16];
  alignas(64) std::uint32_t by_octant[8][kTileRays + 16];
  std::uint32_t far_rays[kTileRays];  // for the scalar traversal
  UndecidedPairs<4096> undecided;
  CandidateQueue queue;
  LeafEntry leaf_entries[kMostLeafEntries + 16];
  int leaf_entry_count;
  AlignedBuffer arena;
  AlignedBuffer stream;

  // On huge pages, because rays are read in random order.
  static void* operator new(std::size_t bytes) { return allocate_aligned(bytes); }
  static void operator delete(void* tile) { free_aligned(tile); }
};

}  // namespace bihive
