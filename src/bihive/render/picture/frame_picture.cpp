#include "bihive/render/frame_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/geometry/each_sphere.h"
#include "bihive/math/elementary.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/tree_picture.h"
#include "bihive/scene/framed_spheres.h"
#include "bihive/scene/framing_cell.h"

namespace bihive {
namespace {

/// Between a label and the spheres, as a share of the picture's shorter side.
constexpr double kBesideLabels = 0.015;

/// A scale bar may change its length, and so its place, when the camera moves to make room.
constexpr int kMostMoves = 4;

// Whether some sphere may be seen inside an area of the picture. At the area's corners it says yes too early, by less
// than a sphere's radius.
class AreaInView {
 public:
  AreaInView(const Camera& camera, const RenderSettings& settings, const CanvasArea& area) : camera_(camera) {
    const double width = settings.width_px;
    const double height = settings.height_px;
    const double shorter = std::min(width, height);
    forward_ = normalized(camera.look_at - camera.eye);
    right_ = normalized(cross(forward_, camera.up));
    up_ = cross(right_, forward_);
    // A pixel's size: at distance 1 from the eye, or of parallel rays.
    const bool parallel = camera.projection == Projection::orthographic;
    const double px = parallel ? camera.shorter_side / shorter : 2 * tan_deg(camera.fov_deg / 2) / shorter;
    edges_[0] = {-right_, -(area.x0 - 0.5 * width) * px};
    edges_[1] = {right_, (area.x1 - 0.5 * width) * px};
    edges_[2] = {up_, -(area.y0 - 0.5 * height) * px};
    edges_[3] = {-up_, (area.y1 - 0.5 * height) * px};
    for (Edge& edge : edges_) edge.slope = parallel ? 1 : std::sqrt(1 + edge.at * edge.at);
  }

  bool meets(Vec3d centre, double radius) const {
    const Vec3d place = centre - camera_.eye;
    const double depth = camera_.projection == Projection::orthographic ? 1 : dot(place, forward_);
    for (const Edge& edge : edges_)
      if (dot(place, edge.outward) - edge.at * depth >= radius * edge.slope) return false;
    return true;
  }

 private:
  struct Edge {
    Vec3d outward;
    double at;  ///< along `outward`, at depth 1
    double slope = 1;
  };

  const Camera& camera_;
  Vec3d forward_, right_, up_;
  Edge edges_[4];
};

}  // namespace

bool covers_spheres(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings,
                    const CanvasArea& area) {
  // Edges of a cell go through the picture from corner to corner, so that they may be anywhere.
  if (settings.cell_lines && spheres.cell()) return true;
  const AreaInView in_view(camera, settings, area);
  bool meets = false;
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double radius) {
    if (!meets) meets = in_view.meets(centre, radius);
  });
  return meets;
}

std::int64_t spheres_around_eye(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings) {
  const AreaInView in_view(camera, settings, {0, 0, double(settings.width_px), double(settings.height_px)});
  const bool parallel = camera.projection == Projection::orthographic;
  const Vec3d forward = normalized(camera.look_at - camera.eye);
  std::int64_t count = 0;
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double radius) {
    const Vec3d place = centre - camera.eye;
    const bool around = parallel ? std::abs(dot(place, forward)) < radius && in_view.meets(centre, radius)
                                 : dot(place, place) < radius * radius;
    if (around) ++count;
  });
  return count;
}

std::int64_t spheres_outside(const SphereSet& spheres, const Camera& camera, const RenderSettings& settings) {
  const AreaInView in_view(camera, settings, {0, 0, double(settings.width_px), double(settings.height_px)});
  std::int64_t count = 0;
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double radius) {
    if (!in_view.meets(centre, radius)) ++count;
  });
  return count;
}

namespace {

// The labels that `covers(area)` names get a side each: title above, legend right, scale bar below, and the axes, which
// stand in a corner, the side of which they take the smaller share.
template <class Covers>
Insets widened(const Insets& before, const LabelAreas& areas, const RenderSettings& settings, const Covers& covers) {
  const double width = settings.width_px;
  const double height = settings.height_px;
  const double gap = kBesideLabels * std::min(width, height);
  Insets insets = before;
  const auto take = [](double& inset, double px, double of) { inset = std::max(inset, std::min(px / of, kMostInset)); };
  if (areas.title && covers(*areas.title)) take(insets.top, areas.title->y1 + gap, height);
  if (areas.legend && covers(*areas.legend)) take(insets.right, width - areas.legend->x0 + gap, width);
  if (areas.scale_bar && covers(*areas.scale_bar)) take(insets.bottom, height - areas.scale_bar->y0 + gap, height);
  if (areas.axes && covers(*areas.axes)) {
    if (width > height)
      take(insets.left, areas.axes->x1 + gap, width);
    else
      take(insets.bottom, height - areas.axes->y0 + gap, height);
  }
  return insets;
}

bool same(const Insets& a, const Insets& b) {
  return a.left == b.left && a.right == b.right && a.top == b.top && a.bottom == b.bottom;
}

}  // namespace

Camera frame_picture(const Scene& scene, const Side& side, const Lens& lens, const RenderSettings& settings) {
  if (settings.view == View::tree) return frame_tree(scene.spheres, side, lens, settings.width_px, settings.height_px);
  const FramedSpheres framed_spheres(scene, settings.fit_share);
  const SphereSet& spheres = framed_spheres.set();
  const auto framed = [&](const Insets& insets) {
    return settings.cell_lines ? frame_with_cell(spheres, side, lens, settings.width_px, settings.height_px, insets)
                               : frame_spheres(spheres, side, lens, settings.width_px, settings.height_px, insets);
  };
  const auto covers = [&](const Camera& camera, const CanvasArea& area) {
    return covers_spheres(spheres, camera, settings, area);
  };
  return frame_beside_labels(scene, settings, framed, covers);
}

Camera frame_selected(const Scene& scene, const SphereSet& selected, const Side& side, const Lens& lens,
                      const RenderSettings& settings) {
  RenderSettings without_cell = settings;
  without_cell.cell_lines.reset();
  const auto framed = [&](const Insets& insets) {
    return frame_spheres(selected, side, lens, settings.width_px, settings.height_px, insets);
  };
  const auto covers = [&](const Camera& camera, const CanvasArea& area) {
    return covers_spheres(selected, camera, without_cell, area);
  };
  return frame_beside_labels(scene, settings, framed, covers);
}

Camera frame_beside_labels(const Scene& scene, const RenderSettings& settings,
                           const std::function<Camera(const Insets&)>& framed,
                           const std::function<bool(const Camera&, const CanvasArea&)>& covers) {
  // Fill the picture; then make room for those labels alone that cover spheres.
  Insets insets;
  Camera camera = framed(insets);
  for (int attempt = 0; settings.labels.any() && attempt < kMostMoves; ++attempt) {
    const LabelAreas areas = label_areas(scene, camera, settings);
    const Insets next = widened(insets, areas, settings, [&](const CanvasArea& area) { return covers(camera, area); });
    if (same(next, insets)) break;
    insets = next;
    camera = framed(insets);
  }
  return camera;
}

Insets insets_of_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  if (!settings.labels.any()) return {};
  return widened({}, label_areas(scene, camera, settings), settings, [](const CanvasArea&) { return true; });
}

}  // namespace bihive
