// A tile of rays traverses the wide tree as lists: at each node every listed ray tests the sixteen boxes, and each
// child gets the list of the rays that enter it. Children are visited from near to far, for any hit from the far end. A
// single ray loses time to unpredictable branches; a list needs none. For all hits no ray drops out, and binary64
// decides every sphere that a ray may meet.

#if defined(BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#undef BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/box_test-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/list_leaf-inl.h"
#include "bihive/wide/trace/list_rays-inl.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/list_winners-inl.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/trace/sphere_filter-inl.h"
#include "bihive/wide/trace/stream-inl.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The answers, of which a call needs one: the nearest hit of each ray; a byte for each ray; all hits, which are
/// appended in no order.
struct ListAnswer {
  HitSpan hits{};
  std::uint8_t* hidden = nullptr;
  std::vector<RayHit>* found = nullptr;
};

enum class ListSought { closest_hit, any_hit, all_hits };

/// The traversal of one tile of at most kTileRays rays.
template <ListSought kSought>
class ListWalk {
  static constexpr bool kClosest = kSought == ListSought::closest_hit;
  static constexpr bool kAnyHit = kSought == ListSought::any_hit;
  static constexpr bool kAllHits = kSought == ListSought::all_hits;

 public:
  /// tree.node_count > 0.
  ListWalk(const WideTree& tree, const RaySpan& rays, ListTile& tile, const ListAnswer& answer)
      : tree_(tree), rays_(rays), tile_(tile), answer_(answer), ready_(tree, rays, tile) {}

  void run() {
    for (int octant = 0; octant < 8; ++octant)
      if (ready_.octant_count(octant) > 0) walk_octant(octant);
    test_leaf_entries();
    finish_candidates();
    if constexpr (kClosest) confirm_winners(tree_, rays_, tile_, ready_.inward_some(), decided_early_, answer_.hits);
    decide<true>();
    answer_far_rays();
  }

 private:
  // ---- Traversal ----

  // The closest hit is searched for from near to far, any hit from the far end:
  // docs/decisions/0013-any-hit-from-the-far-end.md.
  void walk_octant(int octant) {
    for (int axis = 0; axis < 3; ++axis) negative_[axis] = (octant >> axis & 1) != 0;
    backwards_ = (octant >= 4) != kAnyHit;
    order_ = octant >= 4 ? 7 - octant : octant;
    tile_.arena.reserve(kArenaBytes);
    walk(0, tile_.by_octant[octant], ready_.octant_count(octant), 0);
  }

  // The working memory of a node with a list of `count` rays, one after the other in the arena.
  struct NodeMemory {
    std::uint16_t* masks;
    // Entry distances. With sixteen lanes in a vector: those of the entered children, packed, from offsets[i] on for
    // ray i of the list. Otherwise: those of all sixteen children, ray after ray.
    float* s_near;
    std::uint32_t* offsets;
    std::uint32_t* places;  // ray positions in the list
    std::uint32_t* list;    // a child's list
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
  static constexpr std::size_t kArenaBytes = std::size_t{kTileRays} * 80 * 8;

