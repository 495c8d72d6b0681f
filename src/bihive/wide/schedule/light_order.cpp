#include "bihive/wide/schedule/light_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/schedule/light_order.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/schedule/counting_sort.h"
#include "bihive/wide/schedule/leftover_rays.h"
#include "bihive/wide/trace/beams.h"
#include "bihive/wide/trace/lists.h"

#ifndef BIHIVE_WIDE_SCHEDULE_LIGHT_ORDER_CPP_ONCE
#define BIHIVE_WIDE_SCHEDULE_LIGHT_ORDER_CPP_ONCE
namespace bihive::kernels {

/// A map of the directions of rays: seen along the axis `main`, those around it lie in the middle.
struct DirectionMap {
  int axis[3];  ///< the two across, and the main one
  float sign;   ///< of the main one
};

/// Of the places in the map.
struct MapBounds {
  float least[2], largest[2];
};

/// The map has 2^bits cells along each side.
constexpr int kMostCellBits = 8;

}  // namespace bihive::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The place of each direction in the map: an octahedron unfolded to a square of side 2. `u` and `v` are written to the
// next whole vector. Returns their bounds.
kernels::MapBounds map_directions(const kernels::DirectionMap& map, const RaySpan& rays, float* u, float* v) {
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
    // What is no direction lies anywhere.
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

// The cell of each place, numbered along a Z-order curve.
void number_cells(const kernels::MapBounds& bounds, int bits, const float* u, const float* v, std::int64_t count,
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

namespace kernels {
namespace {

// Of fewer rays blocks of 64 are hardly ever close. A guess, not measured.
constexpr std::int64_t kFewest = 2048;
// Rays over the cross-section of a leaf: sixteen of them must fit into a part that is kWidestSortedPartInLeaves wide
// (wide/trace/occlusion_beam-inl.h).
constexpr double kFewestPerLeaf = 25;
// Sorted at a time.
constexpr std::int64_t kTile = 262144;
constexpr std::int64_t kRaysPerCell = 4;
constexpr std::int64_t kPadding = 16;

// A tile of rays in the order of their cells. One a thread, kept between calls.
class SortedTile {
 public:
  /// False: the rays are too far apart for beams, and were not sorted.
  bool sort(const WideTree& tree, const RaySpan& rays) {
    const auto n = static_cast<std::size_t>(rays.count);
    u_.resize(n + kPadding);
    v_.resize(n + kPadding);
    const Surroundings seen = look_at(rays);
    const MapBounds bounds = HWY_DYNAMIC_DISPATCH(map_directions)(seen.map, rays, u_.data(), v_.data());
    if (!dense(tree, rays.count, bounds, seen.distance)) return false;

    int bits = 1;
    while (bits < kMostCellBits && (kRaysPerCell << (2 * bits)) < rays.count) ++bits;
    cells_.resize(n + kPadding);
    HWY_DYNAMIC_DISPATCH(number_cells)(bounds, bits, u_.data(), v_.data(), rays.count, cells_.data());

    // Rays that go into a sphere are not for beams: they come last.
    if (rays.inside != nullptr)
      for (std::size_t i = 0; i < n; ++i) cells_[i] |= (rays.inside[i] != 0 ? 1U : 0U) << (2 * bits);

    order_by_cells(cells_.data(), n, std::size_t{2} << (2 * bits), ends_, order_);
    copy(rays);
    return true;
  }

  /// False: beams are of no use here, and nothing is answered.
  bool occluded(const WideTree& tree, std::uint8_t* hidden) {
    hidden_.resize(order_.size());
    if (!occluded_sorted_beams(tree, rays_.span(), true, hidden_.data())) return false;
    for (std::size_t i = 0; i < order_.size(); ++i) hidden[order_[i]] = hidden_[i];
    return true;
  }

 private:
  // Some rays tell the axis that most of the way goes along, and how far it is on average.
  struct Surroundings {
    DirectionMap map;
    double distance;  // the sum along the three axes
  };
  static Surroundings look_at(const RaySpan& rays) {
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

  // Would beams be narrow? The rays cover at most what the map says, and what matters is at most the set.
  static bool dense(const WideTree& tree, std::int64_t count, const MapBounds& bounds, double distance) {
    double area = square(distance * tree.scale);
    for (int k = 0; k < 2; ++k) area *= double(bounds.largest[k]) - double(bounds.least[k]);
    double extent[3];
    for (int axis = 0; axis < 3; ++axis) extent[axis] = double(tree.aabb.hi[axis]) - double(tree.aabb.lo[axis]);
    std::sort(extent, extent + 3);
    area = std::min(area, extent[1] * extent[2]);
    return double(count) * square(double(leaf_extent(tree))) > kFewestPerLeaf * area;
  }
  static double square(double x) { return x * x; }

  void copy(const RaySpan& rays) {
    const std::size_t n = order_.size();
    for (int axis = 0; axis < 3; ++axis) {
      reorder(rays.origin[axis], order_, rays_.origin[axis]);
      reorder(rays.direction[axis], order_, rays_.direction[axis]);
    }
    reorder(rays.leaves, order_, rays_.leaves);
    reorder(rays.t_min, order_, rays_.t_min);
    // Mostly all end at the light, and none goes into a sphere.
    if (all_equal(rays.t_max, n)) {
      rays_.t_max.assign(n, rays.t_max[0]);
    } else {
      reorder(rays.t_max, order_, rays_.t_max);
    }
    reorder(all_equal(rays.inside, n) && rays.inside[0] == 0 ? nullptr : rays.inside, order_, rays_.inside);
  }

  template <class T>
  static bool all_equal(const T* values, std::size_t n) {
    if (values == nullptr) return false;
    for (std::size_t i = 0; i < n; i += 256) {
      int off = 0;
      for (std::size_t k = i; k < std::min(n, i + 256); ++k) off |= values[k] != values[0] ? 1 : 0;
      if (off != 0) return false;
    }
    return true;
  }

  std::vector<float> u_, v_;
  std::vector<std::uint32_t> cells_, ends_, order_;
  RayBatch rays_;
  std::vector<std::uint8_t> hidden_;
};

SortedTile& tile_of_this_thread() {
  thread_local const std::unique_ptr<SortedTile> tile(new SortedTile);
  return *tile;  // NOLINT(clang-analyzer-cplusplus.NewDelete): it takes the tile for freed at once
}

}  // namespace

bool converge(const RaySpan& rays) {
  if (rays.count < kFewest) return false;
  // All within rounding of where the first one leads. A few rays tell almost always.
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

bool occluded_converging(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  ensure_target();
  bool all_sorted = true;
  SortedTile& tile = tile_of_this_thread();
  for (std::int64_t first = 0; first < rays.count; first += kTile) {
    const RaySpan part = rays.part(first, std::min(kTile, rays.count - first));
    if (beams_take(tree, part) && tile.sort(tree, part) && tile.occluded(tree, hidden + first)) continue;
    occluded_lists(tree, part, hidden + first);
    all_sorted = false;
  }
  return all_sorted;
}

}  // namespace kernels
}  // namespace bihive
#endif
