#include "bihive/measure/cap_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/measure/cap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/simd/wasm_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using measure::CapArrays;
using measure::CapNumbers;

using DoubleTag = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<DoubleTag>;
using DoubleMask = hn::Mask<DoubleTag>;
constexpr int kDoubles = static_cast<int>(hn::MaxLanes(DoubleTag()));

// The first lane from `from` on that `test` lets through: it takes the index of a vector's first lane.
template <class Test>
HWY_INLINE int first_lane(int from, int count, const Test& test) {
  for (int i = from; i < count; i += kDoubles) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(DoubleTag(), test(i), bits);
    if (bits[0] != 0) return std::min(i + __builtin_ctz(bits[0]), count);
  }
  return count;
}

HWY_INLINE Doubles dot_lanes(const CapArrays& caps, int i, Doubles x, Doubles y, Doubles z) {
  const DoubleTag d;
  const Doubles xs = hn::Mul(hn::LoadU(d, caps[0] + i), x), ys = hn::Mul(hn::LoadU(d, caps[1] + i), y);
  return hn::Add(hn::Add(xs, ys), hn::Mul(hn::LoadU(d, caps[2] + i), z));
}

// One cap against lanes of others, with the operations of CirclePair.
struct BesideOne {
  Doubles x, y, z, c, s;

  HWY_INLINE explicit BesideOne(const CapNumbers& cap)
      : x(hn::Set(DoubleTag(), cap.axis.x)),
        y(hn::Set(DoubleTag(), cap.axis.y)),
        z(hn::Set(DoubleTag(), cap.axis.z)),
        c(hn::Set(DoubleTag(), cap.c)),
        s(hn::Set(DoubleTag(), cap.s)) {}

  // d of the circles from i on; `t` becomes g - c c.
  HWY_INLINE Doubles crossing(const CapArrays& caps, int i, Doubles& t) const {
    const DoubleTag d;
    t = hn::Sub(dot_lanes(caps, i, x, y, z), hn::Mul(hn::LoadU(d, caps[3] + i), c));
    const Doubles product = hn::Mul(hn::LoadU(d, caps[4] + i), s);
    return hn::Sub(hn::Mul(product, product), hn::Mul(t, t));
  }
};

int unclear_on_target(const CapArrays& caps, int from, const CapNumbers& cap, double doubt) {
  const DoubleTag d;
  const BesideOne one(cap);
  const Doubles above = hn::Set(d, doubt), below = hn::Set(d, -doubt), apart = hn::Set(d, 0x1p-40),
                zero = hn::Set(d, 0);
  return first_lane(from, caps.size(), [&](int i) HWY_ATTR {
    Doubles t = zero;
    const Doubles crossing = one.crossing(caps, i, t);
    const Doubles cosines = hn::Add(hn::LoadU(d, caps[3] + i), one.c);
    const DoubleMask outside = hn::And(hn::And(hn::Lt(crossing, below), hn::Le(t, zero)), hn::Gt(cosines, apart));
    return hn::Not(hn::Or(hn::Gt(crossing, above), outside));
  });
}

// Half of the arc that a cap q covers on the circle of `cap` has the cosine (c_q - g c) / sqrt(1 - g^2) / s: its
// square, with its sign, is compared.
int widest_on_target(const CapArrays& caps, const CapNumbers& cap, double doubt) {
  const DoubleTag d;
  const BesideOne one(cap);
  const Doubles above = hn::Set(d, doubt), unit = hn::Set(d, 1);
  const Doubles none = hn::Set(d, std::numeric_limits<double>::infinity());
  Doubles least = none, index = hn::Iota(d, 0), index_of_least = hn::Set(d, caps.size());
  for (int i = 0; i < caps.size(); i += kDoubles) {
    const Doubles c = hn::LoadU(d, caps[3] + i), s = hn::LoadU(d, caps[4] + i);
    const Doubles g = dot_lanes(caps, i, one.x, one.y, one.z);
    const Doubles t = hn::Sub(g, hn::Mul(c, one.c)), product = hn::Mul(s, one.s);
    const Doubles crossing = hn::Sub(hn::Mul(product, product), hn::Mul(t, t));
    const Doubles cosine = hn::Sub(c, hn::Mul(g, one.c));
    const Doubles signed_square =
        hn::Div(hn::Mul(cosine, hn::Abs(cosine)), hn::Mul(hn::Sub(unit, g), hn::Add(unit, g)));
    const DoubleMask better = hn::And(hn::Gt(crossing, above), hn::Lt(signed_square, least));
    least = hn::IfThenElse(better, signed_square, least);
    index_of_least = hn::IfThenElse(better, index, index_of_least);
    index = hn::Add(index, hn::Set(d, kDoubles));
  }
  alignas(64) double squares[kDoubles], indices[kDoubles];
  hn::Store(least, d, squares);
  hn::Store(index_of_least, d, indices);
  double best = std::numeric_limits<double>::infinity();
  int found = caps.size();
  for (int lane = 0; lane < kDoubles; ++lane) {
    const int at = static_cast<int>(indices[lane]);
    if (at >= caps.size() || squares[lane] > best || (squares[lane] == best && at > found)) continue;
    best = squares[lane];
    found = at;
  }
  return found;
}

