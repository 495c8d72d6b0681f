// Scalar traversal in binary64, one ray and one box at a time. It is for rays that binary32 cannot hold, such as those
// that start more than 2^20 times the scene's extent away.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/bih/traversal.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/interval.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Calls test(slot) for the spheres in leaves that a ray meets at t_min to t_max, and at most test.limit(), until it
/// returns true. `slabs` are those of the ray relative to the nodes.
template <class Test>
void walk_leaves(const WideTree& tree, const Slabs& slabs, double t_min, double t_max, Test& test) {
  if (tree.node_count == 0) return;
  std::vector<std::int64_t> waiting{0};
  while (!waiting.empty()) {
    const WideNode& node = tree.nodes[waiting.back()];
    waiting.pop_back();
    for (int slot = 0; slot < node.child_count; ++slot) {
      // Skip a child that the ray misses, or enters beyond the limit.
      Interval part{t_min, std::min(t_max, test.limit())};
      for (int axis = 0; axis < 3; ++axis) {
        part = slabs.above(part, axis, double(node.lo[axis][slot]));
        part = slabs.below(part, axis, double(node.hi[axis][slot]));
      }
      if (part.empty()) continue;
      if (!node.is_leaf(slot)) {
        waiting.push_back(node.child_node(slot));
        continue;
      }
      const std::int64_t begin = node.sphere_begin(slot);
      for (std::int64_t i = begin; i < begin + node.sphere_count(slot); ++i)
        if (test(i)) return;
    }
  }
}

/// Takes the ray to spheres as walk() in bih/traversal.h does. `ray` is valid and in the tree's stored units. `left`,
/// and not `ray`, says which sphere it exits.
template <class Answer>
void walk_scalar(const WideTree& tree, ScaledRay ray, const LeftSphere& left, Answer& answer) {
  struct Test {
    const WideTree& tree;
    ScaledRay& ray;
    const LeftSphere& left;
    Answer& answer;

    double limit() const { return answer.limit(); }
    bool operator()(std::int64_t slot) {
      const Vec3d centre = tree.centre(slot);
      const double radius = tree.spheres.radius(slot);
      ray.left_centre = centre;
      ray.left_radius = left.is(tree, slot) ? radius : -1;
      return answer.take(sphere_hit(ray, centre, radius), tree.spheres.id(slot));
    }
  };
  // The nodes of an image are where the tree has them. Its centres were rounded, which moves them by up to 2^-25.
  ScaledRay in_tree = ray;
  if (tree.is_image) in_tree.origin = ray.origin - tree.shift;
  Test test{tree, ray, left, answer};
  walk_leaves(tree, Slabs(in_tree, tree.is_image ? 0x1p-24 : 0), ray.t_min, ray.t_max, test);
}

namespace scalar_walk {

template <class Use>
struct HitsOfRay {
  const Use& use;

  bool take(double t, std::int64_t id) const {
    if (t < std::numeric_limits<double>::infinity()) use(t, id);
    return false;
  }
  static double limit() { return std::numeric_limits<double>::infinity(); }
};

}  // namespace scalar_walk

/// Calls use(t, id) for each hit of any ray, in no order.
template <class Use>
void for_hits_of_ray(const WideTree& tree, const Ray& ray, const Use& use) {
  if (!is_valid(ray)) return;
  scalar_walk::HitsOfRay<Use> of_ray{use};
  walk_scalar(tree, ScaledRay(ray, tree.scale), LeftSphere(tree, ray.leaves), of_ray);
}

/// The same answer as traverse() in bih/traversal.h.
template <bool kAnyHit>
Hit walk_scalar(const WideTree& tree, const ScaledRay& ray, const LeftSphere& left) {
  NearestAnswer<kAnyHit> nearest;
  walk_scalar(tree, ray, left, nearest);
  return nearest.best;
}

}  // namespace bihive
