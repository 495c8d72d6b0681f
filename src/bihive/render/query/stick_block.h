// Neighbouring rays that meet the tree of sticks together: one test of a box serves all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/stick.h"
#include "bihive/render/query/stick_tree.h"

namespace bihive {

/// Up to 64 valid rays, in the stored units of the tree.
class StickBlock {
 public:
  static constexpr int kRays = 64;

  void clear() { count_ = 0; }
  int count() const { return count_; }
  /// Sticks beyond `limit` do not matter to the ray.
  void add(const ScaledRay& ray, double limit) {
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis][count_] = ray.origin[axis];
      direction[axis][count_] = ray.direction[axis];
    }
    direction_squared[count_] = ray.direction_squared;
    t_min[count_] = ray.t_min;
    t_end[count_] = limit < ray.t_max ? limit : ray.t_max;
    ++count_;
  }

  /// Rounded up to whole vectors.
  int padded_count(int lanes) const { return (count_ + lanes - 1) / lanes * lanes; }

  // Columns, of which traverse() may change those from count() on.
  alignas(64) double origin[3][kRays];     // NOLINT: written before read
  alignas(64) double direction[3][kRays];  // NOLINT
  alignas(64) double direction_squared[kRays], t_min[kRays];
  alignas(64) double t_end[kRays];  ///< sticks beyond it do not matter; below t_min: none does

 private:
  int count_ = 0;
};

/// stick_roots() (geometry/stick.h) of a stick, for each ray that may hit it.
struct StickBlockRoots {
  bool has_side = false;  ///< false: there are none; one end lies in the other
  alignas(64) double t_near[StickBlock::kRays], t_far[StickBlock::kRays];  // NOLINT: written before read
  alignas(64) double s_near[StickBlock::kRays], s_far[StickBlock::kRays];

  StickRoots of_ray(std::size_t i) const { return {t_near[i], t_far[i], s_near[i], s_far[i]}; }
};

/// What the traversal of a block asks about sticks.
class StickBlockTests {
 public:
  StickBlockTests(const StickBlockTests&) = delete;
  StickBlockTests& operator=(const StickBlockTests&) = delete;

  virtual Stick stick(std::int64_t index) const = 0;
  /// Bit i of `near`: ray i may hit the stick. Afterwards t_end of the block may have become smaller.
  virtual void test(std::int64_t index, const Stick& stick, std::uint64_t near, const StickBlockRoots& roots) = 0;

 protected:
  StickBlockTests() = default;
  ~StickBlockTests() = default;
};

/// Takes the rays to every stick that they may hit, nearly from near to far. False: nothing was done, because the rays
/// are too far from each other or from one direction; traverse() of stick_tree.h takes each of them.
bool traverse(const StickTree& tree, StickBlock& block, double more_pad, StickBlockTests& tests);

}  // namespace bihive