bool halves_on_target(const CapArrays& caps, const CapNumbers& cap, double crossing_doubt, const Vec3d points[3],
                      double doubt) {
  const DoubleTag d;
  const BesideOne one(cap);
  const Doubles above = hn::Set(d, crossing_doubt), sure = hn::Set(d, doubt);
  DoubleMask first_half = hn::Gt(above, above), second_half = first_half;  // none
  for (int i = 0; i < caps.size(); i += kDoubles) {
    const Doubles c = hn::LoadU(d, caps[3] + i);
    const auto held = [&](Vec3d point) HWY_ATTR {
      const Doubles along = dot_lanes(caps, i, hn::Set(d, point.x), hn::Set(d, point.y), hn::Set(d, point.z));
      return hn::Gt(hn::Sub(along, c), sure);
    };
    Doubles t = above;
    const DoubleMask middle = hn::And(hn::Gt(one.crossing(caps, i, t), above), held(points[1]));
    first_half = hn::Or(first_half, hn::And(middle, held(points[0])));
    second_half = hn::Or(second_half, hn::And(middle, held(points[2])));
    if (!hn::AllFalse(d, first_half) && !hn::AllFalse(d, second_half)) return true;
  }
  return false;
}

int holding_on_target(const CapArrays& caps, int from, Vec3d a, Vec3d b, double doubt) {
  const DoubleTag d;
  const Doubles ax = hn::Set(d, a.x), ay = hn::Set(d, a.y), az = hn::Set(d, a.z);
  const Doubles bx = hn::Set(d, b.x), by = hn::Set(d, b.y), bz = hn::Set(d, b.z), below = hn::Set(d, -doubt);
  return first_lane(from, caps.size(), [&](int i) HWY_ATTR {
    const Doubles c = hn::LoadU(d, caps[3] + i);
    const Doubles of_a = hn::Sub(dot_lanes(caps, i, ax, ay, az), c), of_b = hn::Sub(dot_lanes(caps, i, bx, by, bz), c);
    return hn::Or(hn::Ge(of_a, below), hn::Ge(of_b, below));
  });
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(unclear_on_target);
HWY_EXPORT(widest_on_target);
HWY_EXPORT(halves_on_target);
HWY_EXPORT(holding_on_target);

namespace measure {
namespace {

constexpr std::size_t kPadding = 8;  // the lanes of the widest vector
constexpr CapNumbers kNoPoints{{0, 0, 0}, 2, 0};

}  // namespace

void CapArrays::clear(std::size_t count) {
  size_ = 0;
  const double none[5] = {0, 0, 0, kNoPoints.c, kNoPoints.s};
  for (std::size_t k = 0; k < 5; ++k) numbers_[k].assign(count + kPadding, none[k]);
}

void CapArrays::push(const CapNumbers& cap) {
  const double numbers[5] = {cap.axis.x, cap.axis.y, cap.axis.z, cap.c, cap.s};
  for (std::size_t k = 0; k < 5; ++k) numbers_[k][static_cast<std::size_t>(size_)] = numbers[k];
  ++size_;
}

void CapArrays::erase(int index) {
  const double none[5] = {0, 0, 0, kNoPoints.c, kNoPoints.s};
  for (std::size_t k = 0; k < 5; ++k) numbers_[k][static_cast<std::size_t>(index)] = none[k];
}

int first_unclear(const CapArrays& caps, int from, const CapNumbers& cap, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(unclear_on_target)(caps, from, cap, doubt);
}

int widest_crossing(const CapArrays& caps, const CapNumbers& cap, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(widest_on_target)(caps, cap, doubt);
}

bool hold_halves(const CapArrays& caps, const CapNumbers& cap, double crossing_doubt, Vec3d start, Vec3d middle,
                 Vec3d end, double doubt) {
  ensure_target();
  const Vec3d points[3] = {start, middle, end};
  return HWY_DYNAMIC_DISPATCH(halves_on_target)(caps, cap, crossing_doubt, points, doubt);
}

int first_holding(const CapArrays& caps, int from, Vec3d a, Vec3d b, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(holding_on_target)(caps, from, a, b, doubt);
}

}  // namespace measure
}  // namespace bihive
#endif
