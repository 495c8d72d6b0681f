// The scalar reference traversal: one loop for closest hit and any hit, short enough to read aloud.
//
// Bounds never cull too much. A plane of the tree is a bound of boxes rounded to nearest in binary32, and the sphere
// test itself rounds in binary64. `Slabs` pads every plane by more than both together (docs/precision.md, "Padding").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/bih/observer.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/interval.h"

namespace bihive {

/// Cuts a ray's interval at planes across an axis. It pads the planes, so it never cuts too much.
class Slabs {
 public:
  /// `more_pad`: extra padding for spheres that reach up to this distance beyond the planes, in stored units.
  explicit Slabs(const ScaledRay& ray, double more_pad = 0) : ray_(ray) {
    // Bounds in stored units are at most 1, so rounding one to nearest moves it by at most 2^-25. Binary64 adds an
    // error of a few 2^-53 of the distance between the origin and the farthest point of the set.
    const double farthest = std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)}) + 2.0;
    pad_ = 0x1p-24 + 0x1p-46 * farthest + more_pad;
  }

  /// The distance by which every plane is moved outward, in stored units.
  double pad() const { return pad_; }

  /// The interval at or below `plane` on the axis. `plane` bounds a child that lies lower.
  Interval below(Interval part, int axis, double plane) const { return cut(part, axis, plane + pad_, true); }
  /// The interval at or above `plane`.
  Interval above(Interval part, int axis, double plane) const { return cut(part, axis, plane - pad_, false); }

  /// For the traversal view, without padding: does the interval overlap the open slab lo < coordinate < hi?
  bool overlaps(Interval part, int axis, double lo, double hi) const {
    if (part.empty() || !(lo < hi)) return false;
    const double origin = ray_.origin[axis];
    const double direction = ray_.direction[axis];
    if (direction == 0) return lo < origin && origin < hi;
    const double t_lo = (lo - origin) / direction;
    const double t_hi = (hi - origin) / direction;
    return std::max(part.t_near, std::min(t_lo, t_hi)) < std::min(part.t_far, std::max(t_lo, t_hi));
  }

 private:
  Interval cut(Interval part, int axis, double plane, bool keep_below) const {
    const double origin = ray_.origin[axis];
    const double direction = ray_.direction[axis];
    // A ray along the plane lies wholly on one side of it.
    if (direction == 0) {
      const bool kept = keep_below ? origin <= plane : origin >= plane;
      return kept ? part : Interval{std::numeric_limits<double>::infinity(), 0};
    }
    const double t = (plane - origin) / direction;
    if ((direction > 0) == keep_below)
      part.t_far = std::min(part.t_far, t);
    else
      part.t_near = std::max(part.t_near, t);
    return part;
  }

  const ScaledRay& ray_;
  double pad_;
};

