// Twin of bih/traversal.h. STACK_SIZE: no path of the tree has more nodes with two children.
#include "hit"
#include "sphere"

uniform vec3 tree_lo;
uniform vec3 tree_hi;

const uint kLeaf = 0u;
const uint kSplit = 1u;
const uint kOneLeft = 2u;
const uint kOneRight = 3u;
const uint kClip = 4u;

#ifdef COUNTING
int node_visits = 0;  // leaves too
int empty_gaps = 0;
#endif

// Cuts a ray's interval (near, far) at planes across an axis. It pads the planes, so it never cuts too much.
struct Slabs {
  vec3 origin;
  vec3 direction;
  vec3 over_direction;
  float pad;
};

Slabs make_slabs(Ray ray) {
  // Bounds in stored units are at most 1, so rounding one to nearest moves it by at most 2^-25. Binary32 adds an error
  // of some 2^-24 of the distance between the origin and the farthest point of the set, to a plane's t and to a
  // sphere's perpendicular alike. The two must agree: 2^-21 is eight times that error.
  float farthest = max(max(abs(ray.origin.x), abs(ray.origin.y)), abs(ray.origin.z)) + 2.0;
  // A ray along a plane lies wholly on one side of it. So does a ray that would reach the plane only after 1e30 steps.
  vec3 small = vec3(lessThan(abs(ray.direction), vec3(1.0e-30)));
  return Slabs(ray.origin, ray.direction, 1.0 / mix(ray.direction, vec3(1.0e-30), small),
               5.9604645e-8 + 4.7683716e-7 * farthest);
}

vec2 below(Slabs slabs, vec2 part, int axis, float plane) {
  float t = (plane + slabs.pad - slabs.origin[axis]) * slabs.over_direction[axis];
  return slabs.over_direction[axis] > 0.0 ? vec2(part.x, min(part.y, t)) : vec2(max(part.x, t), part.y);
}

vec2 above(Slabs slabs, vec2 part, int axis, float plane) {
  float t = (plane - slabs.pad - slabs.origin[axis]) * slabs.over_direction[axis];
  return slabs.over_direction[axis] > 0.0 ? vec2(max(part.x, t), part.y) : vec2(part.x, min(part.y, t));
}

// For the traversal view, without padding: does the interval overlap the open slab lo < coordinate < hi?
bool overlaps(Slabs slabs, vec2 part, int axis, float lo, float hi) {
  if (!(part.x <= part.y) || !(lo < hi)) return false;
  float origin = slabs.origin[axis];
  float direction = slabs.direction[axis];
  if (direction == 0.0) return lo < origin && origin < hi;
  float t_lo = (lo - origin) / direction;
  float t_hi = (hi - origin) / direction;
  return max(part.x, min(t_lo, t_hi)) < min(part.y, max(t_lo, t_hi));
}

// The closest hit, or with any_hit some hit; with LAYERS any_hit searches for opaque spheres, and light_passed is
// multiplied by the transmittance of the others.
Hit traverse(Ray ray, bool any_hit) {
  // Test the box around everything.
  Slabs slabs = make_slabs(ray);
#ifdef LAYERS
  vec2 part = vec2(any_hit ? 0.0 : ray.t_passed, ray.t_max);
#else
  vec2 part = vec2(0.0, ray.t_max);
#endif
  for (int axis = 0; axis < 3; ++axis) {
    part = above(slabs, part, axis, tree_lo[axis]);
    part = below(slabs, part, axis, tree_hi[axis]);
  }
  Hit best = Hit(kNever, kNothing);
  if (sphere_count == 0 || !(part.x <= part.y)) return best;

  int waiting_node[STACK_SIZE];
  vec2 waiting_part[STACK_SIZE];
  int waiting_count = 0;
  int position = 0;

  for (;;) {
    uvec2 what = texelFetch(nodes, texel(2 * position + 1), 0).xy;
    uint kind = what.x & 7u;
    int first = int(what.y);
    vec2 next_part = vec2(1.0, 0.0);
    int next = -1;
#ifdef COUNTING
    ++node_visits;
#endif

    if (kind == kLeaf) {
      // Test every sphere of the leaf.
      int end = first + int(what.x >> 5);
      Hit best_here = Hit(kNever, kNothing);
      for (int i = first; i < end; ++i) {
        float t = sphere_hit(ray, stored_sphere(i));
#ifdef LAYERS
        if (any_hit) {
          if (t < kNever) light_passed *= arriving_behind(i, classes_crossed);
          continue;
        }
#endif
        if (is_nearer(ray, t, i, best_here)) best_here = Hit(t, i);
      }
#ifdef LAYERS
      if (any_hit && light_passed == vec3(0.0)) return best_here;
#endif
      if (any_hit && best_here.sphere != kNothing) return best_here;
      keep_nearer(ray, best, best_here);
    } else {
      vec2 planes = uintBitsToFloat(texelFetch(nodes, texel(2 * position), 0).xy);
      int axis = int(what.x >> 3 & 3u);
      if (kind == kSplit) {
        // Go to the child on the ray's near side first. The other child waits.
#ifdef COUNTING
        if (overlaps(slabs, vec2(part.x, min(part.y, best.t)), axis, planes.x, planes.y)) ++empty_gaps;
#endif
        bool left_is_near = slabs.over_direction[axis] > 0.0;
        vec2 left = below(slabs, part, axis, planes.x);
        vec2 right = above(slabs, part, axis, planes.y);
        next = left_is_near ? first : first + 1;
        next_part = left_is_near ? left : right;
        vec2 far_part = left_is_near ? right : left;
        if (far_part.x <= far_part.y) {
          waiting_node[waiting_count] = left_is_near ? first + 1 : first;
          waiting_part[waiting_count] = far_part;
          ++waiting_count;
        }
      } else {
        // One child: cut at the planes that the node has.
        next = first;
        next_part = part;
        if (kind != kOneLeft) next_part = above(slabs, next_part, axis, kind == kClip ? planes.x : planes.y);
        if (kind != kOneRight) next_part = below(slabs, next_part, axis, kind == kClip ? planes.y : planes.x);
      }
    }

    // Enter the next node that may still hold a hit as near as the best; at equal t it may hold a smaller id.
    while (next < 0 || !(next_part.x <= next_part.y) || next_part.x > best.t) {
      if (waiting_count == 0) return best;
      --waiting_count;
      next = waiting_node[waiting_count];
      next_part = waiting_part[waiting_count];
    }
    position = next;
    part = next_part;
  }
  return best;
}
