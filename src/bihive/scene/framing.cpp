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

// The free interval of one side of the picture, from the picture's middle: 1 is half of the side.
struct FreePart {
  double low, high;

  double middle() const { return 0.5 * (high - low); }
  double size() const { return 0.5 * (low + high); }  // 1: all of the side
};

FreePart free_part(double low_inset, double high_inset) {
  const auto free = [](double inset) { return 1 - 2 * std::clamp(inset, kFreeBorder, kMostInset); };
  return {free(low_inset), free(high_inset)};
}

// The two opposite planes through the eye that bound the free interval to the left and right, or below and above, by
// the tangents of their angles. With the eye at (shift, distance) along (the span's axis, back), a sphere is inside a
// plane when its centre is at least a radius away from it:
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
  void take(double low, double high) {
    low_ = low;
    high_ = high;
  }
  double low() const { return low_; }
  double high() const { return high_; }
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
  double size() const { return high > low ? high - low : 0; }
  double middle() const { return high >= low ? low + 0.5 * (high - low) : 0; }
};

// Calls use(place, radius) for each sphere and each point.
template <class Use>
void for_each_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Use& use) {
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double radius) { use(centre, radius); });
  for (const Vec3d point : points) use(point, 0.0);
}

// Converts a camera that frames the set in perspective, at `distance` from the spheres' middle, into one with parallel
// rays.
void frame_parallel(const Framing& framing, const ViewReach& reach, double distance, Camera& camera) {
  const Side& side = framing.side;
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  const Extent across{-reach.left, reach.right}, along{-reach.below, reach.above};
  const FreePart across_part = free_part(framing.insets.left, framing.insets.right);
  const FreePart along_part = free_part(framing.insets.bottom, framing.insets.top);
  const double shorter = std::min(framing.width_px, framing.height_px);
  const double side_length = std::max(across.size() * shorter / framing.width_px / across_part.size(),
                                      along.size() * shorter / framing.height_px / along_part.size());
  camera.projection = Projection::orthographic;
  camera.shorter_side = side_length > 0 ? side_length : 1;

  // Origins are rounded to binary32, and must not come to lie in a sphere.
  distance = std::max(distance, reach.front + 0.5 * camera.shorter_side);
  const double half_px = 0.5 * camera.shorter_side / shorter;
  const Vec3d shift = (across.middle() - across_part.middle() * half_px * framing.width_px) * right +
                      (along.middle() - along_part.middle() * half_px * framing.height_px) * up;
  camera.look_at = framing.middle + shift;
  camera.eye = camera.look_at + distance * side.back;
  const double largest = std::max({std::abs(camera.eye.x), std::abs(camera.eye.y), std::abs(camera.eye.z)});
  camera.eye = camera.eye + 0x1p-20 * largest * side.back;
}

// The planes to the left and right, and below and above.
struct Spans {
  Span across, along;

  explicit Spans(const Framing& framing)
      : across(tangent(framing), framing.width_px, shorter(framing),
               free_part(framing.insets.left, framing.insets.right)),
        along(tangent(framing), framing.height_px, shorter(framing),
              free_part(framing.insets.bottom, framing.insets.top)) {}

 private:
  // The tangents of the angles that the free interval of the picture spans to either side.
  static double tangent(const Framing& framing) { return tan_deg(framing.lens.fov_deg / 2); }
  static double shorter(const Framing& framing) { return std::min(framing.width_px, framing.height_px); }
};

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

ViewReach reach_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Framing& framing) {
  const Side& side = framing.side;
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  Spans spans(framing);
  Extent across, along;
  ViewReach reach;
  for_each_in_view(spheres, points, [&](Vec3d place, double radius) {
    const Vec3d centre = place - framing.middle;
    const double depth = dot(centre, side.back);
    const double rightwards = dot(centre, right), upwards = dot(centre, up);
    spans.across.add(rightwards, depth, radius);
    spans.along.add(upwards, depth, radius);
    reach.front = std::max(reach.front, depth + radius);
    across.add(rightwards, radius);
    along.add(upwards, radius);
  });
  reach.across_low = spans.across.low();
  reach.across_high = spans.across.high();
  reach.along_low = spans.along.low();
  reach.along_high = spans.along.high();
  reach.left = -across.low;
  reach.right = across.high;
  reach.below = -along.low;
  reach.above = along.high;
  return reach;
}

Camera camera_for(const Framing& framing, const ViewReach& reach) {
  const Side& side = framing.side;
  const Vec3d right = normalized(cross(side.up, side.back));
  const Vec3d up = cross(side.back, right);
  Spans spans(framing);
  spans.across.take(reach.across_low, reach.across_high);
  spans.along.take(reach.along_low, reach.along_high);
  double distance = std::max({reach.front, spans.across.distance(), spans.along.distance()});
  if (!(distance > 0)) distance = 1;
  const Vec3d shift = spans.across.shift(distance) * right + spans.along.shift(distance) * up;

  Camera camera;
  camera.look_at = framing.middle + shift;
  camera.eye = camera.look_at + distance * side.back;
  camera.up = up;
  camera.fov_deg = framing.lens.fov_deg;
  if (framing.lens.projection == Projection::orthographic) frame_parallel(framing, reach, distance, camera);
  return camera;
}

Vec3d middle_of(const SphereSet::Bounds& bounds) {
  return bounds.lo.x <= bounds.hi.x ? bounds.lo + 0.5 * (bounds.hi - bounds.lo) : Vec3d{};
}

namespace {

// The camera of frame_spheres(), with these points inside the picture too.
Camera frame(const SphereSet& spheres, const std::vector<Vec3d>& points, const Side& side, const Lens& lens,
             int width_px, int height_px, const Insets& insets) {
  const Framing framing{side, lens, width_px, height_px, insets, middle_of(spheres.bounds())};
  return camera_for(framing, reach_in_view(spheres, points, framing));
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
  // Offsets up and left, as fractions of the distance. With these, shading shows shape, and shadows fall to the lower
  // right.
  const Vec3d view = camera.look_at - camera.eye;
  const double distance = length(view);
  const Vec3d forward = view / distance;
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  return {camera.eye + distance * (0.8 * up - 0.5 * right - 0.2 * forward), {1, 1, 1}};
}

}  // namespace bihive
