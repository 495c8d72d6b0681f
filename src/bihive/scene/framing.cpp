#include "bihive/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bihive/geometry/each_sphere.h"
#include "bihive/math/elementary.h"
#include "bihive/scene/framing_cell.h"

namespace bihive {
namespace {

// Where the free part of one side of the picture begins and ends, from the picture's middle: 1 is half of the side.
struct FreePart {
  double low, high;

  double middle() const { return 0.5 * (high - low); }
  double size() const { return 0.5 * (low + high); }  // 1: all of the side
};

FreePart free_part(double low_inset, double high_inset) {
  const auto free = [](double inset) { return 1 - 2 * std::clamp(inset, kFreeBorder, kMostInset); };
  return {free(low_inset), free(high_inset)};
}

// The two opposite planes through the eye that bound the free part to the left and right, or below and above, by the
// tangents of their angles. With the eye at (shift, distance) along (the span's axis, back), a sphere is inside a plane
// when its centre is at least a radius away from it:
//   distance * low - shift >= radius * slope - place + low * depth    and for `high` with -shift and -place.
class Span {
 public:
  /// `tangent`: of half of the picture's shorter side.
  Span(double tangent, double side_px, double shorter_px, const FreePart& part)
      : low_tangent_(tangent * part.low * side_px / shorter_px),
        high_tangent_(tangent * part.high * side_px / shorter_px),
        low_slope_(std::sqrt(1 + low_tangent_ * low_tangent_)),
        high_slope_(std::sqrt(1 + high_tangent_ * high_tangent_)) {}

  void add(double place, double depth, double radius) {
    low_ = std::max(low_, radius * low_slope_ - place + low_tangent_ * depth);
    high_ = std::max(high_, radius * high_slope_ + place + high_tangent_ * depth);
  }
  /// With what the others have, of which each has a part of the spheres.
  void add_others(const SetParts* parts) {
    std::vector<double> numbers{low_, high_};
    greatest_of_all(parts, numbers);
    low_ = numbers[0];
    high_ = numbers[1];
  }
  /// The smallest distance at which both planes hold.
  double distance() const { return empty() ? 0 : (low_ + high_) / (low_tangent_ + high_tangent_); }
  /// The shift with as much room at both planes, from that distance on.
  double shift(double distance) const {
    return empty() ? 0 : (high_ - low_ + distance * (low_tangent_ - high_tangent_)) / 2;
  }

 private:
  bool empty() const { return low_ == kNone; }

  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  double low_tangent_, high_tangent_, low_slope_, high_slope_;
  double low_ = kNone, high_ = kNone;
};

// The spheres' silhouettes along one side of an orthographic picture: from low to high.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double place, double radius) {
    low = std::min(low, place - radius);
    high = std::max(high, place + radius);
  }
  void add_others(const SetParts* parts) {
    std::vector<double> numbers{-low, high};
    greatest_of_all(parts, numbers);
    low = -numbers[0];
    high = numbers[1];
  }
  double size() const { return high > low ? high - low : 0; }
  double middle() const { return high >= low ? low + 0.5 * (high - low) : 0; }
};

// Calls use(place, radius) for each sphere and each point.
template <class Use>
void for_each_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Use& use) {
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double radius) { use(centre, radius); });
  for (const Vec3d point : points) use(point, 0.0);
}

