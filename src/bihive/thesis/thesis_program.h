// The thesis program: the search for hits as a plain program of its time would do it, to measure the cost of its steps.
//
// Binary32, one thread, two children per node, the steps of the shader (gl/shaders/traversal.glsl). It uses neither the
// intersection nor the traversal of the library; the reference engine tells how many of its pixels are right.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Spheres and a tree in binary32, in stored units, as the shader has them.
class ThesisProgram {
 public:
  ThesisProgram(const Scene& scene, const Tree& tree);

  /// The nearest sphere of each pixel, -1 where there is none: by the tree, or by testing every sphere. Row by row from
  /// the top, `width * height` of them.
  void draw(int width, int height, bool by_tree, std::vector<std::int32_t>& ids) const;

 private:
  struct Sphere {
    float x, y, z, radius;
  };
  struct ProgramNode {
    float left_clip, right_clip;
    std::int32_t first, count;  // children, or spheres in leaf order
    std::int8_t axis;
    bool leaf, split;
  };
  struct ProgramRay {
    float origin[3], direction[3];
  };
  struct Nearest {
    float t;
    std::int32_t id;
  };

  void test(const ProgramRay& ray, std::size_t sphere, Nearest& nearest) const;
  std::int32_t closest_by_tree(const ProgramRay& ray) const;
  std::int32_t closest_by_brute_force(const ProgramRay& ray) const;

  Camera camera_;
  float scale_;
  Aabb box_;
  std::vector<Sphere> spheres_;  // in leaf order
  std::vector<std::int32_t> ids_;
  std::vector<ProgramNode> nodes_;
};

}  // namespace bihive
