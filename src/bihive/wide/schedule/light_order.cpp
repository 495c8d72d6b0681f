#include "bihive/wide/schedule/light_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/schedule/light_order.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/schedule/counting_sort.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/tree/leaf_extent.h"

#ifndef BIHIVE_WIDE_SCHEDULE_LIGHT_ORDER_CPP_ONCE
#define BIHIVE_WIDE_SCHEDULE_LIGHT_ORDER_CPP_ONCE
namespace bihive::wide {

/// A map of ray directions, centred on the axis `main`.
struct DirectionMap {
  int axis[3];  ///< the two minor ones, and the main one
  float sign;   ///< along the main one
};

/// Bounds of the positions in the map.
struct MapBounds {
  float least[2], largest[2];
};

}  // namespace bihive::wide
#endif

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The position of each direction in the map: an octahedron unfolded to a square of side 2. `u` and `v` are written up
// to the next whole vector. Returns their bounds.
wide::MapBounds map_directions(const wide::DirectionMap& map, const RaySpan& rays, float* u, float* v) {
  const FloatTag d;
  const auto one = hn::Set(d, 1.0F);
  const auto zero = hn::Zero(d);
  const auto sign = hn::Set(d, map.sign);
  auto low_u = one, low_v = one, high_u = hn::Neg(one), high_v = hn::Neg(one);
  for (std::int64_t i = 0; i < rays.count; i += kFloatLanes) {
    alignas(64) float few[3][kFloatLanes] = {};
    const float* from[3];
    const std::int64_t left = rays.count - i;
    for (int k = 0; k < 3; ++k) {
      from[k] = rays.direction[map.axis[k]] + i;
      if (left >= kFloatLanes) continue;
      for (std::int64_t lane = 0; lane < kFloatLanes; ++lane) few[k][lane] = from[k][std::min(lane, left - 1)];
      from[k] = few[k];
    }
    const auto a = hn::LoadU(d, from[0]);
    const auto b = hn::LoadU(d, from[1]);
    const auto w = hn::Mul(sign, hn::LoadU(d, from[2]));
    const auto inverse = hn::Div(one, hn::Add(hn::Add(hn::Abs(a), hn::Abs(b)), hn::Abs(w)));
    auto x = hn::Mul(a, inverse);
    auto y = hn::Mul(b, inverse);
    // Directions against the main one lie in the corners.
    const auto behind = hn::Lt(w, zero);
    const auto corner_x = hn::CopySign(hn::Sub(one, hn::Abs(y)), x);
    const auto corner_y = hn::CopySign(hn::Sub(one, hn::Abs(x)), y);
    x = hn::IfThenElse(behind, corner_x, x);
    y = hn::IfThenElse(behind, corner_y, y);
    // NaN and infinite directions get some position: any will do.
    x = hn::IfThenElse(hn::Le(hn::Abs(x), one), x, zero);
    y = hn::IfThenElse(hn::Le(hn::Abs(y), one), y, zero);
    hn::StoreU(x, d, u + i);
    hn::StoreU(y, d, v + i);
    low_u = hn::Min(low_u, x);
    low_v = hn::Min(low_v, y);
    high_u = hn::Max(high_u, x);
    high_v = hn::Max(high_v, y);
  }
  return {{hn::GetLane(hn::MinOfLanes(d, low_u)), hn::GetLane(hn::MinOfLanes(d, low_v))},
          {hn::GetLane(hn::MaxOfLanes(d, high_u)), hn::GetLane(hn::MaxOfLanes(d, high_v))}};
}

// The cell of each position, numbered along a Z-order curve.
void number_cells(const wide::MapBounds& bounds, int bits, const float* u, const float* v, std::int64_t count,
                  std::uint32_t* cells) {
  const FloatTag d;
  const WordTag w;
  const hn::RebindToSigned<WordTag> ints;
  const auto side = static_cast<float>(1 << bits);
  float scale[2];
  for (int k = 0; k < 2; ++k) scale[k] = side / std::max(bounds.largest[k] - bounds.least[k], 1e-6F);
  const auto spread = [&](auto x) HWY_ATTR {
    x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(w, 0x0F0FU));
    x = hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(w, 0x3333U));
    return hn::And(hn::Or(x, hn::ShiftLeft<1>(x)), hn::Set(w, 0x5555U));
  };
  const auto place = [&](const float* from, int k) HWY_ATTR {
    const auto x = hn::Mul(hn::Sub(hn::LoadU(d, from), hn::Set(d, bounds.least[k])), hn::Set(d, scale[k]));
    const auto whole = hn::ConvertTo(ints, hn::Min(hn::Max(x, hn::Zero(d)), hn::Set(d, side - 1)));
    return spread(hn::BitCast(w, whole));
  };
  for (std::int64_t i = 0; i < count; i += kFloatLanes)
    hn::StoreU(hn::Or(place(u + i, 0), hn::ShiftLeft<1>(place(v + i, 1))), w, cells + i);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(map_directions);
