// The queries of a structure that answers one ray or point after the other: written once as templates, they count
// their steps or, for timing, count nothing.
#pragma once

#include <utility>

#include "bihive/bih/traversal.h"
#include "bihive/compare/structure.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/geometry/sphere_distance.h"

namespace bihive::workbench {

/// Counts nothing, and costs nothing.
struct NoCount {
  void node(bool) {}
  void box_test() {}
  void sphere_test(std::int64_t) {}
  void answer(const Hit&) {}
};

struct Count {
  Work work;
  std::int64_t together = 1;  // spheres of a node that are tested together
  std::int64_t tests_in_node = 0;

  void node(bool is_leaf) {
    ++work.nodes;
    work.leaves += is_leaf ? 1 : 0;
    tests_in_node = 0;
  }
  void box_test() { ++work.box_tests; }
  void sphere_test(std::int64_t) {
    ++work.sphere_tests;
    work.test_steps += tests_in_node++ % together == 0 ? 1 : 0;
  }
  void answer(const Hit&) {}
};

/// Keeps each step.
struct Record {
  RayPath path;
  std::int64_t box_tests = 0;  // since the last node

  void node(bool is_leaf) {
    path.push_back({is_leaf, box_tests, {}, path.empty() ? Hit{} : path.back().best});
    box_tests = 0;
  }
  void box_test() { ++box_tests; }
  void sphere_test(std::int64_t id) {
    if (path.empty()) node(true);
    path.back().sphere_ids.push_back(id);
  }
  void answer(const Hit& best) { path.back().best = best; }
};

/// The nearest sphere so far, by the distance in stored units.
using NearestSphere = NearestAnswer</*kAnyHit=*/false>;

/// `Self` has two templates, of which neither is asked about an empty set:
///   void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const
///     passes every sphere that a valid ray may hit up to answer.limit() to test(), and ends where that returns true;
///   void search(Vec3d point, NearestSphere& nearest, Counter& counter) const
///     the same for spheres up to nearest.limit() from a point in stored units.
/// and may say with `kTestedTogether` how many spheres of a node count as one step.
template <class Self>
class ByRay : public Structure {
 public:
  explicit ByRay(const SphereSet& spheres) : spheres_(spheres) {}

  [[gnu::flatten]] void closest_hits(const RaySpan& rays, RayOrder, const HitSpan& hits) const override {
    for (std::int64_t i = 0; i < rays.count; ++i) {
      NoCount counter;
      const Hit hit = answer<false>(rays.at(i), counter);
      hits.t[i] = hit.t;
      hits.sphere_id[i] = hit.sphere_id;
    }
  }
  [[gnu::flatten]] void occluded(const RaySpan& rays, RayOrder, std::uint8_t* is_occluded) const override {
    for (std::int64_t i = 0; i < rays.count; ++i) {
      NoCount counter;
      is_occluded[i] = answer<true>(rays.at(i), counter).found() ? 1 : 0;
    }
  }
  [[gnu::flatten]] void nearest_spheres(const double* points, std::int64_t count, const HitSpan& found) const override {
    for (std::int64_t i = 0; i < count; ++i) {
      NoCount counter;
      const Hit hit = nearest({points[3 * i], points[3 * i + 1], points[3 * i + 2]}, counter);
      found.t[i] = hit.t * spheres_.inverse_scale();
      found.sphere_id[i] = hit.sphere_id;
    }
  }
  Work work_of_ray(const Ray& ray, bool any_hit) const override {
    Count counter;
    counter.together = Self::kTestedTogether;
    if (any_hit)
      answer<true>(ray, counter);
    else
      answer<false>(ray, counter);
    return counter.work;
  }
  RayPath path_of_ray(const Ray& ray, bool any_hit) const override {
    Record record;
    if (any_hit)
      answer<true>(ray, record);
    else
      answer<false>(ray, record);
    return std::move(record.path);
  }
  Work work_of_point(Vec3d point) const override {
    Count counter;
    counter.together = Self::kTestedTogether;
    nearest(point, counter);
    return counter.work;
  }

 protected:
  static constexpr std::int64_t kTestedTogether = 1;

  const SphereSet& spheres() const { return spheres_; }

  /// Tests a ray against a sphere; true where the traversal is over.
  template <class Answer, class Counter>
  bool test(const ScaledRay& ray, std::int64_t id, Answer& answer, Counter& counter) const {
    counter.sphere_test(id);
    const bool ends = answer.take(sphere_hit(ray, spheres_.stored_centre(id), spheres_.stored_radius(id)), id);
    counter.answer(answer.best);
    return ends;
  }
  /// Tests a point against a sphere.
  template <class Counter>
  void test(Vec3d point, std::int64_t id, NearestSphere& nearest, Counter& counter) const {
    counter.sphere_test(id);
    nearest.take(sphere_distance(point, spheres_.stored_centre(id), spheres_.stored_radius(id), DistanceTo::surface),
                 id);
  }

 private:
  template <bool kAnyHit, class Counter>
  Hit answer(const Ray& ray, Counter& counter) const {
    NearestAnswer<kAnyHit> nearest;
    if (is_valid(ray) && !spheres_.empty())
      static_cast<const Self&>(*this).trace(ScaledRay(ray, spheres_), nearest, counter);
    return nearest.best;
  }
  template <class Counter>
  Hit nearest(Vec3d point, Counter& counter) const {
    NearestSphere nearest;
    const Vec3d stored = spheres_.to_local(point) * spheres_.scale();
    if (!spheres_.empty()) static_cast<const Self&>(*this).search(stored, nearest, counter);
    return nearest.best;
  }

  const SphereSet& spheres_;
};

}  // namespace bihive::workbench
