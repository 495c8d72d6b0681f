#include "bihive/wide/schedule/cell_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "bihive/wide/schedule/counting_sort.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/lists.h"

namespace bihive::kernels {
namespace {

// With fewer sorting took as long as it saved (docs/performance.md, "What was tried").
constexpr std::int64_t kFewestRays = 65536;
constexpr std::int64_t kFewestSpheres = 65536;
// So many neighbours are looked at, and this share of them must be that far apart. All random rays are; of the third
// mirrored rays of the benchmark's large scenes 0.3 to 0.8.
constexpr std::int64_t kLooks = 256;
constexpr double kScatteredShare = 0.9;
constexpr double kFarInExtents = 1.0 / 16;
// In each octant, a cell of the grid over the spheres has so many rays on average.
constexpr std::int64_t kRaysPerCell = 32;

double largest_extent(const Aabb& box) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, double(box.hi[axis]) - double(box.lo[axis]));
  return largest;
}

// Rays in the order of their cells. One a thread, kept between calls.
class SortedRays {
 public:
  void sort(const WideTree& tree, const RaySpan& rays) {
    const int bits = bits_for(rays.count);
    number_cells(tree, rays, bits);
    order_by_cells(cells_.data(), cells_.size(), std::size_t{8} << (3 * bits), ends_, order_);
    for (int axis = 0; axis < 3; ++axis) {
      reorder(rays.origin[axis], order_, rays_.origin[axis]);
      reorder(rays.direction[axis], order_, rays_.direction[axis]);
    }
    reorder(rays.t_min, order_, rays_.t_min);
    reorder(rays.t_max, order_, rays_.t_max);
    reorder(rays.leaves, order_, rays_.leaves);
    reorder(rays.inside, order_, rays_.inside);
  }

  void closest_hits(const WideTree& tree, const HitSpan& hits) {
    hits_.resize(kTileRays);
    const HitSpan found = hits_.span();
    in_tiles([&](const RaySpan& rays, const std::uint32_t* order) {
      closest_hits_lists(tree, rays, found);
      for (std::int64_t i = 0; i < rays.count; ++i) {
        hits.t[order[i]] = found.t[i];
        hits.sphere_id[order[i]] = found.sphere_id[i];
      }
    });
  }

  void occluded(const WideTree& tree, std::uint8_t* hidden) {
    hidden_.resize(kTileRays);
    in_tiles([&](const RaySpan& rays, const std::uint32_t* order) {
      occluded_lists(tree, rays, hidden_.data());
      for (std::int64_t i = 0; i < rays.count; ++i) hidden[order[i]] = hidden_[static_cast<std::size_t>(i)];
    });
  }

 private:
  static int bits_for(std::int64_t count) {
    int bits = 0;
    while ((8 * kRaysPerCell) << (3 * (bits + 1)) <= count) ++bits;
    return bits;
  }

  // The octant of the direction above the origin's place in a grid over the spheres, along a Z-order curve.
  void number_cells(const WideTree& tree, const RaySpan& rays, int bits) {
    const auto side = static_cast<float>(1 << bits);
    float scale[3], shift[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double low = double(tree.aabb.lo[axis]);
      const double cells = double(side) / std::max(double(tree.aabb.hi[axis]) - low, 1e-20);
      scale[axis] = static_cast<float>(std::min(tree.scale * cells, double(std::numeric_limits<float>::max())));
      shift[axis] = static_cast<float>(low * cells);
    }
    const auto place = [&](std::size_t i, int axis) {
      const float x = rays.origin[axis][i] * scale[axis] - shift[axis];
      const float above = x > 0 ? x : 0;  // 0 if it is not a number
      // The bits of the place, each three from the next.
      auto k = static_cast<std::uint32_t>(static_cast<std::int32_t>(above < side - 1 ? above : side - 1));
      k = (k | k << 8) & 0x0000F00FU;
      k = (k | k << 4) & 0x000C30C3U;
      k = (k | k << 2) & 0x00249249U;
      return k << axis;
    };
    cells_.resize(static_cast<std::size_t>(rays.count));
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      std::uint32_t octant = 0;
      for (int axis = 0; axis < 3; ++axis) octant |= (rays.direction[axis][i] < 0 ? 1U : 0U) << axis;
      cells_[i] = octant << (3 * bits) | place(i, 0) | place(i, 1) | place(i, 2);
    }
  }

  // Hits go back to their places while they are in the cache.
  template <class Body>
  void in_tiles(const Body& body) const {
    const RaySpan rays = rays_.span();
    for (std::int64_t first = 0; first < rays.count; first += kTileRays)
      body(rays.part(first, std::min<std::int64_t>(kTileRays, rays.count - first)), order_.data() + first);
  }

  std::vector<std::uint32_t> cells_, ends_, order_;
  RayBatch rays_;
  HitBatch hits_;
  std::vector<std::uint8_t> hidden_;
};

SortedRays& sorted_rays_of_this_thread() {
  thread_local const std::unique_ptr<SortedRays> kept(new SortedRays);
  return *kept;  // NOLINT(clang-analyzer-cplusplus.NewDelete): it takes what it points to for freed at once
}

// Calls body(rays, first) with at most at_a_time sorted rays, of which the first is number `first` of the span.
template <class Body>
void sorted(const WideTree& tree, const RaySpan& rays, std::int64_t at_a_time, const Body& body) {
  SortedRays& some = sorted_rays_of_this_thread();
  for (std::int64_t first = 0; first < rays.count; first += at_a_time) {
    some.sort(tree, rays.part(first, std::min(at_a_time, rays.count - first)));
    body(some, first);
  }
}

}  // namespace

bool scattered(const WideTree& tree, const RaySpan& rays) {
  if (rays.count < kFewestRays || tree.size < kFewestSpheres) return false;
  const double far = largest_extent(tree.aabb) * kFarInExtents;
  int looked = 0;
  int far_apart = 0;
  const std::int64_t step = (rays.count / kLooks) | 1;  // odd: rays may come in groups of two, four, ...
  for (std::int64_t i = 0; i + 1 < rays.count; i += step, ++looked) {
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      most = std::max(most, std::abs(double(rays.origin[axis][i + 1]) - double(rays.origin[axis][i])));
    if (most * tree.scale > far) ++far_apart;
  }
  return far_apart >= kScatteredShare * looked;
}

void closest_hits_scattered(const WideTree& tree, const RaySpan& rays, const HitSpan& hits, std::int64_t at_a_time) {
  sorted(tree, rays, at_a_time,
         [&](SortedRays& some, std::int64_t first) { some.closest_hits(tree, hits.part(first)); });
}

void occluded_scattered(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden, std::int64_t at_a_time) {
  sorted(tree, rays, at_a_time, [&](SortedRays& some, std::int64_t first) { some.occluded(tree, hidden + first); });
}

}  // namespace bihive::kernels
