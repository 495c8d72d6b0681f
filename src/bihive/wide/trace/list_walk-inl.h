// A tile of rays walks the wide tree as lists: at each node every listed ray tests the sixteen boxes, and each child
// gets the list of the rays that enter it, near to far (from the far end where any hit will do). What a single ray
// loses to branches that nobody can foresee, a list does without branches.

#if defined(BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#undef BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/list_leaf-inl.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/local_rays-inl.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/trace/stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using kernels::CandidateQueue;
using kernels::kNoSlot;
using kernels::ListTile;

/// The walk of one tile of at most kTileRays rays. With kAnyHit `hidden` is written, else `hits`.
template <bool kAnyHit>
class ListWalk {
 public:
  ListWalk(const WideTree& tree, const RaySpan& rays, ListTile& tile, const HitSpan& hits, std::uint8_t* hidden)
      : tree_(tree), rays_(rays), tile_(tile), hits_(hits), hidden_(hidden), bounds_(farthest_origin()) {}

  void run() {
    if (tree_.node_count == 0) return clear_answers();
    set_up();
    for (int octant = 0; octant < 8; ++octant)
      if (octant_count_[octant] > 0) walk_octant(octant);
    test_leaf_pairs();
    finish_candidates();
    if constexpr (!kAnyHit) confirm_winners();
    settle_rivals();
    answer_far_rays();
  }

 private:
  // Shorter lists become streams, and leaves with fewer rays wait for each other.
  static constexpr std::uint32_t kShortList = 16;
  static constexpr std::uint32_t kShortLeafList = 16;

  // ---- Making rays ready ----

