// Post-processing: outlines, and fog by depth. Both depend on the first hits alone.
#pragma once

#include "bihive/math/vec3.h"

namespace bihive {

/// Blends in the background's colour by distance: the share grows linearly with the depth along the view, from 0 at
/// `start` to `strength` at `end` and beyond. Depths are fractions of the set's own depth: 0 at its nearest point (the
/// eye, if the eye is inside the set), 1 at its farthest. So the same fog fits any set.
struct Fog {
  double start = 0;       ///< finite, below `end`
  double end = 1;         ///< finite
  double strength = 0.5;  ///< 0 to 1
};

constexpr double kWidestOutlinePx = 16;  // in line units
constexpr double kWidestLinePx = 255;    // in pixels

/// The unit of the widths of outlines, creases and cell edges: a pixel; 1/720 of the picture's shorter side, so that a
/// picture looks alike in every size; a point in print, 1/72 inch.
enum class LineUnit { px, picture, pt };
constexpr double kLineUnitsOfPicture = 720;
constexpr double kPointsPerInch = 72;
constexpr double kDotsPerInchOfScreens = 96;

/// A line along the inner edge of whatever is in front of something else. A sample of a pixel lies on it if, at most
/// the line's width away and at the same position in its pixel, another sphere, the plane or the background is deeper
/// by more than `step` radii of the sampled sphere. A line is at most a sixth as wide as the radius of its sphere
/// appears, so that it does not cover small ones, and at most 255 pixels; one that is thinner than a pixel is a pixel
/// wide and fainter instead. Spheres may have a width of their own, and lines between groups that touch, without a
/// step: `outline_px` and `crease` of geometry/sphere_attributes.h.
struct Outline {
  double width_px = 1;    ///< in line units, 1 to kWidestOutlinePx
  double step = 2;        ///< radii, >= 0
  Vec3d colour{0, 0, 0};  ///< linear
};

/// The edges of the periodic cell and of each copy. Spheres occlude them.
struct CellLines {
  double width_px = 2;             ///< in line units, 1 to kWidestOutlinePx
  Vec3d colour{0.02, 0.02, 0.02};  ///< linear
};

}  // namespace bihive
