// What a beam leaves to binary64: its winners, a block at a time, and doubtful pairs, collected over many blocks.

#if defined(BIHIVE_WIDE_TRACE_BEAM_WINNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_BEAM_WINNERS_INL_H_
#undef BIHIVE_WIDE_TRACE_BEAM_WINNERS_INL_H_
#else
#define BIHIVE_WIDE_TRACE_BEAM_WINNERS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/wide_tree.h"

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

/// The spheres that won rays of a block, in arrays of their own: lanes say which by `BeamRays::winner`.
class Winners {
 public:
  void clear() { count_ = 0; }

  /// One more, number next(), if it `won`. Call make_room() before.
  HWY_INLINE void add_if(bool won, const WideSpheres& spheres, std::uint32_t slot) {
    x_[count_] = spheres.x[slot];
    y_[count_] = spheres.y[slot];
    z_[count_] = spheres.z[slot];
    r_[count_] = static_cast<float>(spheres.radius(slot));
    id_[count_] = static_cast<std::uint32_t>(spheres.id(slot));
    slot_[count_] = slot;
    count_ += won ? 1 : 0;
  }
  /// The number that the next one gets.
  std::uint32_t next() const { return static_cast<std::uint32_t>(count_); }
  bool none() const { return count_ == 0; }
  std::uint32_t slot(std::uint32_t winner) const { return slot_[winner]; }

  /// Forgets those that have lost all their rays to others, if there is no room for another.
  void make_room(BeamRays& rays) {
    if (HWY_LIKELY(count_ < kRoom)) return;
    std::uint32_t renamed[kRoom];
    std::fill_n(renamed, kRoom, kNoWinner);
    for (std::uint32_t& winner : rays.winner)
      if (winner != kNoWinner) renamed[winner] = 0;
    count_ = 0;
    for (int old = 0; old < kRoom; ++old) {
      if (renamed[old] == kNoWinner) continue;
      x_[count_] = x_[old];
      y_[count_] = y_[old];
      z_[count_] = z_[old];
      r_[count_] = r_[old];
      id_[count_] = id_[old];
      slot_[count_] = slot_[old];
      renamed[old] = static_cast<std::uint32_t>(count_++);
    }
    for (std::uint32_t& winner : rays.winner)
      if (winner != kNoWinner) winner = renamed[winner];
  }

  /// The winners of all lanes. A lane without one gets anything, but the id kNoWinner.
  struct alignas(64) OfLanes {
    float x[kBeamRays], y[kBeamRays], z[kBeamRays], r[kBeamRays];
    std::uint32_t id[kBeamRays];
  };
  HWY_INLINE void spread(const BeamRays& rays, OfLanes& out) const {
    const FloatTag d;
    const WordTag w;
    const hn::RebindToSigned<WordTag> integers;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
      const auto winner = hn::Load(w, rays.winner + lane);
      const auto missed = hn::Eq(winner, hn::Set(w, kNoWinner));
      const auto index = hn::BitCast(integers, hn::IfThenZeroElse(missed, winner));
      const auto pick = [&](auto tag, const auto* values) HWY_ATTR {
        if (HWY_LIKELY(count_ <= kFloatLanes))
          return hn::TableLookupLanes(hn::Load(tag, values), hn::IndicesFromVec(tag, index));
        return hn::GatherIndex(tag, values, index);
      };
      hn::Store(pick(d, x_), d, out.x + lane);
      hn::Store(pick(d, y_), d, out.y + lane);
      hn::Store(pick(d, z_), d, out.z + lane);
      hn::Store(pick(d, r_), d, out.r + lane);
      const auto id = hn::BitCast(w, pick(integers, reinterpret_cast<const std::int32_t*>(id_)));
      hn::Store(hn::IfThenElse(missed, hn::Set(w, kNoWinner), id), w, out.id + lane);
    }
  }

 private:
  static constexpr int kRoom = 96;  // more than lanes
  int count_ = 0;
  alignas(64) float x_[kRoom] = {}, y_[kRoom] = {}, z_[kRoom] = {}, r_[kRoom] = {};
  alignas(64) std::uint32_t id_[kRoom] = {}, slot_[kRoom] = {};
};

