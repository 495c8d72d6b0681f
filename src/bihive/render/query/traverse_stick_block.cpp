#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/query/traverse_stick_block.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/query/stick_block.h"
#include "bihive/render/query/stick_roots-inl.h"
#include "bihive/render/query/waiting_children.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace stick_block {

constexpr double kNowhere = -std::numeric_limits<double>::infinity();
// The steepest ray across the axis along which all go, and the widest spread of slopes.
constexpr double kMostSlope = 4, kMostSpread = 0.5;
// And the widest extent, in mean extents of a stick.
constexpr double kMostWidth = 4;

HWY_INLINE double largest_lane(Lanes v) {
  alignas(64) double lanes[kLanes];
  hn::Store(v, Tag(), lanes);
  return *std::max_element(lanes, lanes + kLanes);
}
HWY_INLINE double largest_of(const double* column, int count) {
  Lanes largest = hn::Load(Tag(), column);
  for (int lane = kLanes; lane < count; lane += kLanes) largest = hn::Max(largest, hn::Load(Tag(), column + lane));
  return largest_lane(largest);
}
HWY_INLINE double least_of(const double* column, int count) {
  Lanes largest = all(kNowhere);
  for (int lane = 0; lane < count; lane += kLanes)
    largest = hn::Max(largest, hn::Sub(all(0), hn::Load(Tag(), column + lane)));
  return -largest_lane(largest);
}

// All points that the rays of a block may reach, by their position w along an axis along which all of them go. Across
// it, on the two other axes, they lie between two lines each:
//   least + least_slope * (w - w_begin)  and  largest + largest_slope * (w - w_begin).
struct Funnel {
  int major = 0, across[2] = {0, 0};
  double sign = 1;  // w = sign * the coordinate, ascending along the rays
  double w_begin = 0, w_end = 0;
  double least[2] = {0, 0}, largest[2] = {0, 0}, least_slope[2] = {0, 0}, largest_slope[2] = {0, 0};

  // False: there is none, or it is too wide.
  HWY_INLINE bool make(const StickTree& tree, StickBlock& block) {
    // Absent rays are like the first one, but end before they begin.
    for (int i = block.count(); i < block.padded_count(kLanes); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        block.origin[axis][i] = block.origin[axis][0];
        block.direction[axis][i] = block.direction[axis][0];
      }
      block.direction_squared[i] = block.direction_squared[0];
      block.t_min[i] = block.t_min[0];
      block.t_end[i] = kNowhere;
    }

    // Find the axis by the first ray.
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(block.direction[axis][0]) > std::abs(block.direction[major][0])) major = axis;
    sign = block.direction[major][0] < 0 ? -1 : 1;
    across[0] = (major + 1) % 3;
    across[1] = (major + 2) % 3;
    bool is_along = true;
    for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
      const Lanes along = hn::Mul(all(sign), hn::Load(Tag(), block.direction[major] + lane));
      const Lanes steep = hn::Mul(all(kMostSlope), along);
      LaneMask good = hn::Gt(along, all(0));
      for (const int axis : across)
        good = hn::And(good, hn::Le(hn::Abs(hn::Load(Tag(), block.direction[axis] + lane)), steep));
      is_along = is_along && every(good);
    }
    if (!is_along) return false;

    // Where do the rays begin?
    alignas(64) double w[StickBlock::kRays] = {};
    for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
      const Lanes o = hn::Load(Tag(), block.origin[major] + lane), d = hn::Load(Tag(), block.direction[major] + lane);
      const Lanes t = hn::Load(Tag(), block.t_min + lane);
      hn::Store(hn::Mul(all(sign), hn::MulAdd(t, d, o)), Tag(), w + lane);
    }
    // Before the box around all sticks nothing matters, and segments may begin infinitely far away.
    w_begin = std::max(least_of(w, block.padded_count(kLanes)), low_of(tree.box()) - 1);
    for (int a = 0; a < 2; ++a) {
      alignas(64) double at[StickBlock::kRays] = {}, slope[StickBlock::kRays] = {};
      for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
        const Lanes along = hn::Mul(all(sign), hn::Load(Tag(), block.direction[major] + lane));
        const Lanes of_axis = hn::Div(hn::Load(Tag(), block.direction[across[a]] + lane), along);
        const Lanes from = hn::Sub(all(w_begin), hn::Mul(all(sign), hn::Load(Tag(), block.origin[major] + lane)));
        hn::Store(of_axis, Tag(), slope + lane);
        hn::Store(hn::MulAdd(of_axis, from, hn::Load(Tag(), block.origin[across[a]] + lane)), Tag(), at + lane);
      }
      least[a] = least_of(at, block.padded_count(kLanes));
      largest[a] = largest_of(at, block.padded_count(kLanes));
      least_slope[a] = least_of(slope, block.padded_count(kLanes));
      largest_slope[a] = largest_of(slope, block.padded_count(kLanes));
      if (largest_slope[a] - least_slope[a] > kMostSpread) return false;
    }
    find_end(block);
    return width_in(tree.box()) <= kMostWidth * tree.mean_extent();
  }

  HWY_INLINE double low_of(const Aabb& box) const { return sign < 0 ? -double(box.hi[major]) : double(box.lo[major]); }

  // The widest extent across in a box.
  HWY_INLINE double width_in(const Aabb& box) const {
    const double low = low_of(box);
    const double high = sign < 0 ? -double(box.lo[major]) : double(box.hi[major]);
    const double from = std::max(low, w_begin) - w_begin, to = std::min(high, w_end) - w_begin;
    double width = 0;
    for (int a = 0; a < 2; ++a)
      for (const double w : {from, std::max(from, to)})
        width = std::max(width, largest[a] - least[a] + (largest_slope[a] - least_slope[a]) * w);
    return width;
  }

  // The farthest point that matters.
  HWY_INLINE void find_end(const StickBlock& block) {
    Lanes end = all(kNowhere);
    for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
      const Lanes o = hn::Load(Tag(), block.origin[major] + lane), d = hn::Load(Tag(), block.direction[major] + lane);
      const Lanes t = hn::Load(Tag(), block.t_end + lane);
      const LaneMask some = hn::Le(hn::Load(Tag(), block.t_min + lane), t);
      const Lanes w = hn::Mul(all(sign), hn::MulAdd(t, d, o));
      end = hn::Max(end, hn::IfThenElse(some, w, all(kNowhere)));
    }
    w_end = largest_lane(end);
  }
};

