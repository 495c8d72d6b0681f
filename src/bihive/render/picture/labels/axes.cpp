#include <algorithm>
#include <array>
#include <cmath>

#include "bihive/image/font.h"
#include "bihive/render/picture/labels/parts.h"

namespace bihive {
namespace {

constexpr double kArmEm = 2.6;      // of an axis that lies in the picture
constexpr double kHeadEm = 0.7;     // length of an arrow's head
constexpr double kHeadWidth = 0.6;  // in ems
constexpr double kShaftEm = 0.16;
constexpr double kLetterGap = 0.62;  // from an arrow's tip to its letter's middle
constexpr double kRoomEm = 3.6;      // from the picture's margin to the corner of the axes

struct ProjectedAxis {
  const char* name;
  Vec3d colour;  // of the screen, told apart by colour-blind people [OkabeIto2008]
  double x, y;   // to the right and down, of length 1 in the picture's plane
  double depth;  // towards the viewer
};

std::array<ProjectedAxis, 3> projected_axes(const Camera& camera) {
  const Vec3d forward = normalized(camera.look_at - camera.eye);
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  return {{{"x", {0.835, 0.369, 0}, right.x, -up.x, -forward.x},
           {"y", {0, 0.62, 0.451}, right.y, -up.y, -forward.y},
           {"z", {0, 0.447, 0.698}, right.z, -up.z, -forward.z}}};
}

// The shaft and head of an arrow from `from`; a head that points at the viewer or away is as short as it looks.
Shape arrow(CanvasPoint from, const ProjectedAxis& axis, double em) {
  Shape shape;
  const double length_px = std::sqrt(axis.x * axis.x + axis.y * axis.y);
  if (!(length_px > 1e-9)) return shape;
  const CanvasPoint tip{from.x + kArmEm * em * axis.x, from.y + kArmEm * em * axis.y};
  const CanvasPoint neck{tip.x - kHeadEm * em * axis.x, tip.y - kHeadEm * em * axis.y};
  const double side_x = -axis.y / length_px * (0.5 * kHeadWidth * em);
  const double side_y = axis.x / length_px * (0.5 * kHeadWidth * em);
  shape.add_line(from, neck, kShaftEm * em);
  shape.add_polygon({tip, {neck.x + side_x, neck.y + side_y}, {neck.x - side_x, neck.y - side_y}});
  return shape;
}

// A letter with its middle here.
void write_letter(LabelPen& pen, const char* letter, CanvasPoint middle) {
  constexpr double kHalfOfX = 0.27;  // half of the height of small letters
  pen.write(letter, {middle.x - 0.5 * pen.width_of(letter, pen.em()), middle.y + kHalfOfX * pen.em()}, 1);
}

}  // namespace

void draw_axes(LabelPen& pen, const Camera& camera) {
  const double em = pen.em();
  const double room = pen.margin() + kRoomEm * em;
  const CanvasPoint corner{room, pen.height() - room};
  std::array<ProjectedAxis, 3> axes = projected_axes(camera);
  std::stable_sort(axes.begin(), axes.end(),
                   [](const ProjectedAxis& a, const ProjectedAxis& b) { return a.depth < b.depth; });

  // Far arrows first; the corner's disc hides what points away, and stands for what points at the viewer.
  bool corner_is_drawn = false;
  for (const ProjectedAxis& axis : axes) {
    if (!corner_is_drawn && axis.depth > 0) {
      Shape disc;
      disc.add_disc(corner, 1.2 * kShaftEm * em);
      pen.draw(disc);
      corner_is_drawn = true;
    }
    pen.draw(arrow(corner, axis, em), axis.colour);
  }
  for (const ProjectedAxis& axis : axes) {
    const double length_px = std::sqrt(axis.x * axis.x + axis.y * axis.y);
    // The letter of an axis without a direction in the picture stands beside the corner, away from the other two.
    const CanvasPoint to = length_px > 0.05 ? CanvasPoint{axis.x / length_px, axis.y / length_px}
                                            : CanvasPoint{-0.70710678118654752, 0.70710678118654752};
    const double distance = (kArmEm * length_px + kLetterGap) * em;
    write_letter(pen, axis.name, {corner.x + distance * to.x, corner.y + distance * to.y});
  }
}

}  // namespace bihive
