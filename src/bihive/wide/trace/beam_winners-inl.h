// The spheres that are currently the nearest for some ray of a beam, and their hits in binary64, a block at a time.

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

/// Writes misses for `count` rays from `first` on.
inline void write_misses(const HitSpan& hits, std::int64_t first, int count) {
  std::fill_n(hits.t + first, count, std::numeric_limits<double>::infinity());
  std::fill_n(hits.sphere_id + first, count, kNothing);
}

/// The spheres that won rays of a block, in separate arrays: `BeamRays::winner_number` refers to them.
class Winners {
 public:
  void clear() { count_ = 0; }

  /// Adds one, number next(), if it `won`. Call make_room() before.
  HWY_INLINE void add_if(bool won, const WideTree& tree, std::uint32_t slot) {
    const WideSpheres& spheres = tree.spheres;
    x_[count_] = spheres.x[slot];
    y_[count_] = spheres.y[slot];
    z_[count_] = spheres.z[slot];
    if (HWY_UNLIKELY(tree.is_image)) {
      const Vec3f centre = to_float(tree.centre(slot));
      x_[count_] = centre.x;
      y_[count_] = centre.y;
      z_[count_] = centre.z;
    }
    r_[count_] = static_cast<float>(spheres.radius(slot));
    id_[count_] = static_cast<std::uint32_t>(spheres.id(slot));
    slot_[count_] = slot;
    count_ += won ? 1 : 0;
  }
  /// The number that the next one gets.
  std::uint32_t next() const { return static_cast<std::uint32_t>(count_); }
  bool none() const { return count_ == 0; }
  std::uint32_t slot(std::uint32_t number) const { return slot_[number]; }

  /// Forgets those that have lost all their rays to others, if there is no room for another.
  void make_room(BeamRays& rays) {
    if (HWY_LIKELY(count_ < kRoom)) return;
    std::uint32_t renamed[kRoom];
    std::fill_n(renamed, kRoom, kNoWinner);
    for (const std::uint32_t number : rays.winner_number)
      if (number != kNoWinner) renamed[number] = 0;
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
    for (std::uint32_t& number : rays.winner_number)
      if (number != kNoWinner) number = renamed[number];
  }

  /// The winners of all lanes. A lane without one is undefined except for the id kNoWinner.
  struct alignas(64) OfLanes {
    float x[kBeamRays], y[kBeamRays], z[kBeamRays], r[kBeamRays];
    std::uint32_t id[kBeamRays];
  };
  HWY_INLINE void spread(const BeamRays& rays, OfLanes& out) const {
    const FloatTag d;
    const WordTag w;
    const hn::RebindToSigned<WordTag> integers;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
      const auto winner = hn::Load(w, rays.winner_number + lane);
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

namespace beam_winners {

using Doubles = hn::CappedTag<double, 8>;
using Singles = hn::Rebind<float, Doubles>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));

// Near roots of the lanes from `lane` on, whose rays are number i and following of the span; `n` of them exist.
HWY_INLINE hn::Vec<Doubles> near_roots(const RaySpan& rays, double scale, std::int64_t i, int n,
                                       const Winners::OfLanes& spheres, int lane) {
  const Doubles d;
  const Singles h;
  alignas(64) float few[6][kLanes];
  const float* from[6] = {rays.origin[0] + i,    rays.origin[1] + i,    rays.origin[2] + i,
                          rays.direction[0] + i, rays.direction[1] + i, rays.direction[2] + i};
  if (HWY_UNLIKELY(n < kLanes)) {
    for (int a = 0; a < 6; ++a) {
      for (int k = 0; k < kLanes; ++k) few[a][k] = from[a][std::min(k, n - 1)];
      from[a] = few[a];
    }
  }
  const auto stored = hn::Set(d, scale);
  const auto load = [&](const float* values) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(h, values)); };
  const hn::Vec<Doubles> origin[3] = {hn::Mul(load(from[0]), stored), hn::Mul(load(from[1]), stored),
                                      hn::Mul(load(from[2]), stored)};
  const hn::Vec<Doubles> direction[3] = {hn::Mul(load(from[3]), stored), hn::Mul(load(from[4]), stored),
                                         hn::Mul(load(from[5]), stored)};
  const hn::Vec<Doubles> centre[3] = {load(spheres.x + lane), load(spheres.y + lane), load(spheres.z + lane)};
  return sphere_roots_lanes<Doubles>(origin, direction, centre, load(spheres.r + lane)).t_near;
}

}  // namespace beam_winners

/// Writes the hits of a block: near roots of the winners, each of them sure and in its ray's segment, or misses.
HWY_INLINE void write_winners(const WideTree& tree, const RaySpan& rays, std::int64_t first, const BeamRays& beam,
                              const Winners& winners, const HitSpan& hits) {
  using beam_winners::kLanes;
  const beam_winners::Doubles d;
  const hn::Rebind<std::uint32_t, beam_winners::Doubles> words;
  const hn::Rebind<std::int32_t, beam_winners::Doubles> integers;
  const hn::Rebind<std::uint64_t, beam_winners::Doubles> wide_words;
  const hn::Rebind<std::int64_t, beam_winners::Doubles> wide_integers;
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  Winners::OfLanes spheres;
  winners.spread(beam, spheres);
  for (int lane = 0; lane < beam.count; lane += kLanes) {
    const std::int64_t i = first + lane;
    const int n = std::min(kLanes, beam.count - lane);
    const auto t_near = beam_winners::near_roots(rays, tree.scale, i, n, spheres, lane);

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