  // `list` may be read up to 16 entries beyond its end.
  void walk(std::int64_t node_number, const std::uint32_t* list, std::uint32_t count, std::size_t arena_used) {
    const std::size_t bytes = (NodeMemory::bytes(count) + 63) / 64 * 64;
    if (count < kShortList || arena_used + bytes > kArenaBytes) return walk_few(node_number, list, count);
    const WideNode& node = tree_.nodes[node_number];
    const NodeMemory memory(static_cast<char*>(tile_.arena.data()) + arena_used, count);
    const std::uint32_t any = test_boxes(node, list, count, memory);

    // For each child, list the rays that still enter it.
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

  // Every listed ray against sixteen boxes: a mask and the distances of entry each. Returns the union of the masks.
  std::uint32_t test_boxes(const WideNode& node, const std::uint32_t* list, std::uint32_t count,
                           const NodeMemory& memory) const {
    const FloatTag d;
    std::uint32_t any = 0;
    std::uint32_t stored = 0;
    // Their planes, moved outward.
    alignas(64) float near_planes[3][kWidth];
    alignas(64) float far_planes[3][kWidth];
    const float* const near[3] = {near_planes[0], near_planes[1], near_planes[2]};
    const float* const far[3] = {far_planes[0], far_planes[1], far_planes[2]};
    const auto pad = in_all(ready_.bounds().box_pad);
    for (int axis = 0; axis < 3; ++axis) {
      float* const lower = negative_[axis] ? far_planes[axis] : near_planes[axis];
      float* const upper = negative_[axis] ? near_planes[axis] : far_planes[axis];
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        hn::Store(hn::Sub(hn::Load(d, node.lo[axis] + lane), pad), d, lower + lane);
        hn::Store(hn::Add(hn::Load(d, node.hi[axis] + lane), pad), d, upper + lane);
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(&tile_.rays[list[std::min(i + kPrefetchDistance, count - 1)]]);
      const LocalRay& local = tile_.rays[list[i]];
      const BoxRay ray(local, local.offset, local.offset, tile_.s_best[list[i]]);
      std::uint32_t bits = 0;
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        const BoxLanes boxes(near, far, lane);
        const auto s_in = ray.entry(boxes);
        const auto enters = hn::Le(s_in, ray.exit(boxes));
        bits |= mask_bits(enters) << lane;
        // Only the closest hit needs distances.
        if constexpr (!kClosest) continue;
        if constexpr (kFloatLanes == kWidth)
          hn::StoreU(compress(s_in, enters), d, memory.s_near + stored);
        else
          hn::Store(s_in, d, memory.s_near + std::size_t{i} * kWidth + lane);
      }
      if constexpr (kClosest && kFloatLanes == kWidth) {
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

  // The rays of the list that enter a child, of the closest hit before their best one, to memory.list.
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
      if constexpr (!kClosest) {
        kept += kAllHits || tile_.s_best[ray] >= -kFarthestEnd ? 1 : 0;
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
      const FilterBounds& bounds = ready_.bounds();
      ray.local = tile_.rays[number];
      ray.s_best = tile_.s_best[number];
      ray.sure_min = tile_.s_min[number] + bounds.width;
      ray.e = bounds.e;
      ray.width = bounds.width;
      ray.pad_offsets(bounds.box_pad);
      ray.left_id = ray.local.outward_id;
      ray.inward = ready_.inward_some() && tile_.inward_id[number] != kNoSphere;
      if (ray.inward) ray.left_id = tile_.inward_id[number];
      // Nothing is sure: then each sphere that the ray may meet becomes a pair, and no segment becomes shorter.
      if (kAllHits) ray.sure_min = std::numeric_limits<float>::infinity();
      ray.careful = ready_.careful_some() && tile_.careful[number] != 0;
      if (ray.careful)
        for (int axis = 0; axis < 3; ++axis) ray.left_centre[axis] = tile_.left_centre[axis][number];
      ray.winner = kNoSlot;
    };
    const auto finish = [&](std::uint32_t i, const SingleRay& ray) HWY_ATTR {
      if (ray.winner == kNoSlot) return;
      const std::uint32_t number = list[i];
      if constexpr (kAnyHit) {
        hide(number);
      } else {
        tile_.winner[number] = ray.winner;
        tile_.s_best[number] = std::min(tile_.s_best[number], ray.s_best);
      }
    };
    walk_stream<kAnyHit>(tree_, node_number, count, stream_rays(tile_.stream), start, finish,
                         [&](std::uint32_t i, std::uint32_t slot) HWY_ATTR { add_pair(list[i], slot); });
  }

  // ---- Leaves ----

  void enter_leaf(std::int64_t begin, std::int64_t spheres, const std::uint32_t* list, std::uint32_t count) {
    for (std::int64_t first = 0; first < spheres; first += kWidth) {
      const auto slot = static_cast<std::uint32_t>(begin + first);
      const auto some = static_cast<std::uint32_t>(std::min<std::int64_t>(spheres - first, kWidth));
      if (count >= kShortLeafList) {
        look_at_spheres(slot, some, list, count);
        continue;
      }
      if constexpr (kAllHits) fetch_leaf(slot);
      for (std::uint32_t i = 0; i < count; ++i) tile_.leaf_entries[tile_.leaf_entry_count++] = {list[i], slot, some};
      if (tile_.leaf_entry_count >= kMostLeafEntries - static_cast<int>(kShortLeafList)) test_leaf_entries();
    }
  }

  // For all hits most leaves are entered by few rays, and their spheres are not in the cache.
  HWY_INLINE void fetch_leaf(std::uint32_t slot) const {
    const WideSpheres& spheres = tree_.spheres;
    for (const float* const column : {spheres.x + slot, spheres.y + slot, spheres.z + slot}) {
      __builtin_prefetch(column);
      __builtin_prefetch(column + kWidth - 1);
    }
    __builtin_prefetch(spheres.word + slot);
    __builtin_prefetch(spheres.word + slot + kWidth - 1);
    if (spheres.r != nullptr) __builtin_prefetch(spheres.r + slot);
  }

  void test_leaf_entries() {
    for (int i = 0; i < tile_.leaf_entry_count; ++i) {
      const LeafEntry entry = tile_.leaf_entries[i];
      const LeafAndRays leaf{tree_, tile_, ready_.bounds().e, entry.slot, entry.count, &entry.ray, 1};
      if (ready_.leave_some())
        look_at_pair<true>(leaf);
      else
        look_at_pair<false>(leaf);
      if (HWY_UNLIKELY(tile_.queue.count >= kQueue)) finish_candidates();
    }
    tile_.leaf_entry_count = 0;
    finish_candidates();
  }

  // First test: up to sixteen spheres against a list of rays.
  void look_at_spheres(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list, std::uint32_t count) {
    const LeafAndRays leaf{tree_, tile_, ready_.bounds().e, slot, spheres, list, count};
    const auto finish = [this]() HWY_ATTR { finish_candidates(); };
    if (ready_.leave_some())
      look_at_leaf<true>(leaf, finish);
    else
      look_at_leaf<false>(leaf, finish);
  }

  // Second test, many candidates at a time: is the root that counts surely in the segment and surely the nearest of
  // those found? For all hits: may it be in the segment?
  void finish_candidates() {
    CandidateQueue& queue = tile_.queue;
    const FloatTag d;
    for (int first = 0; first < queue.count; first += kFloatLanes) {
      const auto exists = hn::FirstN(d, static_cast<std::size_t>(std::min(queue.count - first, kFloatLanes)));
      const Judged judged = judge_candidates(queue, first, exists);
      std::uint32_t bits = mask_bits(hn::And(exists, judged.keep));
      if (bits == 0) continue;
      if constexpr (kAllHits) {
        for (; bits != 0; bits &= bits - 1) {
          const int k = first + __builtin_ctz(bits);
          add_pair(queue.ray[k], queue.slot[k]);
        }
        continue;
      }
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

  // A vector of candidates; unused lanes are undefined.
  HWY_INLINE Judged judge_candidates(const CandidateQueue& queue, int first, FloatMask exists) const {
    const FloatTag d;
    const WordTag words;
    const hn::RebindToSigned<WordTag> ints;
    const FilterBounds& bounds = ready_.bounds();
    const auto ray = hn::BitCast(ints, hn::Load(words, queue.ray + first));
    const auto index = hn::IfThenElseZero(hn::RebindMask(ints, exists), ray);
    const auto s_best = hn::GatherIndex(d, tile_.s_best, index);
    const auto s_min = ready_.common_start() ? in_all(tile_.s_min[0]) : hn::GatherIndex(d, tile_.s_min, index);
    auto sure_min = hn::Add(s_min, in_all(bounds.width));
    // Rays that go into the sphere on which they start, and those for which nothing is sure.
    auto inward = hn::MaskFromVec(hn::Zero(d));
    if (ready_.inward_some()) {
      const auto slot = hn::BitCast(ints, hn::Load(words, queue.slot + first));
      const auto safe_slot = hn::IfThenElseZero(hn::RebindMask(ints, exists), slot);
      const auto id = hn::And(gather_words(tree_.spheres.word, safe_slot), hn::Set(words, tree_.spheres.id_mask()));
      inward = hn::And(exists, hn::RebindMask(d, hn::Eq(id, gather_words(tile_.inward_id, index))));
    }
    if (ready_.careful_some())
      sure_min = hn::IfThenElse(on_left_centre(queue, first, exists, index),
                                in_all(std::numeric_limits<float>::infinity()), sure_min);
    const Meeting met{hn::Load(d, queue.b + first), hn::Load(d, queue.dp + first)};
    return judge(met, hn::Load(d, queue.r_squared + first), s_best, s_min, sure_min, inward, inward, bounds.e,
                 bounds.width);
  }

  // Candidates around the centre of the sphere that their ray exits, where that sphere has equals: nothing is sure of
  // them.
  template <class Index>
  HWY_INLINE FloatMask on_left_centre(const CandidateQueue& queue, int first, FloatMask exists, Index ray) const {
    const FloatTag d;
    const hn::RebindToSigned<WordTag> ints;
    auto equal = hn::And(exists, hn::RebindMask(d, hn::Ne(gather_words(tile_.careful, ray), hn::Zero(WordTag()))));
    if (hn::AllFalse(d, equal)) return equal;
    const auto slot =
        hn::IfThenElseZero(hn::RebindMask(ints, exists), hn::BitCast(ints, hn::Load(WordTag(), queue.slot + first)));
    const float* const centres[3] = {tree_.spheres.x, tree_.spheres.y, tree_.spheres.z};
    for (int axis = 0; axis < 3; ++axis)
      equal = hn::And(
          equal, hn::Eq(hn::GatherIndex(d, centres[axis], slot), hn::GatherIndex(d, tile_.left_centre[axis], ray)));
    return equal;
  }

  template <class Index>
  static HWY_INLINE auto gather_words(const std::uint32_t* from, Index index) {
    return hn::BitCast(
        WordTag(), hn::GatherIndex(hn::RebindToSigned<WordTag>(), reinterpret_cast<const std::int32_t*>(from), index));
  }

  // Takes a candidate whose root lies at `start` or beyond it; if it is sure, by less than W.
  HWY_INLINE void accept(std::uint32_t ray, std::uint32_t slot, float start, bool sure) {
    float& s_best = tile_.s_best[ray];
    if (start > s_best) return;
    if (sure && start < s_best - 2 * ready_.bounds().width) {
      if constexpr (kAnyHit) {
        hide(ray);
      } else {
        tile_.winner[ray] = slot;
        s_best = start + ready_.bounds().width;
      }
      return;
    }
    if constexpr (kClosest)
      if (sure && HWY_UNLIKELY(some_repeated_) && equals_winner(tree_, slot, tile_.winner[ray])) return;
    add_pair(ray, slot);
  }

  void add_pair(std::uint32_t ray, std::uint32_t slot) {
    if (!tile_.undecided.has_room(1)) decide();
    tile_.undecided.add(ray, slot);
  }

  void hide(std::uint32_t ray) {
    answer_.hidden[ray] = 1;
    tile_.s_best[ray] = -std::numeric_limits<float>::infinity();
  }

  // ---- Binary64 decides ----

  // kAtEnd: no segment needs to become shorter any more.
  template <bool kAtEnd = false>
  void decide() {
    decided_early_ = decided_early_ || !tile_.undecided.empty();
    decide_pairs(tree_, rays_, tile_.undecided, [&](std::uint32_t ray, double t, std::uint32_t slot) HWY_ATTR {
      if constexpr (kAnyHit) hide(ray);
      if constexpr (kAllHits) answer_.found->push_back({std::int64_t{ray}, t, tree_.spheres.id(slot)});
      if constexpr (kClosest) {
        keep_nearer(answer_.hits, ray, t, tree_.spheres.id(slot));
        if constexpr (!kAtEnd) tile_.s_best[ray] = std::min(tile_.s_best[ray], upper_bound_of(ray, t));
      }
    });
  }

  // The distance along the local ray for a t of the ray, rounded up.
  float upper_bound_of(std::uint32_t number, double t) const {
    SingleRay ray;
    double length = 0;
    double shift = 0;
    if (!set_up_single_ray(rays_.at(number), tree_, ray, length, shift)) return kFarthestEnd;
    return upper_distance(t, length, shift);
  }

  void answer_far_rays() {
    for (std::uint32_t k = 0; k < ready_.far_count(); ++k) {
      const std::uint32_t i = tile_.far_rays[k];
      const Ray ray = rays_.at(i);
      if constexpr (kAllHits) {
        for_hits_of_ray(tree_, ray, [&](double t, std::int64_t id) {
          answer_.found->push_back({std::int64_t{i}, t, id});
        });
        continue;
      }
      const Hit hit = walk_scalar<kAnyHit>(tree_, ScaledRay(ray, tree_.scale), LeftSphere(tree_, ray.leaves));
      if constexpr (kAnyHit) answer_.hidden[i] = hit.found() ? 1 : 0;
      if constexpr (kClosest) {
        answer_.hits.t[i] = hit.t;
        answer_.hits.sphere_id[i] = hit.sphere_id;
      }
    }
  }

  const WideTree& tree_;
  const bool some_repeated_ = !tree_.repeated.empty();
  const RaySpan& rays_;
  ListTile& tile_;
  const ListAnswer answer_;
  const ListRays ready_;
  bool decided_early_ = false;  // some undecided pairs, before the winners are confirmed
  bool negative_[3] = {};
  bool backwards_ = false;
  int order_ = 0;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LIST_WALK_INL_H_