// Turns a camera that frames the set in perspective, whose `distance` from the spheres' `middle` is known, into one
// with parallel rays.
void frame_parallel(const SphereSet& spheres, const std::vector<Vec3d>& points, const Side& side, Vec3d middle,
                    double distance, int width_px, int height_px, const FreePart& across_part,
                    const FreePart& along_part, Camera& camera) {
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  Extent across, along;
  double front = 0;
  for_each_in_view(spheres, points, [&](Vec3d place, double radius) {
    const Vec3d centre = place - middle;
    across.add(dot(centre, right), radius);
    along.add(dot(centre, up), radius);
    front = std::max(front, dot(centre, side.back) + radius);
  });
  for (Extent* extent : {&across, &along}) extent->add_others(spheres.parts());
  front = greatest_of_all(spheres.parts(), front);
  const double shorter = std::min(width_px, height_px);
  const double side_length = std::max(across.size() * shorter / width_px / across_part.size(),
                                      along.size() * shorter / height_px / along_part.size());
  camera.projection = Projection::orthographic;
  camera.shorter_side = side_length > 0 ? side_length : 1;

  // Origins are rounded to binary32, and must not come to lie in a sphere.
  distance = std::max(distance, front + 0.5 * camera.shorter_side);
  const double half_px = 0.5 * camera.shorter_side / shorter;
  const Vec3d shift = (across.middle() - across_part.middle() * half_px * width_px) * right +
                      (along.middle() - along_part.middle() * half_px * height_px) * up;
  camera.look_at = middle + shift;
  camera.eye = camera.look_at + distance * side.back;
  const double largest = std::max({std::abs(camera.eye.x), std::abs(camera.eye.y), std::abs(camera.eye.z)});
  camera.eye = camera.eye + 0x1p-20 * largest * side.back;
}

}  // namespace

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

namespace {

// The camera of frame_spheres(), with these points inside of the picture too.
Camera frame(const SphereSet& spheres, const std::vector<Vec3d>& points, const Side& side, const Lens& lens,
             int width_px, int height_px, const Insets& insets) {
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  const SphereSet::Bounds bounds = spheres.bounds();
  const Vec3d middle = spheres.whole_size() == 0 ? Vec3d{} : bounds.lo + 0.5 * (bounds.hi - bounds.lo);

  // The tangents of the angles that the free part of the picture spans to either side.
  const double shorter = std::min(width_px, height_px);
  const double tangent = tan_deg(lens.fov_deg / 2);
  const FreePart across_part = free_part(insets.left, insets.right);
  const FreePart along_part = free_part(insets.bottom, insets.top);
  Span across(tangent, width_px, shorter, across_part);
  Span along(tangent, height_px, shorter, along_part);
  double distance = 0;
  for_each_in_view(spheres, points, [&](Vec3d place, double radius) {
    const Vec3d centre = place - middle;
    const double depth = dot(centre, side.back);
    across.add(dot(centre, right), depth, radius);
    along.add(dot(centre, up), depth, radius);
    distance = std::max(distance, depth + radius);
  });
  for (Span* span : {&across, &along}) span->add_others(spheres.parts());
  distance = greatest_of_all(spheres.parts(), distance);
  distance = std::max({distance, across.distance(), along.distance()});
  if (!(distance > 0)) distance = 1;
  const Vec3d shift = across.shift(distance) * right + along.shift(distance) * up;

  Camera camera;
  camera.look_at = middle + shift;
  camera.eye = camera.look_at + distance * side.back;
  camera.up = up;
  camera.fov_deg = lens.fov_deg;
  if (lens.projection == Projection::orthographic)
    frame_parallel(spheres, points, side, middle, distance, width_px, height_px, across_part, along_part, camera);
  return camera;
}

}  // namespace

Camera frame_spheres(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px,
                     const Insets& insets) {
  return frame(spheres, {}, side, lens, width_px, height_px, insets);
}

std::vector<Vec3d> cell_corners(const SphereSet& spheres) {
  std::vector<Vec3d> corners;
  const auto [a, b, c] = spheres.images().counts;
  if (const std::optional<Cell>& cell = spheres.cell())
    for (const double i : {0.0, double(a)})
      for (const double j : {0.0, double(b)})
        for (const double k : {0.0, double(c)})
          corners.push_back(cell->origin + i * cell->vectors[0] + j * cell->vectors[1] + k * cell->vectors[2]);
  return corners;
}

Camera frame_with_cell(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px,
                       const Insets& insets) {
  return frame(spheres, cell_corners(spheres), side, lens, width_px, height_px, insets);
}

Camera frame_spheres(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px) {
  return frame_spheres(spheres, side_of(from), {fov_deg, Projection::perspective}, width_px, height_px);
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