/// Takes a valid ray, in the stored units of `spheres`, to every sphere that it may hit up to answer.limit(), which
/// may come nearer meanwhile. answer.take(t, id) gets the t of geometry/sphere.h (+inf: no hit), and ends the traversal
/// by returning true. An answer with test(id) instead of take() does the test itself. `more_pad` as for Slabs.
// One long function, because it defines the traversal: it reads from top to bottom, beside its twin for GPUs
// (gl/shaders/traversal.glsl), which has the same steps in the same order.
template <class Answer, class Observer>
void walk(const Tree& tree, const SphereSet& spheres, const ScaledRay& ray, Answer& answer, Observer& observer,
          double more_pad = 0) {
  // Test the box around everything.
  const Slabs slabs(ray, more_pad);
  Interval part{ray.t_min, ray.t_max};
  for (int axis = 0; axis < 3; ++axis) {
    part = slabs.above(part, axis, double(tree.aabb.lo[axis]));
    part = slabs.below(part, axis, double(tree.aabb.hi[axis]));
  }
  if (part.empty() || tree.aabb.empty()) return;

  // A tree is at most 1000 levels deep, and each level leaves at most one child waiting. An array of Interval would be
  // set to 0 a thousand times for each ray; this one is not.
  struct Waiting {
    std::int64_t node;
    double t_near, t_far;
  };
  std::array<Waiting, 1024> waiting;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before read
  int waiting_count = 0;
  std::int64_t position = 0;

  for (;;) {
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    const int axis = node.split_axis;
    Interval next_part{std::numeric_limits<double>::infinity(), 0};
    std::int64_t next = -1;

    if (node.is_leaf()) {
      // Test every sphere of the leaf.
      observer.leaf_visit();
      for (std::int64_t i = node.first_sphere(); i < node.first_sphere() + node.sphere_count; ++i) {
        const std::int64_t id = tree.sphere_ids[static_cast<std::size_t>(i)];
        observer.sphere_test();
        if constexpr (requires { answer.test(id); }) {
          if (answer.test(id)) return;
        } else if (answer.take(sphere_hit(ray, spheres.stored_centre(id), spheres.stored_radius(id)), id)) {
          return;
        }
      }
    } else if (node.kind == NodeKind::split) {
      // Go to the child on the ray's near side first. The other child waits.
      observer.node_visit();
      const Interval open{part.t_near, std::min(part.t_far, answer.limit())};
      if (slabs.overlaps(open, axis, double(node.left_clip), double(node.right_clip))) observer.empty_gap();
      const bool left_is_near = ray.direction[axis] >= 0;
      const Interval left = slabs.below(part, axis, double(node.left_clip));
      const Interval right = slabs.above(part, axis, double(node.right_clip));
      next = left_is_near ? node.left_child() : node.right_child();
      next_part = left_is_near ? left : right;
      const Interval far_part = left_is_near ? right : left;
      if (!far_part.empty())
        waiting[static_cast<std::size_t>(waiting_count++)] = {left_is_near ? node.right_child() : node.left_child(),
                                                              far_part.t_near, far_part.t_far};
    } else {
      // One child: cut at the planes that the node has.
      observer.node_visit();
      next = node.first;
      next_part = part;
      if (node.kind == NodeKind::clip || node.kind == NodeKind::one_right)
        next_part =
            slabs.above(next_part, axis, double(node.kind == NodeKind::clip ? node.left_clip : node.right_clip));
      if (node.kind == NodeKind::clip || node.kind == NodeKind::one_left)
        next_part =
            slabs.below(next_part, axis, double(node.kind == NodeKind::clip ? node.right_clip : node.left_clip));
    }

    // Enter the next node that may still hold a hit within the limit; at the limit itself it may hold a smaller id.
    while (next < 0 || next_part.empty() || next_part.t_near > answer.limit()) {
      if (waiting_count == 0) return;
      const Waiting& top = waiting[static_cast<std::size_t>(--waiting_count)];
      next = top.node;
      next_part = {top.t_near, top.t_far};
    }
    position = next;
    part = next_part;
  }
}

/// The answer of a traversal that searches for the closest hit, or for any.
template <bool kAnyHit>
struct NearestAnswer {
  Hit best;

  bool take(double t, std::int64_t id) {
    best.keep_nearer(t, id);
    return kAnyHit && best.found();
  }
  double limit() const { return best.t; }
};

/// The closest hit of a valid ray in the stored units of `spheres`; with kAnyHit some hit. A hit's t is exact as
/// geometry/sphere.h defines it, and of equal t the smaller id wins: the same answer as brute force, bit for bit.
template <bool kAnyHit, class Observer>
Hit traverse(const Tree& tree, const SphereSet& spheres, const ScaledRay& ray, Observer& observer) {
  NearestAnswer<kAnyHit> nearest;
  walk(tree, spheres, ray, nearest, observer);
  return nearest.best;
}

/// Closest hit by the reference tree. An invalid ray (geometry/ray.h) hits nothing.
inline Hit closest_hit(const Tree& tree, const SphereSet& spheres, const Ray& ray) {
  if (!is_valid(ray)) return {};
  NoObserver observer;
  return traverse<false>(tree, spheres, ScaledRay(ray, spheres), observer);
}

/// Is anything hit? Stops at the first sphere found.
inline bool occluded(const Tree& tree, const SphereSet& spheres, const Ray& ray) {
  if (!is_valid(ray)) return false;
  NoObserver observer;
  return traverse<true>(tree, spheres, ScaledRay(ray, spheres), observer).found();
}

}  // namespace bihive
