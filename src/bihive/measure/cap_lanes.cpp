#include "bihive/measure/cap_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/measure/cap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/simd/wasm_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using measure::ArcPoints;
using measure::CapArrays;
using measure::CapNumbers;

using DoubleTag = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<DoubleTag>;
using DoubleMask = hn::Mask<DoubleTag>;
constexpr int kDoubles = static_cast<int>(hn::MaxLanes(DoubleTag()));

// How often a section of an arc is halved; then it counts as not covered.
constexpr int kMostHalvings = 4;

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
int widest_on_target(const CapArrays& caps, const CapNumbers& cap, double doubt, double* const crossing_caps[4],
                     int& crossing_count) {
  const DoubleTag d;
  const BesideOne one(cap);
  const Doubles above = hn::Set(d, doubt), unit = hn::Set(d, 1);
  const Doubles none = hn::Set(d, std::numeric_limits<double>::infinity());
  constexpr double kFirst[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  Doubles least = none, index = hn::LoadU(d, kFirst), index_of_least = hn::Set(d, caps.size());
  std::size_t count = 0;
  for (int i = 0; i < caps.size(); i += kDoubles) {
    const Doubles x = hn::LoadU(d, caps[0] + i), y = hn::LoadU(d, caps[1] + i), z = hn::LoadU(d, caps[2] + i);
    const Doubles c = hn::LoadU(d, caps[3] + i), s = hn::LoadU(d, caps[4] + i);
    const Doubles g = hn::Add(hn::Add(hn::Mul(x, one.x), hn::Mul(y, one.y)), hn::Mul(z, one.z));
    const Doubles t = hn::Sub(g, hn::Mul(c, one.c)), product = hn::Mul(s, one.s);
    const DoubleMask crosses = hn::Gt(hn::Sub(hn::Mul(product, product), hn::Mul(t, t)), above);
    hn::CompressBlendedStore(x, crosses, d, crossing_caps[0] + count);
    hn::CompressBlendedStore(y, crosses, d, crossing_caps[1] + count);
    hn::CompressBlendedStore(z, crosses, d, crossing_caps[2] + count);
    count += hn::CompressBlendedStore(c, crosses, d, crossing_caps[3] + count);
    const Doubles cosine = hn::Sub(c, hn::Mul(g, one.c));
    const Doubles signed_square =
        hn::Div(hn::Mul(cosine, hn::Abs(cosine)), hn::Mul(hn::Sub(unit, g), hn::Add(unit, g)));
    const DoubleMask better = hn::And(crosses, hn::Lt(signed_square, least));
    least = hn::IfThenElse(better, signed_square, least);
    index_of_least = hn::IfThenElse(better, index, index_of_least);
    index = hn::Add(index, hn::Set(d, kDoubles));
  }
  crossing_count = static_cast<int>(count);
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

bool cover_on_target(const CapArrays& crossing, const CapNumbers& cap, const ArcPoints& arc, double doubt) {
  const DoubleTag d;
  const Vec3d centre = cap.c * cap.axis;
  const Doubles sure = hn::Set(d, doubt);
  struct Section {
    ArcPoints points;
    int halvings;
  };
  std::array<Section, kMostHalvings + 2> left;
  int count = 0;
  left[count++] = {arc, 0};
  while (count > 0) {
    const Section section = left[--count];
    const Vec3d start = centre + section.points.start, middle = centre + section.points.middle,
                end = centre + section.points.end;
    DoubleMask first_half = hn::Gt(sure, sure), second_half = first_half, any_middle = first_half;  // none
    for (int i = 0; i < crossing.size(); i += kDoubles) {
      const Doubles c = hn::Add(hn::LoadU(d, crossing[3] + i), sure);
      const auto held = [&](Vec3d point) HWY_ATTR {
        return hn::Gt(dot_lanes(crossing, i, hn::Set(d, point.x), hn::Set(d, point.y), hn::Set(d, point.z)), c);
      };
      const DoubleMask holds_middle = held(middle);
      any_middle = hn::Or(any_middle, holds_middle);
      first_half = hn::Or(first_half, hn::And(holds_middle, held(start)));
      second_half = hn::Or(second_half, hn::And(holds_middle, held(end)));
    }
    if (hn::AllFalse(d, any_middle)) return false;
    const auto halve = [&](Vec3d from, Vec3d to) {
      const Vec3d sum = from + to;
      const double length2 = dot(sum, sum);
      // Of about half a turn, the middle is not known well.
      if (section.halvings == kMostHalvings || !(length2 > 0.25 * cap.s * cap.s)) return false;
      left[count++] = {{from, (cap.s / std::sqrt(length2)) * sum, to}, section.halvings + 1};
      return true;
    };
    if (hn::AllFalse(d, first_half) && !halve(section.points.start, section.points.middle)) return false;
    if (hn::AllFalse(d, second_half) && !halve(section.points.middle, section.points.end)) return false;
  }
  return true;
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
HWY_EXPORT(cover_on_target);
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

double* CapArrays::write(std::size_t k, std::size_t count) {
  if (numbers_[k].size() < count + kPadding) numbers_[k].resize(count + kPadding);
  return numbers_[k].data();
}

void CapArrays::end_at(int size) {
  size_ = size;
  const double none[4] = {0, 0, 0, kNoPoints.c};
  for (std::size_t k = 0; k < 4; ++k) std::fill_n(numbers_[k].data() + size, kPadding, none[k]);
}

int first_unclear(const CapArrays& caps, int from, const CapNumbers& cap, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(unclear_on_target)(caps, from, cap, doubt);
}

int widest_crossing(const CapArrays& caps, const CapNumbers& cap, double doubt, CapArrays& crossing) {
  ensure_target();
  const auto count = static_cast<std::size_t>(caps.size());
  double* const to[4] = {crossing.write(0, count), crossing.write(1, count), crossing.write(2, count),
                         crossing.write(3, count)};
  int found = 0;
  const int widest = HWY_DYNAMIC_DISPATCH(widest_on_target)(caps, cap, doubt, to, found);
  crossing.end_at(found);
  return widest;
}

bool surely_cover(const CapArrays& crossing, const CapNumbers& cap, const ArcPoints& arc, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(cover_on_target)(crossing, cap, arc, doubt);
}

int first_holding(const CapArrays& caps, int from, Vec3d a, Vec3d b, double doubt) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(holding_on_target)(caps, from, a, b, doubt);
}

}  // namespace measure
}  // namespace bihive
#endif
