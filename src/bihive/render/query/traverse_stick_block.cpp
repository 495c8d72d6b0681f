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
#include "bihive/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace stick_block {

constexpr double kNowhere = -std::numeric_limits<double>::infinity();
// The steepest ray across the axis along which all go, and the widest spread of slopes.
constexpr double kMostSlope = 4, kMostSpread = 0.5;
// And the widest extent, in mean extents of a stick.
constexpr double kMostWidth = 6;

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
    Lanes first = all(kNowhere);
    for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
      const Lanes o = hn::Load(Tag(), block.origin[major] + lane), d = hn::Load(Tag(), block.direction[major] + lane);
      const Lanes t = hn::Load(Tag(), block.t_min + lane);
      first = hn::Max(first, hn::Mul(all(-sign), hn::MulAdd(t, d, o)));
    }
    // Before the box around all sticks nothing matters, and segments may begin infinitely far away.
    w_begin = std::max(-largest_lane(first), low_of(tree.box()) - 1);
    for (int a = 0; a < 2; ++a) {
      Lanes from_end = all(kNowhere), from_start = all(kNowhere), slopes_up = all(kNowhere),
            slopes_down = all(kNowhere);
      for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
        const Lanes along = hn::Mul(all(sign), hn::Load(Tag(), block.direction[major] + lane));
        const Lanes slope = hn::Div(hn::Load(Tag(), block.direction[across[a]] + lane), along);
        const Lanes from = hn::Sub(all(w_begin), hn::Mul(all(sign), hn::Load(Tag(), block.origin[major] + lane)));
        const Lanes at = hn::MulAdd(slope, from, hn::Load(Tag(), block.origin[across[a]] + lane));
        from_end = hn::Max(from_end, at);
        from_start = hn::Max(from_start, hn::Sub(all(0), at));
        slopes_up = hn::Max(slopes_up, slope);
        slopes_down = hn::Max(slopes_down, hn::Sub(all(0), slope));
      }
      least[a] = -largest_lane(from_start);
      largest[a] = largest_lane(from_end);
      least_slope[a] = -largest_lane(slopes_down);
      largest_slope[a] = largest_lane(slopes_up);
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

// The same rays in binary32: where each enters the plane at which the funnel begins, and its direction with length 1. A
// few steps drop the rays that are surely away from a stick.
class RoughRays {
 public:
  HWY_INLINE void make(const StickBlock& block, const Funnel& funnel, double farthest) {
    count_ = block.padded_count(kLanes);
    LaneMask good = hn::Eq(all(0), all(0));
    for (int lane = 0; lane < count_; lane += kLanes) {
      const Lanes along = hn::Mul(all(funnel.sign), hn::Load(Tag(), block.direction[funnel.major] + lane));
      const Lanes from = hn::Mul(all(funnel.sign), hn::Load(Tag(), block.origin[funnel.major] + lane));
      const Lanes t = hn::Div(hn::Sub(all(funnel.w_begin), from), along);
      const Lanes length = hn::Sqrt(hn::Load(Tag(), block.direction_squared + lane));
      LaneMask fits = hn::Eq(all(0), all(0));
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes d = hn::Load(Tag(), block.direction[axis] + lane);
        const Lanes o = hn::MulAdd(t, d, hn::Load(Tag(), block.origin[axis] + lane)), unit = hn::Div(d, length);
        fits = hn::And(fits, hn::And(hn::Le(hn::Abs(o), all(kMostOrigin)), hn::Le(hn::Abs(unit), all(2))));
        put(o, origin_[axis] + lane);
        put(unit, direction_[axis] + lane);
      }
      const Lanes t_min = hn::Load(Tag(), block.t_min + lane), t_end = hn::Load(Tag(), block.t_end + lane);
      good = hn::And(good, hn::Or(fits, hn::Gt(t_min, t_end)));
      put(hn::Mul(hn::Sub(t_min, t), length), begin_ + lane);
      hn::Store(t, Tag(), t_ + lane);
      hn::Store(length, Tag(), length_ + lane);
    }
    drops_some_ = every(good);
    error_ = static_cast<float>(std::min(0x1p-15 + 0x1p-43 * farthest, 0x1p100));  // infinitely far: all are near
    // Lanes after the last ray never meet anything.
    constexpr float kNever = -std::numeric_limits<float>::infinity();
    std::fill(end_ + count_, end_ + (count_ + kMostLanes - 1) / kMostLanes * kMostLanes, kNever);
    follow(block);
  }
  /// The ends of rays have changed.
  HWY_INLINE void follow(const StickBlock& block) {
    for (int lane = 0; lane < count_; lane += kLanes) {
      const Lanes t_end = hn::Load(Tag(), block.t_end + lane);
      put(hn::Mul(hn::Sub(t_end, hn::Load(Tag(), t_ + lane)), hn::Load(Tag(), length_ + lane)), end_ + lane);
    }
  }

  /// Bit i: ray i may meet the stick in its segment.
  HWY_INLINE std::uint64_t near(const Stick& stick) const {
    if (!drops_some_) return ~std::uint64_t{0};
    const Vec3d axis = stick.b - stick.a, middle = stick.a + 0.5 * axis;
    const auto largest = static_cast<float>(std::max(stick.radius_a, stick.radius_b));
    const double length = std::sqrt(bihive::dot(axis, axis));
    const Vec3d unit = length > 0 ? (1 / length) * axis : Vec3d{};
    const float reach = static_cast<float>(0.5 * length) + largest + error_;
    const Floats mx = set(middle.x), my = set(middle.y), mz = set(middle.z);
    const Floats ax = set(unit.x), ay = set(unit.y), az = set(unit.z);
    // Coordinates are below 2 + kMostOrigin, so each is wrong by less than 2^-18, and a distance by less than error_.
    const Floats most_squared = in_all(reach * reach * (1 + 0x1p-19F)), of_reach = in_all(reach);
    const Floats most_side = in_all(largest), error = in_all(error_), one = in_all(1 + 0x1p-18F);
    std::uint64_t near = 0;
    for (int lane = 0; lane < count_; lane += kFloatLanes) {
      const Floats dx = get(direction_[0] + lane), dy = get(direction_[1] + lane), dz = get(direction_[2] + lane);
      const Floats x = hn::Sub(mx, get(origin_[0] + lane)), y = hn::Sub(my, get(origin_[1] + lane)),
                   z = hn::Sub(mz, get(origin_[2] + lane));

      // The ball around the stick: along the ray, and across.
      const Floats along = dot(x, y, z, dx, dy, dz);
      const Floats cx = hn::MulSub(y, dz, hn::Mul(z, dy)), cy = hn::MulSub(z, dx, hn::Mul(x, dz)),
                   cz = hn::MulSub(x, dy, hn::Mul(y, dx));
      FloatMask may = hn::Le(dot(cx, cy, cz, cx, cy, cz), most_squared);
      may = hn::And(may, hn::Le(hn::Sub(along, of_reach), get(end_ + lane)));
      may = hn::And(may, hn::Ge(hn::Add(along, of_reach), get(begin_ + lane)));

      // The drawn out axis.
      const Floats turn = dot(ax, ay, az, dx, dy, dz);
      const Floats across = hn::Sqrt(hn::Max(hn::NegMulAdd(turn, turn, one), in_all(0)));
      const Floats apart = hn::Abs(dot(ax, ay, az, cx, cy, cz));
      may = hn::And(may, hn::Le(apart, hn::MulAdd(most_side, across, error)));
      near |= std::uint64_t{mask_bits(may)} << lane;
    }
    return near;
  }

 private:
  static constexpr double kMostOrigin = 32;

  static HWY_INLINE void put(Lanes v, float* to) { hn::StoreU(hn::DemoteTo(FloatHalf(), v), FloatHalf(), to); }
  static HWY_INLINE Floats get(const float* from) { return hn::Load(FloatTag(), from); }
  static HWY_INLINE Floats set(double x) { return in_all(static_cast<float>(x)); }
  static HWY_INLINE Floats dot(Floats x, Floats y, Floats z, Floats u, Floats v, Floats w) {
    return hn::MulAdd(z, w, hn::MulAdd(y, v, hn::Mul(x, u)));
  }

  int count_ = 0;            // of columns that are written, whole vectors of binary64
  bool drops_some_ = false;  // false: the numbers are too large
  float error_ = 0;
  alignas(64) float origin_[3][StickBlock::kRays];     // NOLINT: written before read
  alignas(64) float direction_[3][StickBlock::kRays];  // NOLINT
  alignas(64) float begin_[StickBlock::kRays], end_[StickBlock::kRays];
  alignas(64) double t_[StickBlock::kRays], length_[StickBlock::kRays];
};

