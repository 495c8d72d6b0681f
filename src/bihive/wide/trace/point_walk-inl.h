// Point query traversal: boxes and spheres in binary64, a vector at a time, near children first.

#if defined(BIHIVE_WIDE_TRACE_POINT_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_POINT_WALK_INL_H_
#undef BIHIVE_WIDE_TRACE_POINT_WALK_INL_H_
#else
#define BIHIVE_WIDE_TRACE_POINT_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/simd/lanes-inl.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/wide/trace/points.h"
#include "bihive/wide/tree/radii-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The query point, and facts about the tree. Or a box of query points, for the spheres near any of them: gather(),
/// then test_candidates() for each.
class PointWalk {
 public:
  PointWalk(const WideTree& tree, const wide::PointQuestion& question)
      : tree_(tree), question_(question), lo_in_tree_(question.point - question.shift) {
    // The nodes of an image are where the tree has them.
    if (tree.is_image) lo_in_tree_ = lo_in_tree_ - tree.shift;
    hi_in_tree_ = lo_in_tree_;
    const auto largest = [](Vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    double farthest = largest(lo_in_tree_) + 2.0;
    if (question.shift != Vec3d{}) farthest += largest(question.point) + largest(question.shift);
    pad_ = (tree.is_image ? 0x1p-23 : 0x1p-24) + 0x1p-46 * farthest;
    // A lower bound of all radii.
    const WideSpheres& spheres = tree.spheres;
    if (spheres.has_palette && spheres.palette_size < 32)
      least_radius_ = double(*std::min_element(spheres.palette.data(), spheres.palette.data() + spheres.palette_size));
  }

  /// The box of the points about which `question` will ask in turn: centres of the tree's spheres, which is no image.
  void set_box(Vec3d lo, Vec3d hi) {
    lo_in_tree_ = lo;
    hi_in_tree_ = hi;
  }

  /// Calls visit(first, count) for the leaves that may have spheres within `limit` of the box.
  template <class Visit>
  HWY_INLINE void each_leaf(double limit, const Visit& visit) const {
    std::int64_t waiting[kMostLevels * kWidth];  // NOLINT: written before read
    int waiting_count = 0;
    const double largest_key = key_of(limit);
    waiting[waiting_count++] = 0;
    while (waiting_count > 0) {
      const WideNode& node = tree_.nodes[waiting[--waiting_count]];
      alignas(64) double keys[kWidth];
      find_keys(node, keys);
      for (int slot = 0; slot < node.child_count; ++slot) {
        if (keys[slot] > largest_key) continue;
        if (node.is_leaf(slot))
          visit(node.sphere_begin(slot), node.sphere_count(slot));
        else
          waiting[waiting_count++] = node.child_node(slot);
      }
    }
  }

  /// Spheres in rows of kWidth, the last one padded.
  struct Candidates {
    std::vector<float> x, y, z, r;
    std::vector<std::int64_t> id;
    std::size_t count = 0;

    void make_room(std::size_t spheres) {
      if (id.size() >= spheres) return;
      for (std::vector<float>* column : {&x, &y, &z, &r}) column->resize(2 * spheres);
      id.resize(2 * spheres);
    }
  };

  /// The spheres within `limit` of the box, as far as the mask lets them count, and few others.
  HWY_INLINE void gather(double limit, Candidates& near) const {
    near.count = 0;
    const Tag d;
    const Half half;
    const WideSpheres& spheres = tree_.spheres;
    const bool to_surface = question_.to == DistanceTo::surface;
    each_leaf(limit, [&](std::int64_t first, std::int64_t count) HWY_ATTR {
      for (std::int64_t begin = first; begin < first + count; begin += kWidth) {
        near.make_room(near.count + 2 * kWidth);
        alignas(64) float radii[kWidth];
        for (int i = 0; i < kWidth; i += kFloatLanes) hn::Store(load_radii(spheres, begin + i), FloatTag(), radii + i);
        alignas(64) double beyond[kWidth];
        for (int i = 0; i < kWidth; i += kLanes) {
          const auto outside = [&](const float* centres, int axis) HWY_ATTR {
            const auto centre = hn::PromoteTo(d, hn::LoadU(half, centres + begin + i));
            const auto below = hn::Sub(hn::Set(d, lo_in_tree_[axis]), centre);
            const auto above = hn::Sub(centre, hn::Set(d, hi_in_tree_[axis]));
            return hn::Max(hn::Max(below, above), hn::Zero(d));
          };
          const auto x = outside(spheres.x, 0);
          const auto y = outside(spheres.y, 1);
          const auto z = outside(spheres.z, 2);
          auto reach = hn::Set(d, limit + pad_);
          if (to_surface) reach = hn::Add(reach, hn::PromoteTo(d, hn::LoadU(half, radii + i)));
          const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
          hn::StoreU(hn::Sub(squared, hn::Mul(reach, hn::Abs(reach))), d, beyond + i);
        }
        const auto here = static_cast<int>(std::min<std::int64_t>(kWidth, first + count - begin));
        for (int i = 0; i < here; ++i) {
          const std::int64_t slot = begin + i, id = spheres.id(slot);
          if (beyond[i] > 0 || (question_.mask != nullptr && question_.mask[id] == 0)) continue;
          near.x[near.count] = spheres.x[slot];
          near.y[near.count] = spheres.y[slot];
          near.z[near.count] = spheres.z[slot];
          near.r[near.count] = radii[i];
          near.id[near.count++] = id;
        }
      }
    });
  }

  /// Calls take(distance, id) for those of them within `limit` of the point.
  template <class Take>
  HWY_INLINE void test_candidates(const Candidates& near, double limit, const Take& take) const {
    for (std::size_t begin = 0; begin < near.count; begin += kWidth) {
      alignas(64) double distances[kWidth];
      find_distances(near.x.data() + begin, near.y.data() + begin, near.z.data() + begin, near.r.data() + begin,
                     distances);
      const std::size_t here = std::min<std::size_t>(kWidth, near.count - begin);
      unsigned within = 0;
      for (int i = 0; i < kWidth; i += kLanes)
        within |= bits_of(hn::Le(hn::Load(Tag(), distances + i), hn::Set(Tag(), limit))) << i;
      for (within &= (1U << here) - 1; within != 0; within &= within - 1) {
        const auto i = static_cast<std::size_t>(__builtin_ctz(within));
        take(distances[i], near.id[begin + i]);
      }
    }
  }

  /// Calls answer.take(distance, id) for spheres, among them every one at a distance of at most answer.limit(), which
  /// may shrink meanwhile.
  template <class Answer>
  HWY_INLINE void run(Answer& answer) const {
    if (tree_.node_count == 0) return;
    // A child of a node. Each level leaves at most 16 waiting.
    struct Waiting {
      double key;
      const WideNode* node;
      std::int64_t slot;
    };
    Waiting waiting[kMostLevels * kWidth];  // NOLINT: written before read
    int waiting_count = 0;
    double largest_key = key_of(answer.limit());
    const WideNode* node = tree_.nodes;
    while (true) {
      // The children wait in order, so that the nearest comes next.
      alignas(64) double keys[kWidth];
      find_keys(*node, keys);
      std::uint8_t order[kWidth];  // NOLINT: written before read
      const int near = std::min(order_keys(keys, largest_key, order), int(node->child_count));
      for (int i = near - 1; i >= 0; --i) waiting[waiting_count++] = {keys[order[i]], node, order[i]};
      // Leaves, up to the next node.
      for (node = nullptr; node == nullptr;) {
        if (waiting_count == 0) return;
        const Waiting& next = waiting[--waiting_count];
        if (next.key > largest_key) continue;
        const auto slot = static_cast<int>(next.slot);
        if (!next.node->is_leaf(slot)) {
          node = tree_.nodes + next.node->child_node(slot);
          continue;
        }
        test_leaf(next.node->sphere_begin(slot), next.node->sphere_count(slot), answer);
        largest_key = key_of(answer.limit());
      }
    }
  }

 private:
  using Tag = hn::CappedTag<double, kMostLanes / 2>;
  using Half = hn::Rebind<float, Tag>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));

  const WideTree& tree_;
  const wide::PointQuestion& question_;
  Vec3d lo_in_tree_, hi_in_tree_;
  double pad_;
  double least_radius_ = 0;

  // Bit i: lane i.
  template <class Mask>
  static HWY_INLINE unsigned bits_of(Mask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return bits[0];
  }

  // The slots by their keys, without a branch, which would often be predicted wrongly. The keys' lowest bits are
  // replaced by the slot, so that all differ: the order is off by as little, which costs next to nothing. Returns how
  // many of the first slots in order to look at: those of all keys that are at most `largest`, and those of keys that
  // are larger by these bits.
  static HWY_INLINE int order_keys(const double keys[kWidth], double largest, std::uint8_t order[kWidth]) {
    const Tag d;
    const hn::RebindToUnsigned<Tag> bits;
    constexpr std::uint64_t kSlots = kWidth - 1;
    // With other bits an infinite key would be no number.
    constexpr double kMostKey = 1e300;
    const auto end = hn::BitCast(bits, hn::Set(d, std::min(largest, kMostKey) + 0.0));
    const auto slots_of_all = hn::Set(bits, kSlots);
    const auto last = hn::BitCast(d, largest < 0 ? hn::AndNot(slots_of_all, end) : hn::Or(end, slots_of_all));
    alignas(64) double different[kWidth];
    std::size_t near = 0;
    for (int i = 0; i < kWidth; i += kLanes) {
      const auto whole = hn::BitCast(bits, hn::Min(hn::Load(d, keys + i), hn::Set(d, kMostKey)));
      const auto slots = hn::Iota(bits, static_cast<std::uint64_t>(i));
      const auto key = hn::BitCast(d, hn::Or(hn::And(whole, hn::Set(bits, ~kSlots)), slots));
      near += hn::CountTrue(d, hn::Le(key, last));
      hn::Store(key, d, different + i);
    }
    alignas(64) double ranks[kWidth];
    const auto one = hn::Set(d, 1.0);
    for (int i = 0; i < kWidth; i += kLanes) {
      const auto key = hn::Load(d, different + i);
      auto rank = hn::Zero(d);
      for (int k = 0; k < kWidth; ++k)
        rank = hn::Add(rank, hn::IfThenElseZero(hn::Lt(hn::Set(d, different[k]), key), one));
      hn::Store(rank, d, ranks + i);
    }
    for (int i = 0; i < kWidth; ++i) order[static_cast<int>(ranks[i])] = static_cast<std::uint8_t>(i);
    return static_cast<int>(near);
  }

  // Squared distances have the same order as distances, and need no root. Negative ones stay unchanged.
  static double key_of_distance(double distance) { return distance > 0 ? distance * distance : distance; }

  // The largest key of a box whose spheres may be within the limit.
  double key_of(double limit) const {
    return key_of_distance(limit + pad_ + (question_.to == DistanceTo::surface ? least_radius_ : 0));
  }

  // The key of the distance from the point or the box to the box of each child, which is made smaller all around by the
  // least radius: every centre lies in there. Inside, the distance is that of the nearest side, below 0.
  HWY_INLINE void find_keys(const WideNode& node, double keys[kWidth]) const {
    const Tag d;
    const Half half;
    const auto zero = hn::Zero(d);
    const auto inset = hn::Set(d, least_radius_);
    for (int i = 0; i < kWidth; i += kLanes) {
      const auto outside = [&](int axis) HWY_ATTR {
        const auto lo = hn::PromoteTo(d, hn::LoadU(half, node.lo[axis] + i));
        const auto hi = hn::PromoteTo(d, hn::LoadU(half, node.hi[axis] + i));
        const auto below = hn::Sub(lo, hn::Set(d, hi_in_tree_[axis]));
        const auto above = hn::Sub(hn::Set(d, lo_in_tree_[axis]), hi);
        return hn::Add(hn::Max(below, above), inset);
      };
      const auto x = outside(0);
      const auto y = outside(1);
      const auto z = outside(2);
      const auto most = hn::Max(hn::Max(x, y), z);
      const auto px = hn::Max(x, zero);
      const auto py = hn::Max(y, zero);
      const auto pz = hn::Max(z, zero);
      const auto squared = hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
      hn::StoreU(hn::IfThenElse(hn::Gt(most, zero), squared, most), d, keys + i);
    }
  }

  // image_distance() of kWidth spheres from `first` on.
  HWY_INLINE void find_distances(std::int64_t first, double distances[kWidth]) const {
    const WideSpheres& spheres = tree_.spheres;
    alignas(64) float radii[kWidth];
    if (question_.to == DistanceTo::surface)
      for (int i = 0; i < kWidth; i += kFloatLanes) hn::Store(load_radii(spheres, first + i), FloatTag(), radii + i);
    find_distances(spheres.x + first, spheres.y + first, spheres.z + first, radii, distances);
  }

  // The same of kWidth spheres anywhere. The radii matter if the distance is to the surface.
  HWY_INLINE void find_distances(const float* centres_x, const float* centres_y, const float* centres_z,
                                 const float* radii, double distances[kWidth]) const {
    const Tag d;
    const Half half;
    for (int i = 0; i < kWidth; i += kLanes) {
      const auto between = [&](const float* centres, int axis) HWY_ATTR {
        const auto own = hn::Sub(hn::PromoteTo(d, hn::LoadU(half, centres + i)), hn::Set(d, question_.point[axis]));
        return hn::Add(own, hn::Set(d, question_.shift[axis]));
      };
      const auto x = between(centres_x, 0);
      const auto y = between(centres_y, 1);
      const auto z = between(centres_z, 2);
      auto distance = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
      if (question_.to == DistanceTo::surface)
        distance = hn::Sub(distance, hn::PromoteTo(d, hn::LoadU(half, radii + i)));
      hn::StoreU(distance, d, distances + i);
    }
  }

  template <class Answer>
  HWY_INLINE void test_leaf(std::int64_t first, std::int64_t count, Answer& answer) const {
    for (std::int64_t begin = first; begin < first + count; begin += kWidth) {
      const auto here = static_cast<int>(std::min<std::int64_t>(kWidth, first + count - begin));
      alignas(64) double distances[kWidth];
      if (!tree_.is_image) {
        find_distances(begin, distances);
      } else {
        for (int i = 0; i < here; ++i)
          distances[i] = image_distance(question_.point, tree_.centre(begin + i), question_.shift,
                                        tree_.spheres.radius(begin + i), question_.to);
      }
      for (int i = 0; i < here; ++i)
        if (distances[i] <= answer.limit()) take(distances[i], tree_.spheres.id(begin + i), answer);
    }
  }

  // The sphere and its duplicates.
  template <class Answer>
  HWY_INLINE void take(double distance, std::int64_t id, Answer& answer) const {
    const std::uint8_t* const mask = question_.mask;
    if (mask == nullptr || mask[id] != 0) answer.take(distance, id);
    const WideTree& tree = tree_.is_image ? *tree_.image_of : tree_;
    if (tree.piles.empty()) return;
    const auto pile = std::lower_bound(tree.piles.begin(), tree.piles.end(), id,
                                       [](const Pile& one, std::int64_t wanted) { return one.id < wanted; });
    if (pile == tree.piles.end() || pile->id != id) return;
    for (std::size_t k = pile->first_other; k < pile->end_of_others; ++k) {
      const std::int64_t other = tree.others_in_piles[k];
      if (mask == nullptr || mask[other] != 0) answer.take(distance, other);
    }
  }
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_POINT_WALK_INL_H_