// The rays that meet the stick in their segment, and their roots. Filters drop those that pass its drawn out axis or
// the ball around it too far away, or meet that ball elsewhere.
HWY_INLINE std::uint64_t rays_that_meet(const StickBlock& block, const Stick& stick, StickBlockRoots& roots) {
  const StickForLanes for_lanes(stick);
  const Vec3d axis = stick.b - stick.a;
  const double largest = std::max(stick.radius_a, stick.radius_b);
  const double length = std::sqrt(dot(axis, axis));
  const double around = 0.5 * length + largest;
  // As in surely_misses(): rounding is less than 2^-46 of these lengths.
  constexpr double kError = 0x1p-40;
  const Lanes3 to_axis = all(axis), from_a = all(stick.a), half_axis = all(0.5 * axis);
  const bool has_side = for_lanes.has_side();
  roots.has_side = has_side;
  std::uint64_t near = 0;
  for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
    const Lanes t_min = hn::Load(Tag(), block.t_min + lane), t_end = hn::Load(Tag(), block.t_end + lane);
    const LaneMask some = hn::Le(t_min, t_end);
    if (none(some)) continue;
    const Lanes3 o = {hn::Load(Tag(), block.origin[0] + lane), hn::Load(Tag(), block.origin[1] + lane),
                      hn::Load(Tag(), block.origin[2] + lane)};
    const Lanes3 d = {hn::Load(Tag(), block.direction[0] + lane), hn::Load(Tag(), block.direction[1] + lane),
                      hn::Load(Tag(), block.direction[2] + lane)};
    const Lanes dd = hn::Load(Tag(), block.direction_squared + lane);
    const Lanes3 oc = subtract(from_a, o);

    // The ball around the stick.
    const Lanes3 to_middle = add(oc, half_axis);
    const Lanes squared = dot(to_middle, to_middle);
    const Lanes distance = hn::Sqrt(squared);
    const Lanes reach = hn::MulAdd(all(kError), distance, all(around * (1 + kError)));
    const Lanes inverse = hn::Div(all(1), dd);
    const Lanes along = hn::Mul(dot(to_middle, d), inverse);
    const Lanes apart = hn::Sub(hn::Mul(squared, all(1 - kError)), hn::Mul(hn::Mul(along, along), dd));
    const Lanes depth = hn::Sub(hn::Mul(reach, reach), apart);
    const Lanes half = hn::Sqrt(hn::Mul(hn::Max(depth, all(0)), inverse));
    const Lanes margin = hn::Mul(all(kError), hn::Sqrt(hn::Mul(squared, inverse)));
    LaneMask may = hn::And(some, hn::Ge(depth, all(0)));
    may = hn::And(may, hn::Le(hn::Sub(hn::Sub(along, half), margin), t_end));
    may = hn::And(may, hn::Ge(hn::Add(hn::Add(along, half), margin), t_min));
    if (none(may)) continue;

    // The drawn out axis.
    const Lanes3 normal = {hn::Sub(hn::Mul(d.y, to_axis.z), hn::Mul(d.z, to_axis.y)),
                           hn::Sub(hn::Mul(d.z, to_axis.x), hn::Mul(d.x, to_axis.z)),
                           hn::Sub(hn::Mul(d.x, to_axis.y), hn::Mul(d.y, to_axis.x))};
    const Lanes sizes = hn::Mul(hn::Sqrt(dd), all(kError * length));
    const Lanes lengths = hn::MulAdd(all(2), distance, all(4 * length + largest));
    const Lanes bound = hn::MulAdd(sizes, lengths, hn::Mul(all(largest), hn::Sqrt(dot(normal, normal))));
    may = hn::And(may, hn::Le(hn::Abs(dot(oc, normal)), bound));
    if (none(may)) continue;

    // The roots decide, by vectors or one by one.
    const auto in_segment = [&](Lanes t) HWY_ATTR { return hn::And(hn::Ge(t, t_min), hn::Le(t, t_end)); };
    if (has_side) {
      const RootLanes found = for_lanes.roots({o, d, dd});
      may = hn::And(may, found.hits);
      if (none(may)) continue;
      hn::Store(found.t_near, Tag(), roots.t_near + lane);
      hn::Store(found.t_far, Tag(), roots.t_far + lane);
      hn::Store(found.s_near, Tag(), roots.s_near + lane);
      hn::Store(found.s_far, Tag(), roots.s_far + lane);
      may = hn::And(may, hn::Or(in_segment(found.t_near), in_segment(found.t_far)));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), may, bits);
    near |= std::uint64_t{bits[0]} << lane;
  }
  return near;
}

}  // namespace stick_block

