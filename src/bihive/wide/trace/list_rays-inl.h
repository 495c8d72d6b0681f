// A tile of rays, prepared for traversal as lists: local rays, their octants, and facts that hold for all of them.

#if defined(BIHIVE_WIDE_TRACE_LIST_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LIST_RAYS_INL_H_
#undef BIHIVE_WIDE_TRACE_LIST_RAYS_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LIST_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/local_rays-inl.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// At most kTileRays rays, made ready in the tile. Tree, rays and tile must outlive it.
class ListRays {
 public:
  ListRays(const WideTree& tree, const RaySpan& rays, ListTile& tile)
      : tree_(tree), rays_(rays), tile_(tile), bounds_(farthest_origin(), tree.is_image) {
    tile_.undecided.clear();
    tile_.leaf_entry_count = 0;
    tile_.queue.count = 0;
    const FloatTag d;
    auto least = in_all(std::numeric_limits<float>::infinity());
    auto most = hn::Neg(least);
    LocalRays local;
    for (std::int64_t first = 0; first < rays_.count; first += 16) {
      const int count = static_cast<int>(std::min<std::int64_t>(16, rays_.count - first));
      load(first, local);
      alignas(64) std::uint32_t outward_id[16];
      set_up_left(first, count, outward_id);
      write_local_rays(local, outward_id, tile_.rays + first, count);
      for (int lane = 0; lane < 16; lane += kFloatLanes) {
        hn::Store(hn::Load(d, local.s_max + lane), d, tile_.s_best + first + lane);
        const auto s_min = hn::Load(d, local.s_min + lane);
        hn::Store(s_min, d, tile_.s_min + first + lane);
        least = hn::Min(least, s_min);
        most = hn::Max(most, s_min);
        hn::Store(hn::Set(WordTag(), kNoSlot), WordTag(), tile_.winner + first + lane);
      }
      list_by_octant(first, count, local);
    }
    common_start_ = hn::GetLane(hn::MinOfLanes(d, least)) == hn::GetLane(hn::MaxOfLanes(d, most));
  }

  const FilterBounds& bounds() const { return bounds_; }
  /// The rays of an octant are the first octant_count() of tile.by_octant.
  std::uint32_t octant_count(int octant) const { return octant_count_[octant]; }
  /// The first far_count() of tile.far_rays are not for the filter.
  std::uint32_t far_count() const { return far_count_; }

  bool leave_some() const { return leave_some_; }      ///< some ray may start on a sphere
  bool inward_some() const { return inward_some_; }    ///< inward_id of the tile is filled
  bool careful_some() const { return careful_some_; }  ///< careful of the tile is filled
  bool common_start() const { return common_start_; }  ///< all rays have the same s_min

 private:
  // The largest coordinate of a local origin in the tile.
  float farthest_origin() const {
    const FloatTag d;
    auto largest = hn::Zero(d);
    const std::int64_t whole = rays_.count / kFloatLanes * kFloatLanes;
    float rest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::int64_t i = 0; i < whole; i += kFloatLanes)
        largest = hn::Max(largest, hn::Abs(hn::LoadU(d, rays_.origin[axis] + i)));
      for (std::int64_t i = whole; i < rays_.count; ++i) rest = std::max(rest, std::abs(rays_.origin[axis][i]));
    }
    double farthest = double(std::max(rest, hn::GetLane(hn::MaxOfLanes(d, largest)))) * tree_.scale;
    if (tree_.is_image)
      farthest += std::max({std::abs(tree_.shift.x), std::abs(tree_.shift.y), std::abs(tree_.shift.z)});
    if (farthest <= kFarOrigin) return static_cast<float>(farthest) * 1.000001F;

    // Some rays are far, or not valid: examine their local rays.
    float moved = 0;
    LocalRays local;
    for (std::int64_t i = 0; i < rays_.count; i += 16) {
      load(i, local);
      moved = std::max(moved, local.farthest_origin);
    }
    return moved;
  }

  void load(std::int64_t first, LocalRays& local) const {
    const std::int64_t left = rays_.count - first;
    if (left >= 16)
      set_up_16(rays_, first, tree_, local);
    else
      set_up_tail(rays_, first, static_cast<int>(left), tree_, local);
  }

  // Adds sixteen rays to the lists of their octants; far ones to the list of far rays.
  HWY_INLINE void list_by_octant(std::int64_t first, int count, const LocalRays& local) {
    const FloatTag d;
    std::uint32_t signs[3] = {};
    for (int lane = 0; lane < 16; lane += kFloatLanes)
      for (int axis = 0; axis < 3; ++axis)
        signs[axis] |= mask_bits(hn::Lt(hn::Load(d, local.direction[axis] + lane), hn::Zero(d))) << lane;
    for (int i = 0; i < count; ++i) {
      if ((local.dead >> i & 1) != 0) continue;
      const std::uint32_t octant = (signs[0] >> i & 1) | (signs[1] >> i & 1) << 1 | (signs[2] >> i & 1) << 2;
      tile_.by_octant[octant][octant_count_[octant]++] = static_cast<std::uint32_t>(first + i);
    }
    for (std::uint32_t far = local.far; far != 0; far &= far - 1)
      tile_.far_rays[far_count_++] = static_cast<std::uint32_t>(first + __builtin_ctz(far));
  }

  bool some_go_inward() const {
    std::uint8_t any = 0;
    for (std::int64_t i = 0; rays_.inside != nullptr && i < rays_.count; ++i) any |= rays_.inside[i];
    return any != 0;
  }

  // Records the sphere that each ray exits. A ray that exits one of several equal spheres is marked `careful`: no hit
  // on a sphere around this centre counts as sure.
  HWY_INLINE void set_up_left(std::int64_t first, int count, std::uint32_t outward_id[16]) {
    std::fill_n(outward_id, 16, kNoSphere);
    if (!leave_some_) return;
    for (int k = 0; k < count; ++k) {
      const std::uint64_t leaves = static_cast<std::uint64_t>(rays_.leaves[first + k]);
      outward_id[k] = leaves < static_cast<std::uint64_t>(tree_.size) ? static_cast<std::uint32_t>(leaves) : kNoSphere;
    }
    if (inward_some_) {
      for (int k = 0; k < count; ++k) {
        const bool inward = rays_.inside[first + k] != 0;
        tile_.inward_id[first + k] = inward ? outward_id[k] : kNoSphere;
        outward_id[k] = inward ? kNoSphere : outward_id[k];
      }
    }
    if (!careful_some_) return;
    for (int k = 0; k < count; ++k) {
      const RepeatedSphere* const left = LeftSphere(tree_, rays_.leaves[first + k]).repeated();
      tile_.careful[first + k] = left != nullptr ? 1 : 0;
      tile_.left_centre[0][first + k] = left != nullptr ? tree_.spheres.x[left->slot] : 0;
      tile_.left_centre[1][first + k] = left != nullptr ? tree_.spheres.y[left->slot] : 0;
      tile_.left_centre[2][first + k] = left != nullptr ? tree_.spheres.z[left->slot] : 0;
    }
  }

  const WideTree& tree_;
  const RaySpan& rays_;
  ListTile& tile_;
  FilterBounds bounds_;
  std::uint32_t octant_count_[8] = {};
  std::uint32_t far_count_ = 0;
  const bool leave_some_ = rays_.leaves != nullptr;
  const bool inward_some_ = leave_some_ && some_go_inward();
  const bool careful_some_ = leave_some_ && !tree_.repeated.empty();
  bool common_start_ = false;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LIST_RAYS_INL_H_
