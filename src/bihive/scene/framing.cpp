#include "bihive/scene/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// Free border, as a share of the picture's side.
constexpr double kMargin = 0.04;

struct Side {
  Vec3d back;  // from what is looked at towards the eye
  Vec3d up;
};

Side side_of(ViewFrom from) {
  switch (from) {
    case ViewFrom::front:
      return {{0, 0, 1}, {0, 1, 0}};
    case ViewFrom::back:
      return {{0, 0, -1}, {0, 1, 0}};
    case ViewFrom::left:
      return {{-1, 0, 0}, {0, 1, 0}};
    case ViewFrom::right:
      return {{1, 0, 0}, {0, 1, 0}};
    case ViewFrom::top:
      return {{0, 1, 0}, {0, 0, -1}};
    case ViewFrom::bottom:
      return {{0, -1, 0}, {0, 0, 1}};
    case ViewFrom::iso:
      break;
  }
  return {normalized(Vec3d{1, 1, 1}), {0, 1, 0}};
}

}  // namespace

Camera frame_spheres(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px) {
  const Side side = side_of(from);
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  const SphereSet::Bounds bounds = spheres.bounds();
  const Vec3d middle = spheres.empty() ? Vec3d{} : bounds.lo + 0.5 * (bounds.hi - bounds.lo);

  // The four planes through the eye that bound the picture less its margin, by their inward normals.
  const double shorter = std::min(width_px, height_px);
  const double tangent = tan_deg(fov_deg / 2) * (1 - 2 * kMargin);
  const double tan_x = tangent * width_px / shorter;
  const double tan_y = tangent * height_px / shorter;
  const std::array<Vec3d, 4> normals{normalized(right - tan_x * side.back), normalized(-right - tan_x * side.back),
                                     normalized(up - tan_y * side.back), normalized(-up - tan_y * side.back)};

  // A sphere is inside a plane when its centre is a radius away from it. With the eye at middle + d back that is a
  // lower bound of d; the largest of all is the nearest eye. The sphere must also lie before the eye.
  double distance = 0;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.centre(id) - middle;
    const double radius = spheres.radius(id);
    for (const Vec3d& normal : normals)
      distance = std::max(distance, (radius - dot(normal, centre)) / -dot(normal, side.back));
    distance = std::max(distance, dot(centre, side.back) + radius);
  }
  if (!(distance > 0)) distance = 1;

  Camera camera;
  camera.look_at = middle;
  camera.eye = middle + distance * side.back;
  camera.up = up;
  camera.fov_deg = fov_deg;
  return camera;
}

PointLight light_behind(const Camera& camera) {
  // Up and left by shares of the distance, chosen so that shading shows shape and shadows fall to the lower right.
  const Vec3d view = camera.look_at - camera.eye;
  const double distance = length(view);
  const Vec3d forward = view / distance;
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  return {camera.eye + distance * (0.8 * up - 0.5 * right - 0.2 * forward), {1, 1, 1}};
}

}  // namespace bihive
