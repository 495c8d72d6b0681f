#include "bihive/image/canvas.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/check.h"

namespace bihive {
namespace {

constexpr int kRowsPerPixel = 4;

// The pixel that contains a position inside [lo, hi].
int pixel_of(double position, int lo, int hi) {
  return static_cast<int>(std::floor(std::clamp(position, double(lo), double(hi))));
}

// The part of pixel i that the stretch from lo to hi covers.
double covered(int i, double lo, double hi) {
  return std::max(0.0, std::min(hi, i + 1.0) - std::max(lo, double(i)));
}

}  // namespace

Canvas::Canvas(int width_px, int height_px)
    : width_(width_px),
      height_(height_px),
      clip_x1_(width_px),
      clip_y1_(height_px),
      pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      steps_(static_cast<std::size_t>(width_px) + 2) {
  BIHIVE_CHECK(width_px >= 1 && height_px >= 1);
}

void Canvas::clip_to(int x0, int y0, int x1, int y1) {
  clip_x0_ = std::clamp(x0, 0, width_);
  clip_y0_ = std::clamp(y0, 0, height_);
  clip_x1_ = std::clamp(x1, clip_x0_, width_);
  clip_y1_ = std::clamp(y1, clip_y0_, height_);
}

void Canvas::add_rectangle(const CanvasArea& area, Vec3d colour, double opacity) {
  if (!(area.x0 < area.x1 && area.y0 < area.y1)) return;
  const int x_end = std::min(clip_x1_, pixel_of(area.x1, clip_x0_, clip_x1_) + 1);
  const int y_end = std::min(clip_y1_, pixel_of(area.y1, clip_y0_, clip_y1_) + 1);
  for (int y = pixel_of(area.y0, clip_y0_, clip_y1_); y < y_end; ++y) {
    const double row = opacity * covered(y, area.y0, area.y1);
    for (int x = pixel_of(area.x0, clip_x0_, clip_x1_); x < x_end; ++x) {
      Vec3f& pixel = at(x, y);
      pixel = pixel + to_float(colour * (row * covered(x, area.x0, area.x1)));
    }
  }
}

// Records that the row is covered from x0 to x1. The running sum of steps_ is the coverage of each pixel.
void Canvas::add_span(double x0, double x1, double weight) {
  x0 = std::clamp(x0, double(clip_x0_), double(clip_x1_));
  x1 = std::clamp(x1, double(clip_x0_), double(clip_x1_));
  const auto first = static_cast<std::size_t>(x0);
  const auto last = static_cast<std::size_t>(x1);
  const double before = x0 - std::floor(x0);
  const double after = x1 - std::floor(x1);
  steps_[first] += weight * (1 - before);
  steps_[first + 1] += weight * before;
  steps_[last] -= weight * (1 - after);
  steps_[last + 1] -= weight * after;
}

void Canvas::blend_polygon(const CanvasPoint* points, int count, Vec3d colour, double opacity) {
  // Find the rows and columns that the polygon may touch.
  double top = points[0].y, bottom = points[0].y, left = points[0].x, right = points[0].x;
  for (int i = 1; i < count; ++i) {
    top = std::min(top, points[i].y);
    bottom = std::max(bottom, points[i].y);
    left = std::min(left, points[i].x);
    right = std::max(right, points[i].x);
  }
  if (!(top < bottom) || right <= clip_x0_ || left >= clip_x1_) return;
  const int x_first = pixel_of(left, clip_x0_, clip_x1_);
  const int x_end = std::min(clip_x1_, pixel_of(right, clip_x0_, clip_x1_) + 1);
  const int y_end = std::min(clip_y1_, pixel_of(bottom, clip_y0_, clip_y1_) + 1);
  for (int y = pixel_of(top, clip_y0_, clip_y1_); y < y_end; ++y) {
    // Cut the polygon with a few horizontal lines in each row.
    bool touched = false;
    for (int part = 0; part < kRowsPerPixel; ++part) {
      const double line = y + (part + 0.5) / kRowsPerPixel;
      double x0 = right, x1 = left;
      for (int i = 0; i < count; ++i) {
        const CanvasPoint a = points[i];
        const CanvasPoint b = points[i + 1 < count ? i + 1 : 0];
        if ((a.y <= line) == (b.y <= line)) continue;
        const double x = a.x + (line - a.y) / (b.y - a.y) * (b.x - a.x);
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
      }
      if (!(x0 < x1)) continue;
      add_span(x0, x1, 1.0 / kRowsPerPixel);
      touched = true;
    }
    if (!touched) continue;

    // Sum up the coverage from the left, and blend.
    double coverage = 0;
    for (int x = x_first; x < x_end; ++x) {
      coverage += steps_[static_cast<std::size_t>(x)];
      const double share = opacity * std::clamp(coverage, 0.0, 1.0);
      Vec3f& pixel = at(x, y);
      pixel = to_float(to_double(pixel) * (1 - share) + colour * share);
    }
    std::fill(steps_.begin() + x_first, steps_.begin() + std::min(x_end + 2, width_ + 2), 0.0);
  }
}

void Canvas::blend_line(CanvasPoint a, CanvasPoint b, double width, Vec3d colour, double opacity) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length_px = std::sqrt(dx * dx + dy * dy);
  if (!(length_px > 0)) return;
  const double ox = -dy / length_px * (0.5 * width);
  const double oy = dx / length_px * (0.5 * width);
  const CanvasPoint corners[4] = {
      {a.x + ox, a.y + oy}, {b.x + ox, b.y + oy}, {b.x - ox, b.y - oy}, {a.x - ox, a.y - oy}};
  blend_polygon(corners, 4, colour, opacity);
}

}  // namespace bihive
