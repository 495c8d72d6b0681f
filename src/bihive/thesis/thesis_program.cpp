#include "bihive/thesis/thesis_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/scene/camera.h"

namespace bihive {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
// Relative padding of the entry and exit distances of nodes: binary32 rounds planes and tests alike, and a sphere at
// the edge of its box must not be lost. The shader pads by the same amount.
constexpr float kPad = 0x1p-21F;

struct Part {
  float near, far;
  bool empty() const { return !(near <= far); }
};

}  // namespace

ThesisProgram::ThesisProgram(const Scene& scene, const Tree& tree)
    : camera_(scene.camera), scale_(static_cast<float>(scene.spheres.scale())), box_(tree.aabb) {
  for (const std::int64_t id : tree.sphere_ids) {
    const Vec3f centre = to_float(scene.spheres.stored_centre(id));
    spheres_.push_back({centre.x, centre.y, centre.z, static_cast<float>(scene.spheres.stored_radius(id))});
    ids_.push_back(static_cast<std::int32_t>(id));
  }
  // A clip node has one child between two planes, a one-sided node one child beyond one plane: both become splits with
  // a plane that admits everything or nothing.
  for (const Node& node : tree.nodes) {
    ProgramNode one{node.left_clip,
                    node.right_clip,
                    static_cast<std::int32_t>(node.first),
                    static_cast<std::int32_t>(node.sphere_count),
                    static_cast<std::int8_t>(node.split_axis),
                    node.is_leaf(),
                    node.kind == NodeKind::split};
    if (node.kind == NodeKind::one_left) one.right_clip = one.left_clip, one.left_clip = -kNever;
    if (node.kind == NodeKind::one_right) one.left_clip = one.right_clip, one.right_clip = kNever;
    nodes_.push_back(one);
  }
}

// The perpendicular form, in binary32.
inline void ThesisProgram::test(const ProgramRay& ray, std::size_t sphere, Nearest& nearest) const {
  const Sphere& s = spheres_[sphere];
  const float x = s.x - ray.origin[0], y = s.y - ray.origin[1], z = s.z - ray.origin[2];
  const float middle = x * ray.direction[0] + y * ray.direction[1] + z * ray.direction[2];
  const float px = x - middle * ray.direction[0], py = y - middle * ray.direction[1],
              pz = z - middle * ray.direction[2];
  const float square = s.radius * s.radius - (px * px + py * py + pz * pz);
  if (square < 0) return;
  const float half = std::sqrt(square);
  const float t = middle - half >= 0 ? middle - half : middle + half;
  if (t >= 0 && (t < nearest.t || (t == nearest.t && ids_[sphere] < nearest.id))) nearest = {t, ids_[sphere]};
}

std::int32_t ThesisProgram::closest_by_brute_force(const ProgramRay& ray) const {
  Nearest nearest{kNever, -1};
  for (std::size_t i = 0; i < spheres_.size(); ++i) test(ray, i, nearest);
  return nearest.id;
}

std::int32_t ThesisProgram::closest_by_tree(const ProgramRay& ray) const {
  float over[3], pad = 0;
  for (int axis = 0; axis < 3; ++axis) {
    over[axis] = 1 / (std::abs(ray.direction[axis]) < 1e-30F ? 1e-30F : ray.direction[axis]);
    pad = std::max({pad, std::abs(ray.origin[axis]), std::abs(box_.lo[axis]), std::abs(box_.hi[axis])});
  }
  pad *= kPad;
  const auto below = [&](Part part, int axis, float plane) {
    const float t = (plane + pad - ray.origin[axis]) * over[axis];
    return over[axis] > 0 ? Part{part.near, std::min(part.far, t)} : Part{std::max(part.near, t), part.far};
  };
  const auto above = [&](Part part, int axis, float plane) {
    const float t = (plane - pad - ray.origin[axis]) * over[axis];
    return over[axis] > 0 ? Part{std::max(part.near, t), part.far} : Part{part.near, std::min(part.far, t)};
  };

  // Test the box around everything.
  Nearest nearest{kNever, -1};
  Part part{0, kNever};
  for (int axis = 0; axis < 3; ++axis) part = below(above(part, axis, box_.lo[axis]), axis, box_.hi[axis]);
  if (part.empty() || spheres_.empty()) return -1;

  struct Waiting {
    std::int32_t node;
    Part part;
  };
  Waiting waiting[1024];  // a tree is at most 1000 levels deep
  int count = 0;
  for (std::int32_t position = 0;;) {
    const ProgramNode& node = nodes_[static_cast<std::size_t>(position)];
    std::int32_t next = -1;
    Part next_part{1, 0};
    if (node.leaf) {
      // Test every sphere of the leaf.
      for (std::int32_t i = node.first; i < node.first + node.count; ++i)
        test(ray, static_cast<std::size_t>(i), nearest);
    } else if (node.split) {
      // Go to the near child; push the other one.
      const bool left_is_near = over[node.axis] > 0;
      const Part left = below(part, node.axis, node.left_clip), right = above(part, node.axis, node.right_clip);
      const Part far = left_is_near ? right : left;
      next = left_is_near ? node.first : node.first + 1;
      next_part = left_is_near ? left : right;
      if (!far.empty()) waiting[count++] = {left_is_near ? node.first + 1 : node.first, far};
    } else {
      next = node.first;
      next_part = below(above(part, node.axis, node.left_clip), node.axis, node.right_clip);
    }
    // Enter the next node that may still hold a nearer hit.
    while (next < 0 || next_part.empty() || next_part.near > nearest.t) {
      if (count == 0) return nearest.id;
      next = waiting[--count].node;
      next_part = waiting[count].part;
    }
    position = next;
    part = next_part;
  }
}

void ThesisProgram::draw(int width, int height, bool by_tree, std::vector<std::int32_t>& ids) const {
  const PixelRays pixels(camera_, width, height);
  ids.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::size_t at = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Ray ray = pixels.at(x + 0.5, y + 0.5);
      const Vec3f from = ray.origin * scale_, to = normalized(ray.direction);
      const ProgramRay one{{from.x, from.y, from.z}, {to.x, to.y, to.z}};
      ids[at++] = by_tree ? closest_by_tree(one) : closest_by_brute_force(one);
    }
}

}  // namespace bihive
