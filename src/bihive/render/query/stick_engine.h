// Sticks (geometry/stick_set.h) beside the spheres between which they are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/render/query/image_ranges.h"
#include "bihive/render/query/ray_engine.h"
#include "bihive/render/query/stick_block.h"
#include "bihive/render/query/stick_tree.h"

namespace bihive {

/// A decorator: adds sticks to an engine of the spheres. They have a tree of their own, up to where the ray meets a
/// sphere; for the copies of a replicated set, one after the other. The scalar traversal takes rays to them, or, beside
/// the engines of vectors, those of stick_tree.h and, for neighbouring rays, stick_block.h.
class StickEngine final : public RayEngine {
 public:
  /// Of all sticks. Spheres and sticks must outlive it. `cuts`: what clips leave of them; null: all. std::bad_alloc:
  /// there is not enough memory. Within a WatchedWork it may throw Cancelled.
  StickEngine(const SphereSet& spheres, const StickSet& sticks, std::shared_ptr<const RayEngine> of_spheres,
              std::shared_ptr<const CutSet> cuts, bool by_vectors)
      : StickEngine(spheres, sticks, all_of(sticks), std::move(of_spheres), std::move(cuts), by_vectors) {}
  /// Of the sticks of these numbers, ascending. Rays may exit the others too.
  StickEngine(const SphereSet& spheres, const StickSet& sticks, std::vector<std::int32_t> numbers,
              std::shared_ptr<const RayEngine> of_spheres, std::shared_ptr<const CutSet> cuts, bool by_vectors)
      : spheres_(spheres),
        sticks_(sticks),
        numbers_(std::move(numbers)),
        engine_of_spheres_(std::move(of_spheres)),
        cuts_(std::move(cuts)),
        by_vectors_(by_vectors) {
    constexpr std::int64_t kSticksOfLeaf = 2;  // a test of a stick costs more than that of a box
    std::vector<Aabb> boxes;
    boxes.reserve(numbers_.size());
    for (const std::int32_t stick : numbers_) boxes.push_back(sticks.stored_box(spheres, stick));
    if (by_vectors)
      wide_tree_ = StickTree(boxes);
    else
      tree_ = build_reference_tree(boxes, {kSticksOfLeaf, kUnlimited});
  }

  Hit closest_hit(const Ray& ray) const override {
    Nearest nearest{*this, false, engine_of_spheres_->closest_hit(of_spheres(ray))};
    traverse_sticks(ray, nearest);
    return nearest.best;
  }
  bool occluded(const Ray& ray) const override {
    return engine_of_spheres_->occluded(of_spheres(ray)) || meets_stick(ray);
  }
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override {
    engine_of_spheres_->closest_hits(of_spheres(rays), order, hits);
    const auto one = [&](std::int64_t i) {
      Nearest nearest{*this, false, {hits.t[i], hits.sphere_id[i]}};
      traverse_sticks(rays.at(i), nearest);
      hits.t[i] = nearest.best.t;
      hits.sphere_id[i] = nearest.best.sphere_id;
    };
    if (!takes_blocks(order)) {
      for (std::int64_t i = 0; i < rays.count; ++i) one(i);
      return;
    }
    Block block(*this, /*any_hit=*/false);
    for (std::int64_t first = 0; first < rays.count; first += StickBlock::kRays) {
      const std::int64_t end = std::min(first + StickBlock::kRays, rays.count);
      block.clear();
      for (std::int64_t i = first; i < end; ++i) block.add(i, rays.at(i), {hits.t[i], hits.sphere_id[i]});
      block.trace([&](std::int64_t i, Hit best) { hits.t[i] = best.t, hits.sphere_id[i] = best.sphere_id; }, one);
    }
  }
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override {
    engine_of_spheres_->occluded(of_spheres(rays), order, is_occluded);
    const auto one = [&](std::int64_t i) { is_occluded[i] = is_occluded[i] != 0 || meets_stick(rays.at(i)) ? 1 : 0; };
    if (!takes_blocks(order)) {
      for (std::int64_t i = 0; i < rays.count; ++i) one(i);
      return;
    }
    Block block(*this, /*any_hit=*/true);
    for (std::int64_t first = 0; first < rays.count; first += StickBlock::kRays) {
      const std::int64_t end = std::min(first + StickBlock::kRays, rays.count);
      block.clear();
      for (std::int64_t i = first; i < end; ++i)
        if (is_occluded[i] == 0) block.add(i, rays.at(i), {});
      block.trace([&](std::int64_t i, Hit best) { is_occluded[i] = best.found() ? 1 : 0; }, one);
    }
  }
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override {
    engine_of_spheres_->all_hits(of_spheres(rays), order, found);
    for (std::int64_t i = 0; i < rays.count; ++i) {
      All all{*this, {i, found}};
      traverse_sticks(rays.at(i), all);
    }
    sort_hits(found);
  }
  /// The rows of the stored spheres are followed by one for each half of a stored stick.
  void optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                      const DepthSums& sums) const override {
    engine_of_spheres_->optical_depths(of_spheres(rays), order, depths, sums);
    static thread_local std::vector<RayHit> found;
    for (std::int64_t i = 0; i < rays.count; ++i) {
      found.clear();
      All all{*this, {i, found}};
      traverse_sticks(rays.at(i), all);
      for (const RayHit& hit : found) {
        const std::int64_t half = (hit.sphere_id - spheres_.total_size()) % (2 * sticks_.size());
        sums.add(i, depths.row(spheres_.size() + half), depths.columns);
      }
    }
  }

