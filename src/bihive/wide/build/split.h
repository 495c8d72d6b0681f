// The builder's first step: spheres are put in leaf order under a binary tree, in vectors.
//
// The result depends on the spheres alone: only comparisons, minima, maxima, and arithmetic that is the same on
// every instruction set.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/build/binary_tree.h"
#include "bihive/wide/build/tuning.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// The arrays of WideSpheres, to be written. With a palette `r` is null. Each has kWidth entries after the last sphere.
struct SphereArrays {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  float* r = nullptr;
  std::uint32_t* word = nullptr;

  float* axis(int k) const { return k == 0 ? x : k == 1 ? y : z; }
};

/// Up to 31 different radii above 0, in order of appearance; or the fact that there are more.
struct RadiusPalette {
  static constexpr int kMost = 31;
  static constexpr std::uint32_t kZeroClass = 31;
  alignas(64) float radius[32] = {};
  int size = 0;
  bool overflow = false;
  bool has_zero = false;  ///< a radius is 0

  void add(float r) {
    if (overflow || r == 0) return;
    for (int k = 0; k < size; ++k)
      if (radius[k] == r) return;
    overflow = size == kMost;
    if (!overflow) radius[size++] = r;
  }
};

/// Facts found in one pass over the spheres.
struct InputSummary {
  Aabb centres;
  float largest_radius = 0;
  RadiusPalette palette;

  void add(const InputSummary& next);
};

/// A sphere that has an equal, as a build finds it.
struct EqualSphere {
  std::uint32_t id;
  float x, y, z, r;
};

/// The state that all tasks of a build share.
struct SplitContext {
  SphereArrays scratch, final;  ///< spheres move between the two; leaves end in `final`
  alignas(64) float palette[32] = {};
  float largest_radius = 0;
  std::int64_t full_leaf = kWidth;
  NodeArena* arena = nullptr;

  WatchedWork* work = nullptr;  ///< null: nobody watches. Once it is cancelled, nodes stay without content
  std::int64_t spheres = 0;     ///< in all
  std::atomic<std::int64_t> spheres_in_leaves{0};
  std::atomic<bool> out_of_memory{false};
  std::atomic<std::int64_t> spheres_read{0};  ///< work done: each sphere counts once per pass
  std::mutex mutex;
  std::vector<EqualSphere> equal;  ///< in no order

  bool cancelled() const { return work != nullptr && work->cancelled(); }
};

/// Spheres first to first + count - 1 of one of the two arrays, which become the tree under `node`.
struct SplitRange {
  BinaryNode* node = nullptr;
  Aabb centres;  ///< of their centres
  std::int64_t first = 0, count = 0;
  int depth = 0;  ///< splits above
  bool in_final = false;
  bool coincident = false;  ///< all centres are equal, and repeated spheres are known already
};

/// Grid for the top of a large set: the box of all centres, halved nine times along its longest side, into 512 cells.
struct CellGrid {
  static constexpr int kBits = 9;
  static constexpr int kCells = 1 << kBits;
  float lo[3] = {}, scale[3] = {};  ///< cell coordinate of c: (c - lo) * scale, cut to [0, last]
  int last[3] = {};
  int axis[kBits] = {};                 ///< halving axes from the top; bit kBits - 1 - i of a cell is halving i
  std::uint16_t place[3][kCells] = {};  ///< cell coordinate -> its bits of the cell number

  explicit CellGrid(const Aabb& centres);
};

namespace wide {

InputSummary summarize(const SphereSet& spheres, std::int64_t begin, std::int64_t end);

/// Writes spheres begin to end - 1 to the same positions in the scratch arrays.
void load_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end, SplitContext& context);

/// Computes cell[i - begin] of each sphere, and the number of spheres per cell.
void find_cells(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const CellGrid& grid,
                std::uint16_t* cell, std::uint32_t* counts);

/// Writes the spheres to the scratch arrays: sphere i to next[cell[i - begin]]++.
void scatter_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const std::uint16_t* cell,
                     std::uint32_t* next, SplitContext& context);

/// The box of the centres in a range.
Aabb bound_centres(const SplitContext& context, const SplitRange& range);

/// Builds the tree under range.node. Nodes with more than kTaskSpheres spheres are left without boxes and costs. Large
/// ranges become tasks in `list`.
void split_range(SplitContext& context, const SplitRange& range, TaskList& list);

/// To be called when all tasks are done: sets boxes and costs of the nodes with more than kTaskSpheres spheres.
void close_tops(BinaryNode& root);

}  // namespace wide
}  // namespace bihive
