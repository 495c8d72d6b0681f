#include "bihive/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// Free border, as a share of the picture's side.
constexpr double kMargin = 0.04;

struct Side {
  Vec3d back;  // from look_at towards the eye
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

// The two opposite planes through the eye that bound the picture to the left and right, or below and above. With the
// eye at (shift, distance) along (the span's axis, back), a sphere is inside a plane when its centre is at least a
// radius away from it:
//   distance * tangent - shift >= radius * slope - place + tangent * depth    and the same with -shift and -place.
class Span {
 public:
  explicit Span(double tangent) : tangent_(tangent), slope_(std::sqrt(1 + tangent * tangent)) {}

  void add(double place, double depth, double radius) {
    low_ = std::max(low_, radius * slope_ - place + tangent_ * depth);
    high_ = std::max(high_, radius * slope_ + place + tangent_ * depth);
  }
  /// The smallest distance at which both planes hold, and its shift.
  double distance() const { return empty() ? 0 : (low_ + high_) / (2 * tangent_); }
  double shift() const { return empty() ? 0 : (high_ - low_) / 2; }

 private:
  bool empty() const { return low_ == kNone; }

  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  double tangent_, slope_;
  double low_ = kNone, high_ = kNone;
};

}  // namespace

Camera frame_spheres(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px) {
  const Side side = side_of(from);
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  const SphereSet::Bounds bounds = spheres.bounds();
  const Vec3d middle = spheres.empty() ? Vec3d{} : bounds.lo + 0.5 * (bounds.hi - bounds.lo);

  // The tangents of the angles that the picture without its margin spans to either side.
  const double shorter = std::min(width_px, height_px);
  const double tangent = tan_deg(fov_deg / 2) * (1 - 2 * kMargin);
  Span across{tangent * width_px / shorter};
  Span along{tangent * height_px / shorter};
  double distance = 0;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d centre = spheres.centre(id) - middle;
    const double radius = spheres.radius(id);
    const double depth = dot(centre, side.back);
    across.add(dot(centre, right), depth, radius);
    along.add(dot(centre, up), depth, radius);
    distance = std::max(distance, depth + radius);
  }
  distance = std::max({distance, across.distance(), along.distance()});
  if (!(distance > 0)) distance = 1;
  const Vec3d shift = across.shift() * right + along.shift() * up;

  Camera camera;
  camera.look_at = middle + shift;
  camera.eye = camera.look_at + distance * side.back;
  camera.up = up;
  camera.fov_deg = fov_deg;
  return camera;
}

PointLight light_behind(const Camera& camera) {
  // Up and left by shares of the distance. With these shares shading shows shape, and shadows fall to the lower right.
  const Vec3d view = camera.look_at - camera.eye;
  const double distance = length(view);
  const Vec3d forward = view / distance;
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  return {camera.eye + distance * (0.8 * up - 0.5 * right - 0.2 * forward), {1, 1, 1}};
}

}  // namespace bihive