 private:
  static std::vector<std::int32_t> all_of(const StickSet& sticks) {
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(sticks.size()));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }

  // The hits of a ray on sticks: the closest one or any, or all of them.
  struct Nearest {
    const StickEngine& engine;
    bool any;
    Hit best;
    StickRay ray{ScaledRay({}, 1)};
    const CutRay* cut = nullptr;  // not null if there are cuts

    bool test(std::int64_t stick) {
      const StickHit hit = engine.hit(ray, cut, stick);
      best.keep_nearer(hit.t, engine.id_of(stick, hit));
      return any && best.found();
    }
    double limit() const { return best.t; }
  };
  struct All {
    const StickEngine& engine;
    AllHits all;
    StickRay ray{ScaledRay({}, 1)};
    const CutRay* cut = nullptr;

    bool test(std::int64_t stick) const {
      const StickHit hit = engine.hit(ray, cut, stick);
      return all.take(hit.t, engine.id_of(stick, hit));
    }
    static double limit() { return AllHits::limit(); }
  };

  StickHit hit(const StickRay& ray, const CutRay* cut, std::int64_t stick) const {
    const Remainder left = cuts_ == nullptr ? Remainder::whole : cuts_->remainder_of_stick(stick);
    if (left == Remainder::whole) {
      const Stick whole = sticks_.stored(spheres_, stick);
      return by_vectors_ && surely_misses(ray.ray, whole) ? StickHit{} : stick_hit(ray, whole);
    }
    if (left == Remainder::nothing) return {};
    const CutStickHit found = cuts_->stick_hit(*cut, ray, stick);
    return {found.hit.t, found.s};
  }
  std::int64_t id_of(std::int64_t stick, const StickHit& hit) const {
    return spheres_.total_size() + half_of(stick, hit);
  }

  // The sticks of one copy of the set.
  template <class Answer>
  struct AnswerOfImage {
    Answer& answer;
    const std::vector<std::int32_t>* numbers;  // of the sticks in the tree
    std::int64_t first;                        // stick of the copy
    bool ended = false;

    bool test(std::int64_t index) {
      ended = answer.test(first + (*numbers)[static_cast<std::size_t>(index)]);
      return ended;
    }
    double limit() const { return answer.limit(); }
  };
  template <class Answer>
  struct EachImage {
    const StickEngine& engine;
    Answer& answer;

    double limit() const { return answer.limit(); }
    bool visit(const ImageRange& image) {
      const SphereSet& spheres = engine.spheres_;
      AnswerOfImage<Answer> of_image{answer, &engine.numbers_,
                                     spheres.images().number(image.first) * engine.sticks_.size()};
      ScaledRay in_tree = answer.ray.ray;
      in_tree.origin = in_tree.origin - spheres.scale() * spheres.images().shift(image.first);
      engine.traverse_tree(in_tree, kPadOfSticks + kPadOfCopies, of_image);
      return of_image.ended;
    }
  };

  // Neighbouring rays of a call, which meet the tree together: the closest hit of each, or any. There are neither
  // copies nor cuts.
  class Block final : public StickBlockTests {
   public:
    Block(const StickEngine& engine, bool any_hit) : engine_(engine), any_hit_(any_hit) {
      rays_.reserve(StickBlock::kRays);
    }

    void clear() { rays_.clear(); }
    /// Ray `number` of the call, and its hit so far. An invalid ray is left out.
    void add(std::int64_t number, const Ray& ray, Hit best) {
      if (!is_valid(ray)) return;
      const std::size_t i = rays_.size();
      rays_.push_back(stick_ray(ray, engine_.spheres_, engine_.sticks_));
      number_[i] = number;
      best_[i] = best;
    }
    /// Calls take(number, hit) for each ray that was traced with others, one(number) for those that have no company.
    template <class Take, class One>
    void trace(const Take& take, const One& one) {
      std::iota(order_, order_ + rays_.size(), std::uint8_t{0});
      trace_part(0, rays_.size(), take, one);
    }

    Stick stick(std::int64_t index) const override {
      return engine_.sticks_.stored(engine_.spheres_, number_of(index));
    }
    void test(std::int64_t index, const Stick& stick, std::uint64_t near, const StickBlockRoots& roots) override {
      for (; near != 0; near &= near - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctzll(near));
        const std::size_t i = order_[first_ + lane];
        const StickHit hit =
            roots.has_side ? stick_hit(rays_[i], stick, roots.of_ray(lane)) : stick_hit(rays_[i], stick);
        best_[i].keep_nearer(hit.t, engine_.id_of(number_of(index), hit));
        if (best_[i].found()) block_.t_end[lane] = any_hit_ ? -std::numeric_limits<double>::infinity() : best_[i].t;
      }
    }

   private:
    static constexpr std::size_t kFewest = 8;  // that are worth a traversal of their own

    // The rays order_[first], ... If they are too far from each other, it takes those on both sides of the middle
    // alone: neighbours in a picture may begin on surfaces at different depths.
    template <class Take, class One>
    void trace_part(std::size_t first, std::size_t end, const Take& take, const One& one) {
      if (end - first >= kFewest) {
        block_.clear();
        first_ = first;
        for (std::size_t i = first; i < end; ++i) block_.add(rays_[order_[i]].ray, best_[order_[i]].t);
        if (traverse(engine_.wide_tree_, block_, kPadOfSticks, *this)) {
          for (std::size_t i = first; i < end; ++i) take(number_[order_[i]], best_[order_[i]]);
          return;
        }
        if (const std::size_t middle = split(first, end); middle != end) {
          trace_part(first, middle, take, one);
          trace_part(middle, end, take, one);
          return;
        }
      }
      for (std::size_t i = first; i < end; ++i) one(number_[order_[i]]);
    }
    // Sorts rays to both sides of the middle of their origins, along that axis across the first ray on which they
    // differ most. `end`: they do not differ.
    std::size_t split(std::size_t first, std::size_t end) {
      std::size_t along = 0, axis = 0;
      double widest = 0, middle = 0;
      const Vec3d& direction = rays_[order_[first]].ray.direction;
      for (std::size_t a = 1; a < 3; ++a)
        if (std::abs(direction[a]) > std::abs(direction[along])) along = a;
      for (std::size_t a = 0; a < 3; ++a) {
        if (a == along) continue;
        double least = rays_[order_[first]].ray.origin[a], largest = least;
        for (std::size_t i = first + 1; i < end; ++i) {
          least = std::min(least, rays_[order_[i]].ray.origin[a]);
          largest = std::max(largest, rays_[order_[i]].ray.origin[a]);
        }
        if (!(largest - least > widest)) continue;
        axis = a;
        widest = largest - least;
        middle = least + 0.5 * widest;
      }
      if (widest == 0) return end;
      const auto* const behind = std::partition(order_ + first, order_ + end,
                                                [&](std::uint8_t i) { return rays_[i].ray.origin[axis] <= middle; });
      return static_cast<std::size_t>(behind - order_);
    }
    std::int64_t number_of(std::int64_t index) const { return engine_.numbers_[static_cast<std::size_t>(index)]; }

    const StickEngine& engine_;
    bool any_hit_;
    StickBlock block_;
    std::uint8_t order_[StickBlock::kRays];  // NOLINT: written before read
    std::size_t first_ = 0;                  // lane 0 has the ray order_[first_]
    std::vector<StickRay> rays_;
    std::int64_t number_[StickBlock::kRays];  // NOLINT: written before read
    Hit best_[StickBlock::kRays];
  };
  bool takes_blocks(RayOrder order) const {
    return by_vectors_ && order == RayOrder::blocks && cuts_ == nullptr && !spheres_.has_images() && !numbers_.empty();
  }

  // `ray` as the boxes see it.
  template <class Answer>
  void traverse_tree(const ScaledRay& ray, double pad, AnswerOfImage<Answer>& answer) const {
    if (!by_vectors_) {
      NoObserver observer;
      return walk(tree_, spheres_, ray, answer, observer, pad);
    }
    struct Tests final : StickTests {
      explicit Tests(AnswerOfImage<Answer>& of_ray) : StickTests(of_ray.limit()), answer(of_ray) {}
      bool test(std::int64_t index) override {
        if (answer.test(index)) return true;
        limit = answer.limit();
        return false;
      }
      AnswerOfImage<Answer>& answer;
    };
    Tests tests(answer);
    traverse(wide_tree_, ray, pad, tests);
  }

  template <class Answer>
  void traverse_sticks(const Ray& ray, Answer& answer) const {
    if (!is_valid(ray) || numbers_.empty()) return;
    if (cuts_ != nullptr) {
      CutRay cut{ScaledRay({}, 1)};
      cuts_->enter(ray, cuts_->cutting_sticks(), cut);
      answer.ray = cuts_->stick_ray_of(ray, cut);
      answer.cut = &cut;
      traverse_images(answer);
      return;
    }
    answer.ray = stick_ray(ray, spheres_, sticks_);
    traverse_images(answer);
  }
  template <class Answer>
  void traverse_images(Answer& answer) const {
    if (!spheres_.has_images()) {
      AnswerOfImage<Answer> of_all{answer, &numbers_, 0};
      traverse_tree(answer.ray.ray, kPadOfSticks, of_all);
      return;
    }
    EachImage<Answer> each{*this, answer};
    const Aabb& around = by_vectors_ ? wide_tree_.box() : tree_.aabb;
    const ImageBox box{to_double(around.lo), to_double(around.hi)};
    visit_image_boxes(spheres_.images(), spheres_.scale(), box, answer.ray.ray, each);
  }
  bool meets_stick(const Ray& ray) const {
    Nearest nearest{*this, true, {}};
    traverse_sticks(ray, nearest);
    return nearest.best.found();
  }

  // The engine of the spheres knows the caps of cut sticks.
  std::int64_t left_of_spheres(std::int64_t leaves, bool inside) const {
    return cuts_ != nullptr && cuts_->is_cut(leaves) ? leaves : left_sphere(spheres_, sticks_, leaves, inside);
  }
  Ray of_spheres(const Ray& ray) const {
    Ray made = ray;
    made.leaves = left_of_spheres(ray.leaves, ray.inside);
    return made;
  }
  // The returned span borrows memory of this thread until its next call.
  RaySpan of_spheres(const RaySpan& rays) const {
    if (rays.leaves == nullptr) return rays;
    static thread_local std::vector<std::int64_t> leaves;
    leaves.resize(static_cast<std::size_t>(rays.count));
    for (std::int64_t i = 0; i < rays.count; ++i)
      leaves[static_cast<std::size_t>(i)] =
          left_of_spheres(rays.leaves[i], rays.inside != nullptr && rays.inside[i] != 0);
    RaySpan made = rays;
    made.leaves = leaves.data();
    return made;
  }

  const SphereSet& spheres_;
  const StickSet& sticks_;
  std::vector<std::int32_t> numbers_;  // of the sticks in the tree
  std::shared_ptr<const RayEngine> engine_of_spheres_;
  std::shared_ptr<const CutSet> cuts_;
  bool by_vectors_;
  Tree tree_;            // over the sticks,
  StickTree wide_tree_;  // or this one
};

}  // namespace bihive