bool traverse_block_on_target(const StickTree& tree, StickBlock& block, double more_pad, StickBlockTests& tests) {
  if (tree.nodes().empty() || block.count() == 0) return true;
  stick_block::Funnel funnel;
  if (!funnel.make(tree, block)) return false;
  double farthest = 2;
  for (int axis = 0; axis < 3; ++axis)
    farthest = std::max({farthest, 2 - stick_block::least_of(block.origin[axis], block.padded_count(kLanes)),
                         2 + stick_block::largest_of(block.origin[axis], block.padded_count(kLanes))});
  // As for one ray (bih/traversal.h), with room for the rounding of slopes.
  const double pad = 0x1p-24 + 0x1p-44 * farthest + more_pad;

  WaitingChildren<double> waiting(tree.levels());
  std::int32_t at = 0;
  StickBlockRoots roots;
  for (;;) {
    // Which of the sixteen boxes does the funnel enter, and where?
    const StickNode& node = tree.nodes()[static_cast<std::size_t>(at)];
    const bool is_backward = funnel.sign < 0;
    alignas(64) double w_in[kStickWidth];
    std::uint32_t entered = 0;
    for (int lane = 0; lane < kStickWidth; lane += kLanes) {
      const auto plane = [&](const float(&planes)[kStickWidth])
                             HWY_ATTR { return hn::PromoteTo(Tag(), hn::LoadU(FloatHalf(), planes + lane)); };
      const Lanes first = plane(is_backward ? node.hi[funnel.major] : node.lo[funnel.major]);
      const Lanes last = plane(is_backward ? node.lo[funnel.major] : node.hi[funnel.major]);
      const Lanes w_first = hn::Sub(hn::Mul(all(funnel.sign), first), all(pad));
      const Lanes w_last = hn::Add(hn::Mul(all(funnel.sign), last), all(pad));
      const Lanes in = hn::Max(w_first, all(funnel.w_begin)), out = hn::Min(w_last, all(funnel.w_end));
      LaneMask meets = hn::Le(in, out);
      const Lanes from = hn::Sub(in, all(funnel.w_begin)), to = hn::Sub(out, all(funnel.w_begin));
      for (int a = 0; a < 2; ++a) {
        const Lanes least_slope = all(funnel.least_slope[a]), largest_slope = all(funnel.largest_slope[a]);
        const Lanes least =
            hn::Add(all(funnel.least[a] - pad), hn::Min(hn::Mul(least_slope, from), hn::Mul(least_slope, to)));
        const Lanes largest =
            hn::Add(all(funnel.largest[a] + pad), hn::Max(hn::Mul(largest_slope, from), hn::Mul(largest_slope, to)));
        meets = hn::And(meets, hn::And(hn::Le(least, plane(node.hi[funnel.across[a]])),
                                       hn::Ge(largest, plane(node.lo[funnel.across[a]]))));
      }
      hn::StoreU(in, Tag(), w_in + lane);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(Tag(), meets, bits);
      entered |= static_cast<std::uint32_t>(bits[0]) << lane;
    }

    waiting.push(node, entered, w_in);

    // Take the next one that may matter; at the end itself it may hold a smaller id.
    for (;;) {
      if (waiting.empty()) return true;
      const auto next = waiting.pop();
      if (next.entry > funnel.w_end) continue;
      at = next.child;
      if (at >= 0) break;
      const std::int64_t index = ~at;
      const Stick stick = tests.stick(index);
      const std::uint64_t near = stick_block::rays_that_meet(block, stick, roots);
      if (near == 0) continue;
      tests.test(index, stick, near, roots);
      funnel.find_end(block);
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(traverse_block_on_target);

bool traverse(const StickTree& tree, StickBlock& block, double more_pad, StickBlockTests& tests) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(traverse_block_on_target)(tree, block, more_pad, tests);
}

}  // namespace bihive
#endif