/// Writes the hits of a block: near roots of the winners, each of them sure and in its ray's segment, or misses. The
/// operations of sphere_roots() (geometry/sphere.h), in their order.
HWY_INLINE void write_winners(const WideTree& tree, const RaySpan& rays, std::int64_t first, const BeamRays& beam,
                              const Winners& winners, const HitSpan& hits) {
  using Tag = hn::CappedTag<double, 8>;
  const Tag d;
  const hn::Rebind<float, Tag> h;
  const hn::Rebind<std::uint32_t, Tag> words;
  const hn::Rebind<std::int32_t, Tag> integers;
  const hn::Rebind<std::uint64_t, Tag> wide_words;
  const hn::Rebind<std::int64_t, Tag> wide_integers;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  const auto scale = hn::Set(d, tree.scale);
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  Winners::OfLanes spheres;
  winners.spread(beam, spheres);
  for (int lane = 0; lane < beam.count; lane += kLanes) {
    const std::int64_t i = first + lane;
    const int n = std::min(kLanes, beam.count - lane);
    alignas(64) float few[6][kLanes];
    const float* from[6] = {rays.origin[0] + i,    rays.origin[1] + i,    rays.origin[2] + i,
                            rays.direction[0] + i, rays.direction[1] + i, rays.direction[2] + i};
    if (HWY_UNLIKELY(n < kLanes)) {
      for (int a = 0; a < 6; ++a) {
        for (int k = 0; k < kLanes; ++k) few[a][k] = from[a][std::min(k, n - 1)];
        from[a] = few[a];
      }
    }

    // The near root.
    const auto load = [&](const float* values) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(h, values)); };
    const auto dot3 = [](auto ax, auto ay, auto az, auto bx, auto by, auto bz)
                          HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz)); };
    const auto dx = hn::Mul(load(from[3]), scale);
    const auto dy = hn::Mul(load(from[4]), scale);
    const auto dz = hn::Mul(load(from[5]), scale);
    const auto direction_squared = dot3(dx, dy, dz, dx, dy, dz);
    const auto cx = hn::Sub(load(spheres.x + lane), hn::Mul(load(from[0]), scale));
    const auto cy = hn::Sub(load(spheres.y + lane), hn::Mul(load(from[1]), scale));
    const auto cz = hn::Sub(load(spheres.z + lane), hn::Mul(load(from[2]), scale));
    const auto t_closest = hn::Div(dot3(cx, cy, cz, dx, dy, dz), direction_squared);
    const auto px = hn::Sub(cx, hn::Mul(t_closest, dx));
    const auto py = hn::Sub(cy, hn::Mul(t_closest, dy));
    const auto pz = hn::Sub(cz, hn::Mul(t_closest, dz));
    const auto r = load(spheres.r + lane);
    const auto discriminant = hn::Sub(hn::Mul(r, r), dot3(px, py, pz, px, py, pz));
    const auto half_chord = hn::Sqrt(hn::Div(discriminant, direction_squared));
    const auto t_near = hn::Sub(t_closest, half_chord);

    // Or a miss.
    const auto id32 = hn::Load(words, spheres.id + lane);
    const auto missed = hn::PromoteTo(
        wide_integers, hn::BitCast(integers, hn::VecFromMask(words, hn::Eq(id32, hn::Set(words, kNoWinner)))));
    const auto id = hn::Or(hn::BitCast(wide_integers, hn::PromoteTo(wide_words, id32)), missed);
    const auto t = hn::IfThenElse(hn::MaskFromVec(hn::BitCast(d, missed)), infinity, t_near);
    if (HWY_LIKELY(n == kLanes)) {
      hn::StoreU(t, d, hits.t + i);
      hn::StoreU(id, wide_integers, hits.sphere_id + i);
    } else {
      alignas(64) double t_few[kLanes];
      alignas(64) std::int64_t id_few[kLanes];
      hn::Store(t, d, t_few);
      hn::Store(id, wide_integers, id_few);
      std::copy_n(t_few, n, hits.t + i);
      std::copy_n(id_few, n, hits.sphere_id + i);
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_BEAM_WINNERS_INL_H_
