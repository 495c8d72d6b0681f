// The edges of periodic cells on a picture (CellLines of settings/picture_effects.h).
#pragma once

#include <optional>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/picture_effects.h"

namespace bihive {

/// One line between two points of the picture.
struct EdgeOnPicture {
  Vec3d from, to;  ///< x and y in pixels; z: the depth, or with one eye its inverse, which is even along the line
};

class CellEdges {
 public:
  /// Without lines or without a cell there are no edges. The lines of a replicated set run along all of its copies; if
  /// they are more than 10,000, there are those of the box around all copies alone.
  /// `lines`: with its width in pixels. Below one pixel, edges are a pixel wide and fainter: see opacity().
  CellEdges(const Scene& scene, const Camera& camera, const std::optional<CellLines>& lines, int width_px,
            int height_px);

  bool any() const { return !edges_.empty(); }
  Vec3d colour() const { return lines_.colour; }
  /// The share of its colour that a sample on an edge has.
  double opacity() const { return opacity_; }

  /// Those that may cover a place of the tile.
  void find_near(const Tile& tile, std::vector<EdgeOnPicture>& found) const;
  /// The depth along the view of the nearest of these lines at a place of the picture; +inf: none covers it.
  double depth_at(const std::vector<EdgeOnPicture>& edges, double x_px, double y_px) const;

 private:
  void add(Vec3d from, Vec3d to, const PixelPlaces& places);

  CellLines lines_;
  double opacity_ = 1;
  bool parallel_ = false;
  std::vector<EdgeOnPicture> edges_;
};

}  // namespace bihive