  // The largest coordinate of a local origin in the tile.
  float farthest_origin() const {
    const FloatTag d;
    auto largest = hn::Zero(d);
    const std::int64_t whole = rays_.count / kFloatLanes * kFloatLanes;
    float rest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::int64_t i = 0; i < whole; i += kFloatLanes)
        largest = hn::Max(largest, hn::Abs(hn::LoadU(d, rays_.origin[axis] + i)));
      for (std::int64_t i = whole; i < rays_.count; ++i) rest = std::max(rest, std::abs(rays_.origin[axis][i]));
    }
    const double farthest = double(std::max(rest, hn::GetLane(hn::MaxOfLanes(d, largest)))) * tree_.scale;
    if (farthest <= kFarOrigin) return static_cast<float>(farthest) * 1.000001F;

    // Some rays are far, or not valid: look at what becomes of them.
    float moved = 0;
    LocalRays local;
    for (std::int64_t i = 0; i < rays_.count; i += 16) {
      load_rays(i, local);
      moved = std::max(moved, local.farthest_origin);
    }
    return moved;
  }

  void load_rays(std::int64_t first, LocalRays& local) const {
    const std::int64_t left = rays_.count - first;
    if (left >= 16)
      set_up_16(rays_, first, tree_.scale, local);
    else
      set_up_tail(rays_, first, static_cast<int>(left), tree_.scale, local);
  }

  void set_up() {
    LocalRays local;
    tile_.rival_count = 0;
    tile_.pair_count = 0;
    tile_.queue.count = 0;
    const FloatTag d;
    const auto nothing = hn::Set(WordTag(), kNoSlot);
    auto least = in_all(std::numeric_limits<float>::infinity());
    auto most = hn::Neg(least);
    for (std::int64_t first = 0; first < rays_.count; first += 16) {
      const int count = static_cast<int>(std::min<std::int64_t>(16, rays_.count - first));
      load_rays(first, local);
      alignas(64) std::uint32_t outward_id[16];
      set_up_left(first, count, outward_id);
      write_filter_rays(local, outward_id, tile_.rays + first, count);
      std::uint32_t signs[3] = {};
      for (int lane = 0; lane < 16; lane += kFloatLanes) {
        hn::Store(hn::Load(d, local.s_max + lane), d, tile_.s_best + first + lane);
        const auto s_min = hn::Load(d, local.s_min + lane);
        hn::Store(s_min, d, tile_.s_min + first + lane);
        least = hn::Min(least, s_min);
        most = hn::Max(most, s_min);
        hn::Store(nothing, WordTag(), tile_.winner + first + lane);
        for (int axis = 0; axis < 3; ++axis)
          signs[axis] |= mask_bits(hn::Lt(hn::Load(d, local.direction[axis] + lane), hn::Zero(d))) << lane;
      }

      // Hand the rays to the lists of their octants.
      for (int i = 0; i < count; ++i) {
        if ((local.dead >> i & 1) != 0) continue;
        const std::uint32_t octant = (signs[0] >> i & 1) | (signs[1] >> i & 1) << 1 | (signs[2] >> i & 1) << 2;
        tile_.by_octant[octant][octant_count_[octant]++] = static_cast<std::uint32_t>(first + i);
      }
      for (std::uint32_t far = local.far; far != 0; far &= far - 1)
        tile_.far_rays[far_count_++] = static_cast<std::uint32_t>(first + __builtin_ctz(far));
    }
    common_start_ = hn::GetLane(hn::MinOfLanes(d, least)) == hn::GetLane(hn::MaxOfLanes(d, most));
    clear_answers();
  }

  bool some_go_inward() const {
    std::uint8_t any = 0;
    for (std::int64_t i = 0; rays_.inside != nullptr && i < rays_.count; ++i) any |= rays_.inside[i];
    return any != 0;
  }

  // Which sphere does each ray leave? Of rays that leave one of several equal spheres nothing counts as sure.
  HWY_INLINE void set_up_left(std::int64_t first, int count, std::uint32_t outward_id[16]) {
    std::fill_n(outward_id, 16, kNoSphere);
    if (!leaves_some_) return;
    for (int k = 0; k < count; ++k) {
      const std::uint64_t leaves = static_cast<std::uint64_t>(rays_.leaves[first + k]);
      outward_id[k] = leaves < static_cast<std::uint64_t>(tree_.size) ? static_cast<std::uint32_t>(leaves) : kNoSphere;
    }
    if (inward_some_) {
      for (int k = 0; k < count; ++k) {
        const bool inward = rays_.inside[first + k] != 0;
        tile_.inward_id[first + k] = inward ? outward_id[k] : kNoSphere;
        outward_id[k] = inward ? kNoSphere : outward_id[k];
      }
    }
    if (careful_some_)
      for (int k = 0; k < count; ++k)
        tile_.careful[first + k] = LeftSphere(tree_, rays_.leaves[first + k]).is_repeated() ? 1 : 0;
  }

  void clear_answers() {
    if constexpr (kAnyHit) {
      std::fill_n(hidden_, rays_.count, std::uint8_t{0});
    } else {
      std::fill_n(hits_.t, rays_.count, std::numeric_limits<double>::infinity());
      std::fill_n(hits_.sphere_id, rays_.count, kNothing);
    }
  }

  // ---- Walking ----

  // To the closest hit from near to far, to any hit from the far end: docs/decisions/0013-any-hit-from-the-far-end.md.
  void walk_octant(int octant) {
    for (int axis = 0; axis < 3; ++axis) negative_[axis] = (octant >> axis & 1) != 0;
    backwards_ = (octant >= 4) != kAnyHit;
    order_ = octant >= 4 ? 7 - octant : octant;
    tile_.arena.reserve(kArenaBytes);
    walk(0, tile_.by_octant[octant], octant_count_[octant], 0);
  }

  // The working memory of a node with a list of `count` rays, one after the other in the arena.
  struct NodeMemory {
    std::uint16_t* masks;
    // Distances of entry: of the children that are entered, packed, from offsets[i] on for ray i of the list; on
    // targets that test sixteen boxes in several steps of all sixteen.
    float* s_near;
    std::uint32_t* offsets;
    std::uint32_t* places;  // of the list
    std::uint32_t* list;    // of a child
    static std::size_t bytes(std::uint32_t count) {
      const std::size_t padded = (count + 47) / 16 * 16;
      return padded * (2 + 64 + 4 + 4 + 4) + 64;
    }
    NodeMemory(char* at, std::uint32_t count) {
      const std::size_t padded = (count + 47) / 16 * 16;
      s_near = reinterpret_cast<float*>(at);
      places = reinterpret_cast<std::uint32_t*>(at + padded * 64);
      list = places + padded;
      offsets = list + padded;
      masks = reinterpret_cast<std::uint16_t*>(offsets + padded);
    }
  };
  static constexpr std::size_t kArenaBytes = std::size_t{kernels::kTileRays} * 80 * 8;

  // `list` may be read up to 16 entries beyond its end.
  void walk(std::int64_t node_number, const std::uint32_t* list, std::uint32_t count, std::size_t arena_used) {
    const std::size_t bytes = (NodeMemory::bytes(count) + 63) / 64 * 64;
    if (count < kShortList || arena_used + bytes > kArenaBytes) return walk_few(node_number, list, count);
    const WideNode& node = tree_.nodes[node_number];
    const NodeMemory memory(static_cast<char*>(tile_.arena.data()) + arena_used, count);
    const std::uint32_t any = test_boxes(node, list, count, memory);

    // Child after child: list the rays that still want to enter it.
    const std::uint64_t order = node.order[order_];
    const int children = node.child_count;
    for (int k = 0; k < children; ++k) {
      const int place = backwards_ ? children - 1 - k : k;
      const int slot = static_cast<int>(order >> (4 * place) & 15);
      if ((any >> slot & 1) == 0) continue;
      const std::uint32_t entering = list_child(slot, list, count, memory);
      if (entering == 0) continue;
      if (!node.is_leaf(slot))
        walk(node.child_node(slot), memory.list, entering, arena_used + bytes);
      else
        enter_leaf(node.sphere_begin(slot), node.sphere_count(slot), memory.list, entering);
    }
  }

  // Boxes of a node: their sides that rays of the octant come to first and last.
  struct BoxLanes {
    Floats near_x, near_y, near_z, far_x, far_y, far_z;
    HWY_INLINE BoxLanes(const float near[3][kWidth], const float far[3][kWidth], int lane)
        : near_x(hn::Load(FloatTag(), near[0] + lane)),
          near_y(hn::Load(FloatTag(), near[1] + lane)),
          near_z(hn::Load(FloatTag(), near[2] + lane)),
          far_x(hn::Load(FloatTag(), far[0] + lane)),
          far_y(hn::Load(FloatTag(), far[1] + lane)),
          far_z(hn::Load(FloatTag(), far[2] + lane)) {}
  };

  // A ray in all lanes, and where it enters and leaves boxes.
  struct BoxRay {
    Floats ix, iy, iz, x, y, z, s_min, s_best;
    HWY_INLINE BoxRay(const FilterRay& ray, float best)
        : ix(in_all(ray.inverse[0])),
          iy(in_all(ray.inverse[1])),
          iz(in_all(ray.inverse[2])),
          x(in_all(ray.offset[0])),
          y(in_all(ray.offset[1])),
          z(in_all(ray.offset[2])),
          s_min(in_all(ray.s_min)),
          s_best(in_all(best)) {}
    HWY_INLINE Floats entry(const BoxLanes& boxes) const {
      const auto s_x = hn::MulAdd(boxes.near_x, ix, x);
      const auto s_y = hn::MulAdd(boxes.near_y, iy, y);
      const auto s_z = hn::MulAdd(boxes.near_z, iz, z);
      return hn::Max(hn::Max(s_x, s_y), hn::Max(s_z, s_min));
    }
    HWY_INLINE Floats exit(const BoxLanes& boxes) const {
      const auto s_x = hn::MulAdd(boxes.far_x, ix, x);
      const auto s_y = hn::MulAdd(boxes.far_y, iy, y);
      const auto s_z = hn::MulAdd(boxes.far_z, iz, z);
      return hn::Min(hn::Min(s_x, s_y), hn::Min(s_z, s_best));
    }
  };

  // Every listed ray against sixteen boxes: a mask and the distances of entry each. Returns the union of the masks.
  std::uint32_t test_boxes(const WideNode& node, const std::uint32_t* list, std::uint32_t count,
                           const NodeMemory& memory) const {
    const FloatTag d;
    std::uint32_t any = 0;
    std::uint32_t stored = 0;
    // Their planes, moved outward.
    alignas(64) float near[3][kWidth];
    alignas(64) float far[3][kWidth];
    const auto pad = hn::Set(d, bounds_.box_pad);
    for (int axis = 0; axis < 3; ++axis) {
      float* const lower = negative_[axis] ? far[axis] : near[axis];
      float* const upper = negative_[axis] ? near[axis] : far[axis];
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        hn::Store(hn::Sub(hn::Load(d, node.lo[axis] + lane), pad), d, lower + lane);
        hn::Store(hn::Add(hn::Load(d, node.hi[axis] + lane), pad), d, upper + lane);
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(&tile_.rays[list[std::min(i + kAhead, count - 1)]]);
      const BoxRay ray(tile_.rays[list[i]], tile_.s_best[list[i]]);
      std::uint32_t bits = 0;
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        const BoxLanes boxes(near, far, lane);
        const auto s_in = ray.entry(boxes);
        const auto enters = hn::Le(s_in, ray.exit(boxes));
        bits |= mask_bits(enters) << lane;
        // Where any hit is as good as the closest, nobody asks for distances.
        if constexpr (kAnyHit) continue;
        if constexpr (kFloatLanes == kWidth)
          hn::StoreU(compress(s_in, enters), d, memory.s_near + stored);
        else
          hn::Store(s_in, d, memory.s_near + std::size_t{i} * kWidth + lane);
      }
      if constexpr (!kAnyHit && kFloatLanes == kWidth) {
        memory.offsets[i] = stored;
        stored += static_cast<std::uint32_t>(__builtin_popcount(bits));
      }
      memory.masks[i] = static_cast<std::uint16_t>(bits);
      any |= bits;
    }
    // Masks past the end are read too.
    std::fill_n(memory.masks + count, kWidth, std::uint16_t{0});
    return any;
  }

  // The rays of the list that enter a child before their best hit, to memory.list.
  std::uint32_t list_child(int slot, const std::uint32_t* list, std::uint32_t count, const NodeMemory& memory) const {
    const WordTag d;
    const hn::Rebind<std::uint16_t, WordTag> half;
    const auto bit = hn::Set(d, 1u << slot);
    auto places = iota_words(0);
    std::size_t found = 0;
    for (std::uint32_t i = 0; i < count; i += kFloatLanes) {
      const auto masks = hn::PromoteTo(d, hn::LoadU(half, memory.masks + i));
      found += store_compressed(d, places, hn::TestBit(masks, bit), memory.places + found);
      places = hn::Add(places, hn::Set(d, static_cast<std::uint32_t>(kFloatLanes)));
    }
    const unsigned below = (1u << slot) - 1;
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < found; ++k) {
      const std::uint32_t place = memory.places[k];
      const std::uint32_t ray = list[place];
      memory.list[kept] = ray;
      if constexpr (kAnyHit) {
        kept += tile_.s_best[ray] >= -kFarthestEnd ? 1 : 0;
        continue;
      }
      std::size_t at = std::size_t{place} * kWidth + static_cast<std::size_t>(slot);
      if constexpr (kFloatLanes == kWidth)
        at = memory.offsets[place] + static_cast<std::size_t>(__builtin_popcount(memory.masks[place] & below));
      kept += memory.s_near[at] <= tile_.s_best[ray] ? 1 : 0;
    }
    return kept;
  }

  // The rays of a short list from a node on.
  void walk_few(std::int64_t node_number, const std::uint32_t* list, std::uint32_t count) {
    const auto start = [&](std::uint32_t i, SingleRay& ray) HWY_ATTR {
      const std::uint32_t number = list[i];
      ray.local = tile_.rays[number];
      ray.s_best = tile_.s_best[number];
      ray.sure_min = tile_.s_min[number] + bounds_.width;
      ray.e = bounds_.e;
      ray.width = bounds_.width;
      ray.pad_offsets(bounds_.box_pad);
      ray.left_id = ray.local.outward_id;
      ray.inward = inward_some_ && tile_.inward_id[number] != kNoSphere;
      if (ray.inward) ray.left_id = tile_.inward_id[number];
      if (careful_some_ && tile_.careful[number] != 0) ray.sure_min = std::numeric_limits<float>::infinity();
      ray.winner = kNoWinner;
    };
    const auto finish = [&](std::uint32_t i, const SingleRay& ray) HWY_ATTR {
      if (ray.winner == kNoWinner) return;
      const std::uint32_t number = list[i];
      if constexpr (kAnyHit) {
        hide(number);
      } else {
        tile_.winner[number] = ray.winner;
        tile_.s_best[number] = std::min(tile_.s_best[number], ray.s_best);
      }
    };
    walk_stream<kAnyHit>(tree_, node_number, count, stream_rays(tile_.stream), start, finish,
                         [&](std::uint32_t i, std::uint32_t slot) HWY_ATTR { add_rival(list[i], slot); });
  }

  // ---- Leaves ----

  void enter_leaf(std::int64_t begin, std::int64_t spheres, const std::uint32_t* list, std::uint32_t count) {
    for (std::int64_t first = 0; first < spheres; first += kWidth) {
      const auto slot = static_cast<std::uint32_t>(begin + first);
      const auto some = static_cast<std::uint32_t>(std::min<std::int64_t>(spheres - first, kWidth));
      if (count >= kShortLeafList) {
        test_leaf(slot, some, list, count);
        continue;
      }
      for (std::uint32_t i = 0; i < count; ++i) tile_.pairs[tile_.pair_count++] = {list[i], slot, some};
      if (tile_.pair_count >= kernels::kMostLeafPairs - static_cast<int>(kShortLeafList)) test_leaf_pairs();
    }
  }

  void test_leaf_pairs() {
    for (int i = 0; i < tile_.pair_count; ++i) {
      const kernels::LeafPair pair = tile_.pairs[i];
      const LeafAndRays leaf{tree_, tile_, bounds_.e, pair.first, pair.count, &pair.ray, 1};
      if (leaves_some_)
        look_at_pair<true>(leaf);
      else
        look_at_pair<false>(leaf);
      if (HWY_UNLIKELY(tile_.queue.count >= kernels::kQueue)) finish_candidates();
    }
    tile_.pair_count = 0;
    finish_candidates();
  }

  // The first look: up to sixteen spheres against a list of rays.
  void test_leaf(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list, std::uint32_t count) {
    const LeafAndRays leaf{tree_, tile_, bounds_.e, slot, spheres, list, count};
    const auto finish = [this]() HWY_ATTR { finish_candidates(); };
    if (leaves_some_)
      look_at_leaf<true>(leaf, finish);
    else
      look_at_leaf<false>(leaf, finish);
  }

  // The second look, many candidates at a time: is the near root surely in the segment and surely the nearest so far?
  void finish_candidates() {
    CandidateQueue& queue = tile_.queue;
    const FloatTag d;
    const WordTag words;
    const hn::RebindToSigned<WordTag> ints;
    for (int first = 0; first < queue.count; first += kFloatLanes) {
      const auto b = hn::Load(d, queue.b + first);
      const auto dp = hn::Load(d, queue.dp + first);
      const auto r_squared = hn::Load(d, queue.r_squared + first);
      const auto ray = hn::BitCast(ints, hn::Load(words, queue.ray + first));
      const auto exists = hn::FirstN(d, static_cast<std::size_t>(std::min(queue.count - first, kFloatLanes)));
      const auto index = hn::IfThenElseZero(hn::RebindMask(ints, exists), ray);
      const auto s_best = hn::GatherIndex(d, tile_.s_best, index);
      const auto s_min = common_start_ ? in_all(tile_.s_min[0]) : hn::GatherIndex(d, tile_.s_min, index);
      auto sure_min = hn::Add(s_min, hn::Set(d, bounds_.width));
      // Rays that go into the sphere that they leave, and those of which nothing is sure.
      auto inward = hn::MaskFromVec(hn::Zero(d));
      if (inward_some_) {
        const auto slot = hn::BitCast(ints, hn::Load(words, queue.slot + first));
        const auto safe_slot = hn::IfThenElseZero(hn::RebindMask(ints, exists), slot);
        const auto id = hn::And(gather_words(tree_.spheres.word, safe_slot), hn::Set(words, tree_.spheres.id_mask()));
        inward = hn::And(exists, hn::RebindMask(d, hn::Eq(id, gather_words(tile_.inward_id, index))));
      }
      if (careful_some_)
        sure_min = hn::IfThenElse(hn::RebindMask(d, hn::Ne(gather_words(tile_.careful, index), hn::Zero(words))),
                                  hn::Set(d, std::numeric_limits<float>::infinity()), sure_min);
      const auto judged = judge(b, dp, r_squared, s_best, s_min, sure_min, inward, inward, bounds_.e, bounds_.width);
      std::uint32_t bits = mask_bits(hn::And(exists, judged.keep));
      if (bits == 0) continue;
      const std::uint32_t sure_bits = mask_bits(judged.sure);
      alignas(64) float starts[kFloatLanes];
      hn::Store(judged.start, d, starts);
      for (; bits != 0; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        accept(queue.ray[first + k], queue.slot[first + k], starts[k], (sure_bits >> k & 1) != 0);
      }
    }
    queue.count = 0;
  }

  template <class Index>
  static HWY_INLINE auto gather_words(const std::uint32_t* from, Index index) {
    return hn::BitCast(
        WordTag(), hn::GatherIndex(hn::RebindToSigned<WordTag>(), reinterpret_cast<const std::int32_t*>(from), index));
  }

  // A candidate whose root lies at `start` or beyond it; if it is sure, by less than W.
  HWY_INLINE void accept(std::uint32_t ray, std::uint32_t slot, float start, bool sure) {
    float& s_best = tile_.s_best[ray];
    if (start > s_best) return;
    if (sure && start < s_best - 2 * bounds_.width) {
      if constexpr (kAnyHit) {
        hide(ray);
      } else {
        tile_.winner[ray] = slot;
        s_best = start + bounds_.width;
      }
      return;
    }
    add_rival(ray, slot);
  }

  void add_rival(std::uint32_t ray, std::uint32_t slot) {
    if (tile_.rival_count == kernels::kMostRivals) settle_rivals();
    tile_.rivals[tile_.rival_count++] = {ray, slot};
  }

  void hide(std::uint32_t ray) {
    hidden_[ray] = 1;
    tile_.s_best[ray] = -std::numeric_limits<float>::infinity();
  }

  // ---- Binary64 decides ----

  // The winners' t, neighbouring rays at a time. Rivals that were settled before may already be there.
  void confirm_winners() {
    using Tag = hn::CappedTag<double, 8>;
    const Tag d;
    const hn::Rebind<float, Tag> h;
    const hn::Rebind<std::uint32_t, Tag> words;
    const hn::Rebind<std::int32_t, Tag> ints;
    const hn::Rebind<std::uint64_t, Tag> wide;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
    const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    const std::int64_t whole = rays_.count / kLanes * kLanes;
    const WideSpheres& spheres = tree_.spheres;
    for (std::int64_t i = 0; i < whole; i += kLanes) {
      const auto winner = hn::LoadU(words, tile_.winner + i);
      const auto none = hn::Eq(winner, hn::Set(words, kNoSlot));
      if (hn::AllTrue(words, none)) continue;
      const auto slot = hn::BitCast(ints, hn::AndNot(hn::VecFromMask(words, none), winner));
      const auto word =
          hn::BitCast(words, hn::GatherIndex(ints, reinterpret_cast<const std::int32_t*>(spheres.word), slot));
      const auto id = hn::And(word, hn::Set(words, spheres.id_mask()));
      ExactLanes<Tag> lanes;
      const auto scale = hn::Set(d, tree_.scale);
      const float* const centres[3] = {spheres.x, spheres.y, spheres.z};
      for (int axis = 0; axis < 3; ++axis) {
        lanes.origin[axis] = hn::Mul(hn::PromoteTo(d, hn::LoadU(h, rays_.origin[axis] + i)), scale);
        lanes.direction[axis] = hn::Mul(hn::PromoteTo(d, hn::LoadU(h, rays_.direction[axis] + i)), scale);
        lanes.centre[axis] = hn::PromoteTo(d, hn::GatherIndex(h, centres[axis], slot));
      }
      const auto radius_place =
          spheres.has_palette ? hn::BitCast(ints, hn::ShiftRight<WideSpheres::kIdBits>(word)) : slot;
      const float* const radii = spheres.has_palette ? spheres.palette.data() : spheres.r;
      lanes.radius = hn::PromoteTo(d, hn::GatherIndex(h, radii, radius_place));
      lanes.t_min = rays_.t_min != nullptr ? hn::LoadU(d, rays_.t_min + i) : hn::Zero(d);
      lanes.t_max = rays_.t_max != nullptr ? hn::LoadU(d, rays_.t_max + i) : infinity;
      // A winner that the ray leaves is one that it goes into.
      lanes.own = hn::MaskFromVec(hn::Zero(d));
      if (inward_some_)
        lanes.own = hn::RebindMask(
            d, hn::Eq(hn::PromoteTo(wide, id), hn::PromoteTo(wide, hn::LoadU(words, tile_.inward_id + i))));
      lanes.inside = lanes.own;
      const auto t = sphere_hit_lanes(d, lanes);

      if (!settled_early_) {
        const hn::Rebind<std::int64_t, Tag> longs;
        const auto nobody =
            hn::RebindMask(longs, hn::Eq(hn::PromoteTo(wide, winner), hn::Set(wide, std::uint64_t{kNoSlot})));
        hn::StoreU(hn::IfThenElse(hn::RebindMask(d, nobody), infinity, t), d, hits_.t + i);
        hn::StoreU(hn::IfThenElse(nobody, hn::Set(longs, kNothing), hn::BitCast(longs, hn::PromoteTo(wide, id))), longs,
                   hits_.sphere_id + i);
        continue;
      }
      alignas(64) double exact[kLanes];
      alignas(64) std::uint32_t ids[kLanes];
      hn::Store(t, d, exact);
      hn::Store(id, words, ids);
      for (int k = 0; k < kLanes; ++k)
        if (tile_.winner[i + k] != kNoSlot) keep_nearer(i + k, exact[k], ids[k]);
    }
    double t[kExactPairs];
    for (std::int64_t i = whole; i < rays_.count; ++i) {
      if (tile_.winner[i] == kNoSlot) continue;
      const Pair pair{static_cast<std::uint32_t>(i), tile_.winner[i]};
      exact_hits(tree_, rays_, &pair, 1, t);
      keep_nearer(i, t[0], spheres.id(pair.slot));
    }
  }

  void settle_rivals() {
    settled_early_ = settled_early_ || tile_.rival_count > 0;
    double t[kExactPairs];
    Pair pairs[kExactPairs];
    for (int first = 0; first < tile_.rival_count; first += kExactPairs) {
      const int count = std::min(kExactPairs, tile_.rival_count - first);
      for (int k = 0; k < count; ++k) pairs[k] = {tile_.rivals[first + k].ray, tile_.rivals[first + k].slot};
      exact_hits(tree_, rays_, pairs, count, t);
      for (int k = 0; k < count; ++k) {
        if (t[k] == std::numeric_limits<double>::infinity()) continue;
        if constexpr (kAnyHit) {
          hide(pairs[k].ray);
        } else {
          keep_nearer(pairs[k].ray, t[k], tree_.spheres.id(pairs[k].slot));
          float& s_best = tile_.s_best[pairs[k].ray];
          s_best = std::min(s_best, upper_bound_of(pairs[k].ray, t[k]));
        }
      }
    }
    tile_.rival_count = 0;
  }

  HWY_INLINE void keep_nearer(std::int64_t ray, double t, std::int64_t id) {
    Hit best{hits_.t[ray], hits_.sphere_id[ray]};
    best.keep_nearer(t, id);
    hits_.t[ray] = best.t;
    hits_.sphere_id[ray] = best.sphere_id;
  }

  // A t of a ray as a distance along its local ray, rounded up.
  float upper_bound_of(std::uint32_t number, double t) const {
    SingleRay ray;
    double length = 0;
    double shift = 0;
    if (!set_up_single(ScaledRay(rays_.at(number), tree_.scale), ray, length, shift)) return kFarthestEnd;
    return upper_distance(t, length, shift);
  }

  void answer_far_rays() {
    for (std::uint32_t k = 0; k < far_count_; ++k) {
      const std::uint32_t i = tile_.far_rays[k];
      const Ray ray = rays_.at(i);
      const Hit hit = traverse_scalar<kAnyHit>(tree_, ScaledRay(ray, tree_.scale), LeftSphere(tree_, ray.leaves));
      if constexpr (kAnyHit) {
        hidden_[i] = hit.found() ? 1 : 0;
      } else {
        hits_.t[i] = hit.t;
        hits_.sphere_id[i] = hit.sphere_id;
      }
    }
  }

  const WideTree& tree_;
  const RaySpan& rays_;
  ListTile& tile_;
  HitSpan hits_;
  std::uint8_t* hidden_;
  FilterBounds bounds_;
  std::uint32_t octant_count_[8] = {};
  std::uint32_t far_count_ = 0;
  const bool leaves_some_ = rays_.leaves != nullptr;                   // some ray may leave a sphere
  const bool inward_some_ = leaves_some_ && some_go_inward();          // inward_id of the tile is filled
  const bool careful_some_ = leaves_some_ && !tree_.repeated.empty();  // careful of the tile is filled
  bool common_start_ = false;                                          // all rays have the same s_min
  bool settled_early_ = false;  // answers may hold rivals before the winners are confirmed
  bool negative_[3] = {};
  bool backwards_ = false;
  int order_ = 0;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
