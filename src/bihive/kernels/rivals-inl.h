// What a beam leaves to binary64: its winners, a block at a time, and doubtful pairs, collected over many blocks.

#if defined(BIHIVE_KERNELS_RIVALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_RIVALS_INL_H_
#undef BIHIVE_KERNELS_RIVALS_INL_H_
#else
#define BIHIVE_KERNELS_RIVALS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bihive/kernels/beam_rays-inl.h"
#include "bihive/kernels/exact-inl.h"
#include "bihive/kernels/ray_batch.h"
#include "bihive/kernels/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Pairs of rays and spheres whose order binary32 cannot tell. The hits of their rays must have been written, at least
/// as (inf, kNothing), before a flush.
class Rivals {
 public:
  Rivals(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) : tree_(tree), rays_(rays), hits_(hits) {}

  /// Room for the pairs of one sphere with a beam?
  bool full() const { return count_ > kRoom - kBeamRays; }
  void add(std::int64_t ray, std::uint32_t slot) { pairs_[count_++] = {static_cast<std::uint32_t>(ray), slot}; }

  void flush() {
    double t[kExactPairs];
    for (int first = 0; first < count_; first += kExactPairs) {
      const int n = std::min(kExactPairs, count_ - first);
      exact_hits(tree_, rays_, pairs_ + first, n, t);
      for (int k = 0; k < n; ++k) {
        const Pair& pair = pairs_[first + k];
        Hit best{hits_.t[pair.ray], hits_.sphere_id[pair.ray]};
        best.keep_nearer(t[k], tree_.spheres.id(pair.slot));
        hits_.t[pair.ray] = best.t;
        hits_.sphere_id[pair.ray] = best.sphere_id;
      }
    }
    count_ = 0;
  }

 private:
  static constexpr int kRoom = 512;
  const WideTree& tree_;
  const RaySpan rays_;
  const HitSpan hits_;
  int count_ = 0;
  Pair pairs_[kRoom];
};

/// Writes misses for `count` rays from `first` on.
inline void write_misses(const HitSpan& hits, std::int64_t first, int count) {
  std::fill_n(hits.t + first, count, std::numeric_limits<double>::infinity());
  std::fill_n(hits.sphere_id + first, count, kNothing);
}

/// Writes the hits of a block: near roots of the winners in `slots`, each of them sure and in its ray's segment, or a
/// miss for kNoSlot. The operations of sphere_roots() (geometry/sphere.h), in their order.
HWY_INLINE void write_winners(const WideTree& tree, const RaySpan& rays, std::int64_t first, int count,
                              const std::uint32_t* slots, const HitSpan& hits) {
  using Tag = hn::CappedTag<double, 8>;
  using Half = hn::Rebind<float, Tag>;
  const Tag d;
  const Half h;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  const WideSpheres& spheres = tree.spheres;
  const auto scale = hn::Set(d, tree.scale);
  const double infinity = std::numeric_limits<double>::infinity();
  for (int lane = 0; lane < count; lane += kLanes) {
    const std::int64_t i = first + lane;
    const int n = std::min(kLanes, count - lane);

    // Fetch the spheres. Neighbours mostly hit the same.
    alignas(64) float centre[3][kLanes];
    alignas(64) double radius[kLanes];
    std::int64_t ids[kLanes];
    int found = 0;
    for (int k = 0; k < kLanes; ++k) {
      const bool hit = k < n && slots[lane + k] != kNoSlot;
      const std::int64_t slot = hit ? slots[lane + k] : 0;
      found += hit ? 1 : 0;
      centre[0][k] = spheres.x[slot];
      centre[1][k] = spheres.y[slot];
      centre[2][k] = spheres.z[slot];
      radius[k] = hit ? spheres.radius(slot) : -1;
      ids[k] = hit ? spheres.id(slot) : kNothing;
    }
    if (found == 0) {
      write_misses(hits, i, n);
      continue;
    }

    alignas(64) float few[6][kLanes];
    const float* from[6] = {rays.origin[0] + i,    rays.origin[1] + i,    rays.origin[2] + i,
                            rays.direction[0] + i, rays.direction[1] + i, rays.direction[2] + i};
    if (HWY_UNLIKELY(n < kLanes)) {
      for (int a = 0; a < 6; ++a) {
        for (int k = 0; k < kLanes; ++k) few[a][k] = from[a][std::min(k, n - 1)];
        from[a] = few[a];
      }
    }
    const auto load = [&](const float* values) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(h, values)); };
    const auto dot3 = [](auto ax, auto ay, auto az, auto bx, auto by, auto bz)
                          HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz)); };
    const auto dx = hn::Mul(load(from[3]), scale);
    const auto dy = hn::Mul(load(from[4]), scale);
    const auto dz = hn::Mul(load(from[5]), scale);
    const auto direction_squared = dot3(dx, dy, dz, dx, dy, dz);
    const auto cx = hn::Sub(load(centre[0]), hn::Mul(load(from[0]), scale));
    const auto cy = hn::Sub(load(centre[1]), hn::Mul(load(from[1]), scale));
    const auto cz = hn::Sub(load(centre[2]), hn::Mul(load(from[2]), scale));
    const auto t_closest = hn::Div(dot3(cx, cy, cz, dx, dy, dz), direction_squared);
    const auto px = hn::Sub(cx, hn::Mul(t_closest, dx));
    const auto py = hn::Sub(cy, hn::Mul(t_closest, dy));
    const auto pz = hn::Sub(cz, hn::Mul(t_closest, dz));
    const auto r = hn::Load(d, radius);
    const auto discriminant = hn::Sub(hn::Mul(r, r), dot3(px, py, pz, px, py, pz));
    const auto half_chord = hn::Sqrt(hn::Div(discriminant, direction_squared));
    const auto t_near = hn::Sub(t_closest, half_chord);
    const auto t = hn::IfThenElse(hn::Gt(r, hn::Zero(d)), t_near, hn::Set(d, infinity));
    if (HWY_LIKELY(n == kLanes)) {
      hn::StoreU(t, d, hits.t + i);
    } else {
      alignas(64) double values[kLanes];
      hn::Store(t, d, values);
      std::copy_n(values, n, hits.t + i);
    }
    std::copy_n(ids, n, hits.sphere_id + i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_RIVALS_INL_H_
