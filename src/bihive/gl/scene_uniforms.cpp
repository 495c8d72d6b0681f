#include "bihive/gl/scene_uniforms.h"

#include <algorithm>
#include <cmath>

#include "bihive/geometry/plane.h"
#include "bihive/scene/camera.h"

namespace bihive {
namespace {

constexpr double kFarthestEye = 1e15;
constexpr double kLargestLength = 1e18;  // its square fits binary32

float length_of(double stored) {
  return static_cast<float>(std::clamp(stored, -kLargestLength, kLargestLength));
}

}  // namespace

SceneUniforms::SceneUniforms(const Scene& scene, const Tree* tree, const SceneTextures& textures)
    : sphere_count(static_cast<int>(textures.sphere_count)),
      light_count(static_cast<int>(textures.light_count)),
      background(to_float(scene.background)),
      ambient_light(to_float(scene.ambient_light)) {
  if (tree != nullptr && !tree->aabb.empty()) {
    tree_lo = tree->aabb.lo;
    tree_hi = tree->aabb.hi;
  }
  if (!scene.plane) return;
  const double scale = scene.spheres.scale();
  const Plane plane = local_plane(scene);
  has_plane = true;
  plane_normal = to_float(plane.normal);
  plane_offset = length_of(dot(plane.normal, plane.point * scale));
  if (!scene.plane->checker) return;
  const Checker& checker = *scene.plane->checker;
  const PlaneAxes axes = plane_axes(plane.normal);
  has_checker = true;
  plane_u = to_float(axes.u);
  plane_v = to_float(axes.v);
  second_colour = to_float(checker.second_colour);
  checker_size = length_of(checker.size * scale);
  fade_distance = length_of(checker.fade_distance * scale);
}

void SceneUniforms::put(GlProgram& program) const {
  program.set("sphere_count", sphere_count);
  program.set("background", background);
  program.set("ambient_light", ambient_light);
  program.set("tree_lo", tree_lo);
  program.set("tree_hi", tree_hi);
  program.set("has_plane", has_plane);
  program.set("plane_normal", plane_normal);
  program.set("plane_offset", plane_offset);
  program.set("has_checker", has_checker);
  program.set("plane_u", plane_u);
  program.set("plane_v", plane_v);
  program.set("second_colour", second_colour);
  program.set("checker_size", checker_size);
  program.set("fade_distance", fade_distance);
}

Result<CameraUniforms> CameraUniforms::from(const Camera& camera, double scale, int width_px, int height_px,
                                            LensPlace place) {
  if (Status status = check_camera(camera); !status) return status.error();
  const PixelRays rays(camera, width_px, height_px);
  const bool parallel = rays.parallel();
  Vec3d eye = (parallel ? rays.centre() : to_double(rays.eye())) * scale;
  Vec3d forward = rays.forward();
  const double unit = parallel ? scale : 1;
  if (length(eye) + camera.aperture * scale > kFarthestEye)
    return Error{"camera: the eye is too far away from the spheres for the graphics processor's single precision", "",
                 0, 0, "choose an engine of the CPU"};
  if (rays.has_lens()) {
    eye = to_double(to_float(rays.centre() + (place.x * rays.lens_right() + place.y * rays.lens_down()))) * scale;
    forward = forward - (place.x * rays.tilt_right() + place.y * rays.tilt_down());
  }
  const auto rest_of = [](Vec3d number) { return to_float(number - to_double(to_float(number))); };
  CameraUniforms uniforms;
  uniforms.has_parallel_rays = parallel;
  uniforms.eye = to_float(eye);
  uniforms.eye_lower = rest_of(eye);
  uniforms.forward = to_float(forward);
  uniforms.forward_lower = rest_of(forward);
  uniforms.view_forward = to_float(rays.forward());
  uniforms.pixel_length = static_cast<float>(length(rays.right()) * unit);
  uniforms.right = to_float(rays.right() * unit);
  uniforms.right_lower = rest_of(rays.right() * unit);
  uniforms.down = to_float(rays.down() * unit);
  uniforms.down_lower = rest_of(rays.down() * unit);
  uniforms.half_width = static_cast<float>(rays.half_width());
  uniforms.half_height = static_cast<float>(rays.half_height());
  return uniforms;
}

void CameraUniforms::put(GlProgram& program) const {
  program.set("has_parallel_rays", has_parallel_rays);
  program.set("eye", eye);
  program.set("eye_lower", eye_lower);
  program.set("forward", forward);
  program.set("forward_lower", forward_lower);
  program.set("right", right);
  program.set("right_lower", right_lower);
  program.set("down", down);
  program.set("down_lower", down_lower);
  program.set("half_size", half_width, half_height);
  program.set("view_forward", view_forward);
  program.set("pixel_length", pixel_length);
}

}  // namespace bihive
