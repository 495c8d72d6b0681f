// Shapes with exact edges, and the share of each pixel that they cover: letters, lines, triangles, rectangles. Unlike
// Canvas, which draws whole pictures of light, they are blended over finished pixels (overlay.h).
//
// Positions are in pixels from the picture's top left corner, as on a Canvas. Only + - x / sqrt and floor are used, in
// a fixed order, so the bits are the same everywhere.
#pragma once

#include <string_view>
#include <vector>

#include "bihive/image/canvas.h"
#include "bihive/image/film.h"

namespace bihive {

class Font;

/// A union of closed outlines. Outlines of polygons may overlap each other; points must be finite and lie within some
/// ten thousand pixels of the picture.
class Shape {
 public:
  void add_rectangle(const CanvasArea& area);
  /// Its points may run either way round.
  void add_polygon(const std::vector<CanvasPoint>& points);
  /// With square ends at a and b. Nothing if a and b coincide.
  void add_line(CanvasPoint a, CanvasPoint b, double width);
  void add_disc(CanvasPoint centre, double radius);
  /// One line of text that begins at `start` on the line that letters stand on. `size`: of the font, in pixels. `font`:
  /// as in glyph_of() (image/font.h).
  void add_text(std::string_view utf8, CanvasPoint start, double size, const Font* font = nullptr);

  const std::vector<std::vector<CanvasPoint>>& outlines() const { return outlines_; }

 private:
  std::vector<std::vector<CanvasPoint>> outlines_;
};

/// The width of one line of text in pixels.
double text_width(std::string_view utf8, double size, const Font* font = nullptr);

/// A share from 0 to 1 for each of these pixels, row by row from the top. Outside of them it is 0.
struct CoverageMask {
  Tile pixels{0, 0, 0, 0};
  std::vector<float> shares;

  float at(int x, int y) const {
    if (x < pixels.x0 || x >= pixels.x1 || y < pixels.y0 || y >= pixels.y1) return 0;
    return shares[static_cast<std::size_t>(y - pixels.y0) * static_cast<std::size_t>(pixels.width()) +
                  static_cast<std::size_t>(x - pixels.x0)];
  }
};

/// How much of each pixel the shape covers: the exact area of its outlines.
CoverageMask mask_of(const Shape& shape);

/// A mask that is wider by `radius` pixels all around, with a soft edge.
CoverageMask widened(const CoverageMask& mask, double radius);

}  // namespace bihive
