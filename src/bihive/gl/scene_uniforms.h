// All scalars and vectors of a scene and a camera that a shader needs, in stored units.
#pragma once

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/gl/program.h"
#include "bihive/gl/tree_textures.h"
#include "bihive/math/vec3.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Plane, checker, background, bounds and counts.
struct SceneUniforms {
  int sphere_count = 0, light_count = 0;
  Vec3f background, ambient_light{1, 1, 1}, tree_lo, tree_hi;
  bool has_plane = false, has_checker = false;
  Vec3f plane_normal, plane_u, plane_v, second_colour;
  float plane_offset = 0, checker_size = 1, fade_distance = 0;

  SceneUniforms() = default;
  SceneUniforms(const Scene& scene, const Tree* tree, const SceneTextures& textures);
  /// Sets the uniforms of the program in use.
  void put(GlProgram& program) const;
};

struct CameraUniforms {
  bool has_parallel_rays = false;
  Vec3f eye, forward, right, down;                          // for parallel rays, right and down are in stored units
  Vec3f eye_lower, forward_lower, right_lower, down_lower;  // the remainder after rounding to binary32
  float half_width = 0, half_height = 0;
  Vec3f view_forward;      // as forward, without the tilt
  float pixel_length = 0;  // of one pixel; with one eye, at distance 1

  /// For the rays through one point of the lens. Error: as check_camera(), or an eye so far away (1e15 times the extent
  /// of the spheres) that squares exceed binary32.
  static Result<CameraUniforms> from(const Camera& camera, double scale, int width_px, int height_px,
                                     LensPlace place = {});
  void put(GlProgram& program) const;
};

}  // namespace bihive
