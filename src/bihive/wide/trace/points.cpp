#include "bihive/wide/trace/points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "bihive/simd/dispatch.h"
#include "bihive/wide/trace/point_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// The current best, as a heap with the worst of them in front.
struct NearestAnswers {
  double within;
  std::int64_t most;
  wide::NearSphere* best;
  std::int64_t count = 0;

  double limit() const { return count < most ? within : best[0].distance; }
  void take(double distance, std::int64_t id) {
    const wide::NearSphere sphere{distance, id};
    if (count < most) {
      best[count++] = sphere;
    } else {
      if (!(sphere < best[0])) return;
      if (most == 1) {
        best[0] = sphere;
        return;
      }
      std::pop_heap(best, best + count);
      best[count - 1] = sphere;
    }
    std::push_heap(best, best + count);
  }
};

struct AllAnswers {
  double within;
  std::vector<wide::NearSphere>& found;

  double limit() const { return within; }
  void take(double distance, std::int64_t id) const { found.push_back({distance, id}); }
};

std::int64_t find_nearest_on_target(const WideTree& tree, const wide::PointQuestion& question, std::int64_t most,
                                    wide::NearSphere* nearest, std::int64_t known) {
  NearestAnswers answer{question.limit, most, nearest, known};
  std::make_heap(nearest, nearest + known);
  PointWalk(tree, question).run(answer);
  std::sort_heap(nearest, nearest + answer.count);
  return answer.count;
}

void find_within_on_target(const WideTree& tree, const wide::PointQuestion& question,
                           std::vector<wide::NearSphere>& found) {
  AllAnswers answer{question.limit, found};
  PointWalk(tree, question).run(answer);
}

void find_pairs_of_leaf_on_target(const WideTree& tree, std::int64_t first, std::int64_t count, double reach,
                                  DistanceTo to, const std::uint8_t* mask, std::vector<wide::NearSphere>& found,
                                  std::int64_t* counts) {
  // Gather the spheres that may be near any of these.
  const WideSpheres& spheres = tree.spheres;
  const auto limit_of = [&](std::int64_t slot) {
    return to == DistanceTo::surface ? reach + spheres.radius(slot) : reach;
  };
  Vec3d lo = spheres.centre(first), hi = lo;
  double largest = limit_of(first);
  for (std::int64_t slot = first + 1; slot < first + count; ++slot) {
    const Vec3d centre = spheres.centre(slot);
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], centre[axis]);
      hi[axis] = std::max(hi[axis], centre[axis]);
    }
    largest = std::max(largest, limit_of(slot));
  }
  wide::PointQuestion question{lo, largest, to, mask};
  PointWalk walk(tree, question);
  walk.set_box(lo, hi);
  thread_local PointWalk::Candidates of_thread;
  PointWalk::Candidates& near = of_thread;
  walk.gather(largest, near);

  // Each of them asks about these alone.
  for (std::int64_t slot = first; slot < first + count; ++slot) {
    const std::size_t known = found.size();
    const std::int64_t asking = spheres.id(slot);
    question.point = spheres.centre(slot);
    if (mask == nullptr || mask[asking] != 0)
      walk.test_candidates(near, limit_of(slot), [&](double distance, std::int64_t id) HWY_ATTR {
        if (id > asking) found.push_back({distance, id});
      });
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(known), found.end(),
              [](const wide::NearSphere& a, const wide::NearSphere& b) { return a.id < b.id; });
    counts[slot - first] = static_cast<std::int64_t>(found.size() - known);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(find_nearest_on_target);
HWY_EXPORT(find_within_on_target);
HWY_EXPORT(find_pairs_of_leaf_on_target);

namespace wide {

std::int64_t find_nearest(const WideTree& tree, const PointQuestion& question, std::int64_t most, NearSphere* nearest,
                          std::int64_t known) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(find_nearest_on_target)(tree, question, most, nearest, known);
}

void find_within(const WideTree& tree, const PointQuestion& question, std::vector<NearSphere>& found) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_within_on_target)(tree, question, found);
}

void find_pairs_of_leaf(const WideTree& tree, std::int64_t first, std::int64_t count, double reach, DistanceTo to,
                        const std::uint8_t* mask, std::vector<NearSphere>& found, std::int64_t* counts) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_pairs_of_leaf_on_target)(tree, first, count, reach, to, mask, found, counts);
}

}  // namespace wide
}  // namespace bihive
#endif
