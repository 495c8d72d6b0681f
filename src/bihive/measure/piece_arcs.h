// The arcs that bound the pieces of a sphere's exposed part.
#pragma once

#include <vector>

#include "bihive/math/vec3.h"

namespace bihive::measure {

/// Of a unit sphere.
class PieceArcs {
 public:
  /// An exposed arc on the circle x.axis = c, of this length as an angle, counterclockwise about the axis from `start`,
  /// a unit vector from the circle's centre. s: the circle's radius.
  struct Arc {
    Vec3d axis;
    double c, s;
    Vec3d start;
    double length;
    int piece;
  };

  std::vector<Arc> arcs;

  /// The piece in which an exposed point lies: the one whose boundary a path along a great circle meets first. There
  /// must be an arc.
  int piece_of(Vec3d point) const;

  static Vec3d middle_of(const Arc& arc);
};

}  // namespace bihive::measure
