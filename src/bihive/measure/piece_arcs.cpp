#include "bihive/measure/piece_arcs.h"

#include <cmath>

#include "bihive/base/check.h"
#include "bihive/math/elementary.h"
#include "bihive/measure/direction_angle.h"

namespace bihive::measure {
namespace {

constexpr double kDegreesOfRadian = 180 / kPi;

// Whether the arc goes through a point of its circle.
bool goes_through(const PieceArcs::Arc& arc, Vec3d point) {
  const Vec3d along = point - arc.c * arc.axis;
  double angle = direction_angle(dot(along, cross(arc.axis, arc.start)), dot(along, arc.start));
  if (angle < 0) angle += 2 * kPi;
  return angle <= arc.length;
}

}  // namespace

Vec3d PieceArcs::middle_of(const Arc& arc) {
  const SineCosine turn = sine_cosine_deg(0.5 * kDegreesOfRadian * arc.length);
  return arc.c * arc.axis + arc.s * (turn.cosine * arc.start + turn.sine * cross(arc.axis, arc.start));
}

int PieceArcs::piece_of(Vec3d point) const {
  BIHIVE_CHECK(!arcs.empty());
  const Vec3d from = normalized(point);
  // A great circle to the middle of an arc: a point near it, or opposite, gives none.
  for (const Arc& goal : arcs) {
    const Vec3d to = middle_of(goal), normal = cross(from, to);
    if (!(dot(normal, normal) > 0)) continue;
    const Vec3d up = cross(normalized(normal), from);
    double nearest = direction_angle(dot(to, up), dot(to, from));
    int piece = goal.piece;
    for (const Arc& arc : arcs) {
      // On the great circle, x.axis = c is A cos(angle) + B sin(angle) = c.
      const double A = dot(arc.axis, from), B = dot(arc.axis, up), r2 = A * A + B * B;
      if (!(arc.c * arc.c < r2)) continue;
      const double at = direction_angle(B, A), half = direction_angle(std::sqrt(r2 - arc.c * arc.c), arc.c);
      for (double angle : {at - half, at + half}) {
        if (angle < 0) angle += 2 * kPi;
        if (!(angle < nearest)) continue;
        const SineCosine turn = sine_cosine_deg(kDegreesOfRadian * angle);
        if (!goes_through(arc, turn.cosine * from + turn.sine * up)) continue;
        nearest = angle;
        piece = arc.piece;
      }
    }
    return piece;
  }
  return arcs.front().piece;
}

}  // namespace bihive::measure