// The rays that meet the stick in their segment, and their roots.
HWY_INLINE std::uint64_t rays_that_meet(const StickBlock& block, const RoughRays& rough, const Stick& stick,
                                        StickBlockRoots& roots) {
  const std::uint64_t may_meet = rough.near(stick);
  if (may_meet == 0) return 0;
  const StickForLanes for_lanes(stick);
  roots.has_side = for_lanes.has_side();
  std::uint64_t near = 0;
  for (int lane = 0; lane < block.padded_count(kLanes); lane += kLanes) {
    const std::uint64_t bits = may_meet >> lane & ((std::uint64_t{1} << kLanes) - 1);
    if (bits == 0) continue;
    const Lanes t_min = hn::Load(Tag(), block.t_min + lane), t_end = hn::Load(Tag(), block.t_end + lane);
    LaneMask meets = hn::Le(t_min, t_end);

    // The roots decide, by vectors or one by one.
    if (roots.has_side && !none(meets)) {
      const auto in_segment = [&](Lanes t) HWY_ATTR { return hn::And(hn::Ge(t, t_min), hn::Le(t, t_end)); };
      const Lanes3 o = {hn::Load(Tag(), block.origin[0] + lane), hn::Load(Tag(), block.origin[1] + lane),
                        hn::Load(Tag(), block.origin[2] + lane)};
      const Lanes3 d = {hn::Load(Tag(), block.direction[0] + lane), hn::Load(Tag(), block.direction[1] + lane),
                        hn::Load(Tag(), block.direction[2] + lane)};
      const RootLanes found = for_lanes.roots({o, d, hn::Load(Tag(), block.direction_squared + lane)});
      meets = hn::And(meets, found.hits);
      if (none(meets)) continue;
      hn::Store(found.t_near, Tag(), roots.t_near + lane);
      hn::Store(found.t_far, Tag(), roots.t_far + lane);
      hn::Store(found.s_near, Tag(), roots.s_near + lane);
      hn::Store(found.s_far, Tag(), roots.s_far + lane);
      meets = hn::And(meets, hn::Or(in_segment(found.t_near), in_segment(found.t_far)));
    }
    std::uint8_t met[8] = {};
    hn::StoreMaskBits(Tag(), meets, met);
    near |= (std::uint64_t{met[0]} & bits) << lane;
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

  stick_block::RoughRays rough;  // NOLINT: written before read
  rough.make(block, funnel, farthest);

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
      const std::uint64_t near = stick_block::rays_that_meet(block, rough, stick, roots);
      if (near == 0) continue;
      tests.test(index, stick, near, roots);
      funnel.find_end(block);
      rough.follow(block);
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
