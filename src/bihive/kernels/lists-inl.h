// A tile of rays walks the wide tree as lists: at each node every listed ray tests the sixteen boxes, and each child
// gets the list of the rays that enter it, near to far. What a single ray loses to branches that nobody can foresee, a
// list does without branches.

#if defined(BIHIVE_KERNELS_LISTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_LISTS_INL_H_
#undef BIHIVE_KERNELS_LISTS_INL_H_
#else
#define BIHIVE_KERNELS_LISTS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/kernels/exact-inl.h"
#include "bihive/kernels/filter.h"
#include "bihive/kernels/lanes-inl.h"
#include "bihive/kernels/list_tile.h"
#include "bihive/kernels/ray_setup-inl.h"
#include "bihive/kernels/scalar_traversal.h"
#include "bihive/kernels/single-inl.h"

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
  // Lists of fewer rays are walked ray by ray, and leaves with fewer wait for each other.
  static constexpr std::uint32_t kShortList = 4;
  static constexpr std::uint32_t kAhead = 8;  // rays to fetch before they are needed
  static constexpr std::uint32_t kShortLeafList = 16;
  // Where sixteen boxes or spheres take several steps, what costs more: to spread a ray to all lanes once more for each
  // step, or to load the boxes or spheres again for each ray?
  static constexpr bool kRayAfterRay = kFloatLanes == 4;

  using Floats = hn::VFromD<FloatTag>;
  static HWY_INLINE Floats in_all(float value) { return hn::Set(FloatTag(), value); }

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
    for (std::int64_t first = 0; first < rays_.count; first += 16) {
      const int count = static_cast<int>(std::min<std::int64_t>(16, rays_.count - first));
      load_rays(first, local);
      write_filter_rays(local, bounds_.box_pad, tile_.rays + first, count);
      std::uint32_t signs[3] = {};
      for (int lane = 0; lane < 16; lane += kFloatLanes) {
        hn::Store(hn::Load(d, local.s_max + lane), d, tile_.s_best + first + lane);
        hn::Store(hn::Load(d, local.s_min + lane), d, tile_.s_min + first + lane);
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
    if (rays_.leaves != nullptr) set_up_left();
    clear_answers();
  }

  // Which sphere does each ray leave? Of rays that leave one of several equal spheres nothing counts as sure.
  void set_up_left() {
    leaves_some_ = true;
    inward_some_ = rays_.inside != nullptr;
    careful_some_ = !tree_.repeated.empty();
    for (std::int64_t i = 0; i < rays_.count; ++i) {
      const std::int64_t leaves = rays_.leaves[i];
      const std::uint32_t id = leaves >= 0 && leaves < tree_.size ? static_cast<std::uint32_t>(leaves) : kNoSlot;
      const bool inward = inward_some_ && rays_.inside[i] != 0;
      tile_.outward_id[i] = inward ? kNoSlot : id;
      if (inward_some_) tile_.inward_id[i] = inward ? id : kNoSlot;
      if (careful_some_) tile_.careful[i] = LeftSphere(tree_, leaves).is_repeated() ? 1 : 0;
    }
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

  void walk_octant(int octant) {
    for (int axis = 0; axis < 3; ++axis) negative_[axis] = (octant >> axis & 1) != 0;
    backwards_ = octant >= 4;
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
    if (count < kShortList || arena_used + bytes > kArenaBytes) {
      for (std::uint32_t i = 0; i < count; ++i) walk_alone(node_number, list[i]);
      return;
    }
    const WideNode& node = tree_.nodes[node_number];
    const NodeMemory memory(static_cast<char*>(tile_.arena.data()) + arena_used, count);
    const std::uint32_t any = test_boxes(node, list, count, memory);

    // Child after child, near to far: list the rays that still want to enter it.
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
    HWY_INLINE BoxLanes(const float* const near[3], const float* const far[3], int lane)
        : near_x(hn::Load(FloatTag(), near[0] + lane)),
          near_y(hn::Load(FloatTag(), near[1] + lane)),
          near_z(hn::Load(FloatTag(), near[2] + lane)),
          far_x(hn::Load(FloatTag(), far[0] + lane)),
          far_y(hn::Load(FloatTag(), far[1] + lane)),
          far_z(hn::Load(FloatTag(), far[2] + lane)) {}
  };

  // A ray in all lanes, and where it enters and leaves boxes.
  struct BoxRay {
    Floats ix, iy, iz, near_x, near_y, near_z, far_x, far_y, far_z, s_min, s_best;
    HWY_INLINE BoxRay(const FilterRay& ray, float best)
        : ix(in_all(ray.inverse[0])),
          iy(in_all(ray.inverse[1])),
          iz(in_all(ray.inverse[2])),
          near_x(in_all(ray.near_offset[0])),
          near_y(in_all(ray.near_offset[1])),
          near_z(in_all(ray.near_offset[2])),
          far_x(in_all(ray.far_offset[0])),
          far_y(in_all(ray.far_offset[1])),
          far_z(in_all(ray.far_offset[2])),
          s_min(in_all(ray.s_min)),
          s_best(in_all(best)) {}
    HWY_INLINE Floats entry(const BoxLanes& boxes) const {
      const auto x = hn::MulAdd(boxes.near_x, ix, near_x);
      const auto y = hn::MulAdd(boxes.near_y, iy, near_y);
      const auto z = hn::MulAdd(boxes.near_z, iz, near_z);
      return hn::Max(hn::Max(x, y), hn::Max(z, s_min));
    }
    HWY_INLINE Floats exit(const BoxLanes& boxes) const {
      const auto x = hn::MulAdd(boxes.far_x, ix, far_x);
      const auto y = hn::MulAdd(boxes.far_y, iy, far_y);
      const auto z = hn::MulAdd(boxes.far_z, iz, far_z);
      return hn::Min(hn::Min(x, y), hn::Min(z, s_best));
    }
  };

  // Every listed ray against sixteen boxes: a mask and the distances of entry each. Returns the union of the masks.
  std::uint32_t test_boxes(const WideNode& node, const std::uint32_t* list, std::uint32_t count,
                           const NodeMemory& memory) const {
    const FloatTag d;
    std::uint32_t any = 0;
    std::uint32_t stored = 0;
    const float* near[3];
    const float* far[3];
    for (int axis = 0; axis < 3; ++axis) {
      near[axis] = negative_[axis] ? node.hi[axis] : node.lo[axis];
      far[axis] = negative_[axis] ? node.lo[axis] : node.hi[axis];
    }
    if constexpr (kRayAfterRay) {
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t number = list[i];
        const BoxRay ray(tile_.rays[number], tile_.s_best[number]);
        std::uint32_t bits = 0;
        for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
          const BoxLanes boxes(near, far, lane);
          const auto s_in = ray.entry(boxes);
          bits |= mask_bits(hn::Le(s_in, ray.exit(boxes))) << lane;
          if constexpr (!kAnyHit) hn::Store(s_in, d, memory.s_near + std::size_t{i} * kWidth + lane);
        }
        memory.masks[i] = static_cast<std::uint16_t>(bits);
        any |= bits;
      }
    } else {
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        const BoxLanes boxes(near, far, lane);
        for (std::uint32_t i = 0; i < count; ++i) {
          __builtin_prefetch(&tile_.rays[list[std::min(i + kAhead, count - 1)]]);
          const BoxRay ray(tile_.rays[list[i]], tile_.s_best[list[i]]);
          const auto s_in = ray.entry(boxes);
          const auto enters = hn::Le(s_in, ray.exit(boxes));
          const std::uint32_t bits = mask_bits(enters) << lane;
          if constexpr (kAnyHit) {
            // Distances do not matter.
            memory.masks[i] = static_cast<std::uint16_t>(lane == 0 ? bits : memory.masks[i] | bits);
          } else if constexpr (kFloatLanes == kWidth) {
            hn::StoreU(compress(s_in, enters), d, memory.s_near + stored);
            memory.offsets[i] = stored;
            stored += static_cast<std::uint32_t>(__builtin_popcount(bits));
            memory.masks[i] = static_cast<std::uint16_t>(bits);
          } else {
            hn::Store(s_in, d, memory.s_near + std::size_t{i} * kWidth + lane);
            memory.masks[i] = static_cast<std::uint16_t>(lane == 0 ? bits : memory.masks[i] | bits);
          }
          any |= bits;
        }
      }
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

  // One ray from a node on.
  void walk_alone(std::int64_t node_number, std::uint32_t number) {
    SingleRay ray;
    ray.local = tile_.rays[number];
    ray.s_best = tile_.s_best[number];
    ray.sure_min = tile_.s_min[number] + bounds_.width;
    ray.e = bounds_.e;
    ray.width = bounds_.width;
    ray.left_id = leaves_some_ ? tile_.outward_id[number] : kNoSlot;
    ray.inward = inward_some_ && tile_.inward_id[number] != kNoSlot;
    if (ray.inward) ray.left_id = tile_.inward_id[number];
    if (careful_some_ && tile_.careful[number] != 0) ray.sure_min = std::numeric_limits<float>::infinity();
    ray.winner = kNoSlot;
    walk_single<kAnyHit>(tree_, static_cast<std::uint32_t>(node_number), ray, waiting_, [&](std::uint32_t slot) {
      add_rival(number, slot);
      return false;
    });
    if (ray.winner == kNoSlot) return;
    if constexpr (kAnyHit) {
      hide(number);
    } else {
      tile_.winner[number] = ray.winner;
      tile_.s_best[number] = std::min(tile_.s_best[number], ray.s_best);
    }
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
      test_leaf(pair.first, pair.count, &pair.ray, 1);
    }
    tile_.pair_count = 0;
    finish_candidates();
  }

  // The first look: up to sixteen spheres against a list of rays.
  void test_leaf(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list, std::uint32_t count) {
    if (leaves_some_)
      test_leaf_of<true>(slot, spheres, list, count);
    else
      test_leaf_of<false>(slot, spheres, list, count);
  }

  template <bool kLeaves>
  HWY_INLINE void test_leaf_of(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list,
                               std::uint32_t count) {
    if constexpr (kRayAfterRay)
      test_rays_at_leaf<kLeaves>(slot, spheres, list, count);
    else
      test_spheres_of_leaf<kLeaves>(slot, spheres, list, count);
  }

  // How a ray lies to spheres, in units of distance along it.
  struct Meeting {
    Floats b, dp;
  };

  // A ray in all lanes.
  struct LeafRay {
    Floats nx, ny, nz, ox, oy, oz;
    HWY_INLINE explicit LeafRay(const FilterRay& ray)
        : nx(in_all(ray.direction[0])),
          ny(in_all(ray.direction[1])),
          nz(in_all(ray.direction[2])),
          ox(in_all(ray.origin[0])),
          oy(in_all(ray.origin[1])),
          oz(in_all(ray.origin[2])) {}
    HWY_INLINE Meeting meet(Floats x, Floats y, Floats z, Floats r_squared) const {
      const auto cx = hn::Sub(x, ox);
      const auto cy = hn::Sub(y, oy);
      const auto cz = hn::Sub(z, oz);
      const auto b = hn::MulAdd(cz, nz, hn::MulAdd(cy, ny, hn::Mul(cx, nx)));
      const auto px = hn::NegMulAdd(b, nx, cx);
      const auto py = hn::NegMulAdd(b, ny, cy);
      const auto pz = hn::NegMulAdd(b, nz, cz);
      return {b, hn::NegMulAdd(px, px, hn::NegMulAdd(py, py, hn::NegMulAdd(pz, pz, r_squared)))};
    }
  };

  // (r + e)^2 of spheres from `slot` on; lanes past the leaf can never pass.
  HWY_INLINE Floats padded_squares(std::uint32_t slot, std::uint32_t spheres) const {
    const FloatTag d;
    const auto r = hn::Add(load_radii(tree_.spheres, slot), hn::Set(d, bounds_.e));
    return hn::IfThenElse(hn::FirstN(d, spheres), hn::Mul(r, r), hn::Set(d, -1.0F));
  }

  HWY_INLINE auto ids_at(std::uint32_t slot) const {
    const WordTag words;
    return hn::And(hn::LoadU(words, tree_.spheres.word + slot), hn::Set(words, tree_.spheres.id_mask()));
  }

  // A ray after the other against all the spheres.
  template <bool kLeaves>
  HWY_INLINE void test_rays_at_leaf(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list,
                                    std::uint32_t count) {
    const FloatTag d;
    const WordTag words;
    alignas(64) float r_squared[kWidth];
    alignas(64) std::uint32_t ids[kWidth];
    for (std::uint32_t lane = 0; lane < spheres; lane += kFloatLanes) {
      hn::Store(padded_squares(slot + lane, spheres - lane), d, r_squared + lane);
      if constexpr (kLeaves) hn::Store(ids_at(slot + lane), words, ids + lane);
    }
    const float* const x = tree_.spheres.x + slot;
    const float* const y = tree_.spheres.y + slot;
    const float* const z = tree_.spheres.z + slot;
    CandidateQueue& queue = tile_.queue;
    int queued = queue.count;
    alignas(64) float b[kWidth];
    alignas(64) float dp[kWidth];
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t number = list[i];
      const LeafRay ray(tile_.rays[number]);
      std::uint32_t bits = 0;
      for (std::uint32_t lane = 0; lane < spheres; lane += kFloatLanes) {
        const Meeting met = ray.meet(hn::LoadU(d, x + lane), hn::LoadU(d, y + lane), hn::LoadU(d, z + lane),
                                     hn::Load(d, r_squared + lane));
        auto passes = hn::Ge(met.dp, hn::Zero(d));
        // Going outward a ray never meets the sphere that it leaves.
        if constexpr (kLeaves) {
          const auto own = hn::Eq(hn::Load(words, ids + lane), hn::Set(words, tile_.outward_id[number]));
          passes = hn::AndNot(hn::RebindMask(d, own), passes);
        }
        bits |= mask_bits(passes) << lane;
        hn::Store(met.b, d, b + lane);
        hn::Store(met.dp, d, dp + lane);
      }
      for (; bits != 0; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        queue.b[queued] = b[k];
        queue.dp[queued] = dp[k];
        queue.r_squared[queued] = r_squared[k];
        queue.slot[queued] = slot + static_cast<std::uint32_t>(k);
        queue.ray[queued] = number;
        ++queued;
      }
      if (HWY_UNLIKELY(queued >= kernels::kQueue)) {
        queue.count = queued;
        finish_candidates();
        queued = 0;
      }
    }
    queue.count = queued;
  }

  // Some spheres after the others, in registers, against all rays.
  template <bool kLeaves>
  HWY_INLINE void test_spheres_of_leaf(std::uint32_t slot, std::uint32_t spheres, const std::uint32_t* list,
                                       std::uint32_t count) {
    const FloatTag d;
    const WordTag words;
    CandidateQueue& queue = tile_.queue;
    int queued = queue.count;
    for (std::uint32_t lane = 0; lane < spheres; lane += kFloatLanes) {
      const auto x = hn::LoadU(d, tree_.spheres.x + slot + lane);
      const auto y = hn::LoadU(d, tree_.spheres.y + slot + lane);
      const auto z = hn::LoadU(d, tree_.spheres.z + slot + lane);
      const auto r_squared = padded_squares(slot + lane, spheres - lane);
      const auto slots = iota_words(slot + lane);
      const auto ids = ids_at(slot + lane);
      for (std::uint32_t i = 0; i < count; ++i) {
        const LeafRay ray(tile_.rays[list[i]]);
        const auto [b, dp] = ray.meet(x, y, z, r_squared);
        // Without a branch: whether some of many spheres passes cannot be foreseen.
        auto passes = hn::Ge(dp, hn::Zero(d));
        // Going outward a ray never meets the sphere that it leaves.
        if constexpr (kLeaves)
          passes = hn::And(passes, hn::RebindMask(d, hn::Ne(ids, hn::Set(words, tile_.outward_id[list[i]]))));
        const int passing = static_cast<int>(hn::CountTrue(d, passes));
        const auto some_b = compress(b, passes);
        const auto some_dp = compress(dp, passes);
        const auto some_r_squared = compress(r_squared, passes);
        const auto some_slots = compress(slots, hn::RebindMask(words, passes));
        // More than four seldom pass, and short stores are quicker.
        if (HWY_LIKELY(passing <= 4)) {
          store_four(some_b, queue.b + queued);
          store_four(some_dp, queue.dp + queued);
          store_four(some_r_squared, queue.r_squared + queued);
          store_four(some_slots, queue.slot + queued);
          store_four(hn::Set(words, list[i]), queue.ray + queued);
        } else {
          hn::StoreU(some_b, d, queue.b + queued);
          hn::StoreU(some_dp, d, queue.dp + queued);
          hn::StoreU(some_r_squared, d, queue.r_squared + queued);
          hn::StoreU(some_slots, words, queue.slot + queued);
          hn::StoreU(hn::Set(words, list[i]), words, queue.ray + queued);
        }
        queued += passing;
        if (HWY_UNLIKELY(queued >= kernels::kQueue)) {
          queue.count = queued;
          finish_candidates();
          queued = 0;
        }
      }
    }
    queue.count = queued;
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
      const auto s_min = hn::GatherIndex(d, tile_.s_min, index);
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
  WaitingChildren waiting_;
  std::uint32_t octant_count_[8] = {};
  std::uint32_t far_count_ = 0;
  bool leaves_some_ = false;  // what the arrays of the tile that say so hold
  bool inward_some_ = false;
  bool careful_some_ = false;
  bool settled_early_ = false;  // answers may hold rivals before the winners are confirmed
  bool negative_[3] = {};
  bool backwards_ = false;
  int order_ = 0;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_LISTS_INL_H_
