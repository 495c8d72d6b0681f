#include "bihive/viewer/whole_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bihive/base/parallel.h"
#include "bihive/math/elementary.h"
#include "bihive/scene/framing.h"

namespace bihive {
namespace {

// The tangent of the angle to one side of the picture, and the length of (1, tangent).
struct Slope {
  double tangent, length;

  explicit Slope(double t) : tangent(t), length(std::sqrt(1 + t * t)) {}
  // The distance of the eye from look_at at which a sphere touches that side from inside.
  double distance(double aside, double depth, double radius) const {
    return depth + (std::abs(aside) + radius * length) / tangent;
  }
  bool has_room(double aside, double room, double radius) const {
    return std::abs(aside) + radius * length < room * tangent;
  }
};

constexpr double kSurely = 1 - 1e-9;  // a distance less this is below it in spite of rounding
constexpr std::int64_t kSpheresAtOnce = 1 << 14;

// What a camera needs for some of the spheres: the greatest of each.
struct Needed {
  double distance = 0, side_length = 0, front = 0;

  void take(const Needed& other) {
    distance = std::max(distance, other.distance);
    side_length = std::max(side_length, other.side_length);
    front = std::max(front, other.front);
  }
};

// The copies at the corners of the block of images. The distance that a sphere needs is the largest of a few linear
// functions of its position, so no other copy needs more than these.
std::vector<std::int64_t> outermost_copies(const Images& images) {
  std::vector<std::int64_t> copies;
  copies.reserve(8);
  for (int corner = 0; corner < 8; ++corner) {
    std::array<std::int32_t, 3> at{};
    bool is_new = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0) continue;
      at[axis] = images.counts[axis] - 1;
      is_new = is_new && at[axis] > 0;
    }
    if (is_new) copies.push_back(images.number(at));
  }
  return copies;
}

}  // namespace

Camera with_all_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Camera& camera,
                        PictureSizePx size) {
  const Vec3d offset = camera.eye - camera.look_at;
  const Vec3d back = normalized(offset);
  const Vec3d right = normalized(cross(camera.up, back));
  const Vec3d up = cross(back, right);
  const double shorter = std::min(size.width, size.height);
  const double tangent = tan_deg(camera.fov_deg / 2) * (1 - 2 * kFreeBorder);
  const Slope across{tangent * size.width / shorter}, along{tangent * size.height / shorter};

  const auto add = [&](Vec3d place, double radius, Needed& all) {
    const Vec3d centre = place - camera.look_at;
    const double x = dot(centre, right), y = dot(centre, up), z = dot(centre, back);
    if (camera.projection != Projection::orthographic) {
      // Most spheres need less than some other one: that is known without a division.
      const double room = kSurely * all.distance - z;
      if (across.has_room(x, room, radius) && along.has_room(y, room, radius)) return;
    }
    all.front = std::max(all.front, z + radius);
    all.distance = std::max({all.distance, across.distance(x, z, radius), along.distance(y, z, radius)});
    all.side_length = std::max({all.side_length, 2 * (std::abs(x) + radius) * shorter / size.width,
                                2 * (std::abs(y) + radius) * shorter / size.height});
  };
  const double unit = spheres.inverse_scale();
  const std::vector<std::int64_t> copies = outermost_copies(spheres.images());
  std::vector<Needed> parts(static_cast<std::size_t>((spheres.size() + kSpheresAtOnce - 1) / kSpheresAtOnce));
  parallel_for(0, static_cast<std::int64_t>(parts.size()), [&](std::int64_t part) {
    Needed all;
    const std::int64_t end = std::min(spheres.size(), (part + 1) * kSpheresAtOnce);
    for (const std::int64_t copy : copies)
      for (std::int64_t id = part * kSpheresAtOnce; id < end; ++id)
        add(spheres.in_world(spheres.stored_centre(copy * spheres.size() + id) * unit),
            spheres.stored_radius(id) * unit, all);
    parts[static_cast<std::size_t>(part)] = all;
  });
  Needed needed;
  for (const Needed& part : parts) needed.take(part);
  for (const Vec3d point : points) add(point, 0, needed);

  double distance = needed.distance;
  Camera moved = camera;
  if (camera.projection == Projection::orthographic) {
    moved.shorter_side = std::max(camera.shorter_side, needed.side_length / (1 - 2 * kFreeBorder));
    // Origins are rounded to binary32, and must not come to lie in a sphere.
    distance = needed.front + 0.5 * moved.shorter_side;
  }
  if (distance > length(offset)) moved.eye = camera.look_at + distance * back;
  return check_camera(moved) ? moved : camera;
}

}  // namespace bihive
