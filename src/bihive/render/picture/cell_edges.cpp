#include "bihive/render/picture/cell_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bihive {
namespace {

constexpr double kMostEdges = 10000;

// With one eye, a line is cut before it comes so near, as a share of the depth of its farther end.
constexpr double kNearestShare = 0x1p-20;

}  // namespace

CellEdges::CellEdges(const Scene& scene, const Camera& camera, const std::optional<CellLines>& lines, int width_px,
                     int height_px)
    : parallel_(camera.projection == Projection::orthographic) {
  if (!lines || !scene.spheres.cell()) return;
  lines_ = *lines;
  opacity_ = std::min(lines_.width_px, 1.0);
  lines_.width_px = std::max(lines_.width_px, 1.0);
  const PixelPlaces places(camera, width_px, height_px);
  const Cell& cell = *scene.spheres.cell();
  const Vec3d origin = scene.spheres.to_local(cell.origin);
  const Images& images = scene.spheres.images();

  // Along each vector one line from end to end for each corner of the cells across it.
  std::array<double, 3> counts{};
  for (std::size_t k = 0; k < 3; ++k) counts[k] = images.counts[k];
  const double all =
      (counts[1] + 1) * (counts[2] + 1) + (counts[0] + 1) * (counts[2] + 1) + (counts[0] + 1) * (counts[1] + 1);
  const bool outer_alone = all > kMostEdges;
  for (std::size_t along = 0; along < 3; ++along) {
    const std::size_t u = (along + 1) % 3;
    const std::size_t v = (along + 2) % 3;
    const Vec3d whole = counts[along] * cell.vectors[along];
    for (double i = 0; i <= counts[u]; i += outer_alone ? counts[u] : 1)
      for (double j = 0; j <= counts[v]; j += outer_alone ? counts[v] : 1) {
        const Vec3d corner = origin + i * cell.vectors[u] + j * cell.vectors[v];
        add(corner, corner + whole, places);
      }
  }
}

void CellEdges::add(Vec3d from, Vec3d to, const PixelPlaces& places) {
  Vec3d a = places.from_eye(from);
  Vec3d b = places.from_eye(to);
  if (!parallel_) {
    const double nearest = kNearestShare * std::max(a.z, b.z);
    if (!(nearest > 0)) return;
    const auto cut = [nearest](Vec3d behind, Vec3d before) {
      return before + (before.z - nearest) / (before.z - behind.z) * (behind - before);
    };
    if (a.z < nearest) a = cut(a, b);
    if (b.z < nearest) b = cut(b, a);
  } else if (!(std::max(a.z, b.z) > 0)) {
    return;
  }
  const auto on_picture = [&](Vec3d point) {
    return Vec3d{places.x_px(point), places.y_px(point), parallel_ ? point.z : 1 / point.z};
  };
  const EdgeOnPicture edge{on_picture(a), on_picture(b)};
  if (is_finite(edge.from) && is_finite(edge.to)) edges_.push_back(edge);
}

void CellEdges::find_near(const Tile& tile, std::vector<EdgeOnPicture>& found) const {
  found.clear();
  const double border = lines_.width_px / 2 + 1;
  const double lo[2] = {tile.x0 - border, tile.y0 - border};
  const double hi[2] = {tile.x1 + border, tile.y1 + border};
  for (const EdgeOnPicture& edge : edges_) {
    // The part of the line between the tile's sides, if any.
    double first = 0;
    double last = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const double from = edge.from[axis];
      const double along = edge.to[axis] - from;
      if (along == 0) {
        if (from < lo[axis] || from > hi[axis]) last = -1;
        continue;
      }
      const double one = (lo[axis] - from) / along;
      const double other = (hi[axis] - from) / along;
      first = std::max(first, std::min(one, other));
      last = std::min(last, std::max(one, other));
    }
    if (first <= last) found.push_back(edge);
  }
}

double CellEdges::depth_at(const std::vector<EdgeOnPicture>& edges, double x_px, double y_px) const {
  double nearest = std::numeric_limits<double>::infinity();
  const double reach = lines_.width_px * lines_.width_px / 4;
  for (const EdgeOnPicture& edge : edges) {
    // The point of the line that is nearest on the picture.
    const double x = edge.to.x - edge.from.x;
    const double y = edge.to.y - edge.from.y;
    const double squared = x * x + y * y;
    const double share =
        squared > 0 ? std::clamp(((x_px - edge.from.x) * x + (y_px - edge.from.y) * y) / squared, 0.0, 1.0) : 0;
    const double off_x = edge.from.x + share * x - x_px;
    const double off_y = edge.from.y + share * y - y_px;
    if (!(off_x * off_x + off_y * off_y <= reach)) continue;
    const double along = edge.from.z + share * (edge.to.z - edge.from.z);
    const double depth = parallel_ ? along : 1 / along;
    if (depth > 0) nearest = std::min(nearest, depth);
  }
  return nearest;
}

}  // namespace bihive