HWY_EXPORT(number_cells);

namespace wide {
namespace {

// Vectors are stored whole.
constexpr std::int64_t kPadding = 16;

// A sample of rays gives the dominant axis, and the mean distance.
struct Surroundings {
  DirectionMap map;
  double distance;  // the sum along the three axes
};

Surroundings look_at(const RaySpan& rays) {
  double sum[3] = {};
  double way = 0;
  const std::int64_t step = std::max<std::int64_t>(1, rays.count / 64);
  int looked = 0;
  for (std::int64_t i = 0; i < rays.count; i += step, ++looked)
    for (int axis = 0; axis < 3; ++axis) {
      const double part = rays.direction[axis][i];
      if (!std::isfinite(part)) continue;
      sum[axis] += part;
      way += std::abs(part);
    }
  int main = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(sum[axis]) > std::abs(sum[main])) main = axis;
  const DirectionMap map{{(main + 1) % 3, (main + 2) % 3, main}, sum[main] < 0 ? -1.0F : 1.0F};
  return {map, way / looked};
}

double square(double x) {
  return x * x;
}

// Would beams be narrow? The map bounds the rays, and the set bounds what they can meet.
bool dense(const WideTree& tree, std::int64_t count, const MapBounds& bounds, double distance) {
  double area = square(distance * tree.scale);
  for (int k = 0; k < 2; ++k) area *= double(bounds.largest[k]) - double(bounds.least[k]);
  double extent[3];
  for (int axis = 0; axis < 3; ++axis) extent[axis] = double(tree.aabb.hi[axis]) - double(tree.aabb.lo[axis]);
  std::sort(extent, extent + 3);
  area = std::min(area, extent[1] * extent[2]);
  return double(count) * square(double(leaf_extent(tree))) > kFewestPerLeaf * area;
}

}  // namespace

bool LightOrder::find(const WideTree& tree, const RaySpan& rays, std::vector<std::uint32_t>& order) {
  ensure_target();
  const auto n = static_cast<std::size_t>(rays.count);
  u_.resize(n + kPadding);
  v_.resize(n + kPadding);
  const Surroundings seen = look_at(rays);
  const MapBounds bounds = HWY_DYNAMIC_DISPATCH(map_directions)(seen.map, rays, u_.data(), v_.data());
  if (!dense(tree, rays.count, bounds, seen.distance)) return false;

  int bits = 1;
  while (bits < kMostCellBits && (kRaysPerLightCell << (2 * bits)) < rays.count) ++bits;
  cells_.resize(n + kPadding);
  HWY_DYNAMIC_DISPATCH(number_cells)(bounds, bits, u_.data(), v_.data(), rays.count, cells_.data());

  // Rays that go into a sphere are not for beams: they come last.
  if (rays.inside != nullptr)
    for (std::size_t i = 0; i < n; ++i) cells_[i] |= (rays.inside[i] != 0 ? 1U : 0U) << (2 * bits);

  order_by_cells(cells_.data(), n, std::size_t{2} << (2 * bits), ends_, order);
  return true;
}

bool converge(const RaySpan& rays) {
  if (rays.count < kFewestToLight) return false;
  // Do all end within rounding of the first one's end? A few rays nearly always decide.
  float point[3], slack[3];
  for (int axis = 0; axis < 3; ++axis) point[axis] = rays.origin[axis][0] + rays.direction[axis][0];
  for (std::int64_t step : {rays.count / 8, std::int64_t{1}}) {
    for (int axis = 0; axis < 3; ++axis) {
      slack[axis] = 0x1p-18F * std::abs(point[axis]);
      int off = 0;
      for (std::int64_t i = 0; i < rays.count; i += step) {
        const float origin = rays.origin[axis][i];
        const float direction = rays.direction[axis][i];
        const float beside = std::abs(origin + direction - point[axis]);
        off += beside <= slack[axis] + 0x1p-18F * (std::abs(origin) + std::abs(direction)) ? 0 : 1;
      }
      if (off > 0) return false;
    }
  }
  return true;
}

}  // namespace wide
}  // namespace bihive
#endif
