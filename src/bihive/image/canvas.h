// A picture to draw on: rectangles, convex polygons and lines, anti-aliased by the share of each pixel that they cover.
//
// Positions are in pixels from the top left corner: (0.5, 0.5) is the first pixel's centre. Parts outside the picture
// are cut off. Only + - x / sqrt and floor are used, in a fixed order, so the bits are the same everywhere.
#pragma once

#include <vector>

#include "bihive/math/vec3.h"

namespace bihive {

struct CanvasPoint {
  double x, y;
};

/// x0 <= x < x1, y0 <= y < y1.
struct CanvasArea {
  double x0, y0, x1, y1;

  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
};

class Canvas {
 public:
  /// Black. Sides of at least 1 pixel.
  Canvas(int width_px, int height_px);

  /// After this call, nothing outside these whole pixels is drawn.
  void clip_to(int x0, int y0, int x1, int y1);

  /// Adds colour x opacity x covered share. So shapes side by side leave no seams, and shapes finer than a pixel
  /// average exactly.
  void add_rectangle(const CanvasArea& area, Vec3d colour, double opacity = 1);

  /// Blends over the present content. The polygon must be convex; its points may run either way round. Vertical
  /// coverage comes in quarters of a pixel. Points must be finite.
  void blend_polygon(const CanvasPoint* points, int count, Vec3d colour, double opacity);

  /// A straight line with square ends at a and b. Nothing is drawn if a and b coincide.
  void blend_line(CanvasPoint a, CanvasPoint b, double width, Vec3d colour, double opacity);

  int width() const { return width_; }
  int height() const { return height_; }
  Vec3f& at(int x, int y) { return pixels_[static_cast<std::size_t>(y) * std::size_t(width_) + std::size_t(x)]; }
  /// Returns the pixels row by row from the top, and leaves the canvas without them.
  std::vector<Vec3f> take_pixels() { return std::move(pixels_); }

 private:
  void add_span(double x0, double x1, double weight);

  int width_, height_;
  int clip_x0_ = 0, clip_y0_ = 0, clip_x1_, clip_y1_;
  std::vector<Vec3f> pixels_;
  std::vector<double> steps_;  // along one row: how much the coverage grows from each pixel to the next
};

}  // namespace bihive
