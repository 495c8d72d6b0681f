#include "bihive/scene/turn.h"

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// Turns a towards b, both of length 1 and at right angles.
void turn_towards(Vec3d& a, Vec3d& b, double degrees) {
  const SineCosine angle = sine_cosine_deg(degrees);
  const Vec3d before = a;
  a = angle.cosine * before + angle.sine * b;
  b = angle.cosine * b - angle.sine * before;
}

}  // namespace

Side turned(const Side& side, const Turn& turn) {
  Vec3d back = side.back;
  Vec3d right = normalized(cross(side.up, side.back));
  Vec3d up = cross(back, right);
  turn_towards(back, right, turn.azimuth);
  turn_towards(back, up, turn.elevation);
  turn_towards(up, right, turn.roll);
  return {back, up};
}

Camera turned(const Camera& camera, const Turn& turn) {
  const Vec3d offset = camera.eye - camera.look_at;
  const double distance = length(offset);
  const Side side = turned(Side{offset / distance, normalized(camera.up)}, turn);
  Camera moved = camera;
  moved.eye = camera.look_at + distance * side.back;
  moved.up = side.up;
  return moved;
}

Camera turned_about(const Camera& camera, Vec3d axis, double degrees) {
  const SineCosine angle = sine_cosine_deg(degrees);
  const auto turned = [&](Vec3d v) {
    const Vec3d along = dot(v, axis) * axis;
    return along + angle.cosine * (v - along) + angle.sine * cross(axis, v);
  };
  Camera moved = camera;
  moved.eye = camera.look_at + turned(camera.eye - camera.look_at);
  moved.up = turned(camera.up);
  return moved;
}

}  // namespace bihive
