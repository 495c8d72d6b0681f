#include "bihive/image/shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bihive/image/font.h"
#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// Curves become polygons that are at most this far away from them, in pixels.
constexpr double kFlatness = 0.02;
constexpr int kMostPiecesOfCurve = 64;
constexpr int kCornersOfDisc = 64;

CanvasPoint between(CanvasPoint a, CanvasPoint b) {
  return {0.5 * a.x + 0.5 * b.x, 0.5 * a.y + 0.5 * b.y};
}

// Appends a quadratic curve from the last point to `end`.
void append_curve(std::vector<CanvasPoint>& points, CanvasPoint control, CanvasPoint end) {
  // Halving a curve quarters its distance from the chord.
  const CanvasPoint start = points.back();
  const double bend_x = start.x - 2 * control.x + end.x;
  const double bend_y = start.y - 2 * control.y + end.y;
  const double bend = std::sqrt(bend_x * bend_x + bend_y * bend_y) / 4;
  const double wanted = std::floor(std::sqrt(bend / kFlatness)) + 1;
  const int pieces = static_cast<int>(std::min(wanted, double(kMostPiecesOfCurve)));
  for (int i = 1; i < pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double s = 1 - t;
    points.push_back({s * s * start.x + 2 * s * t * control.x + t * t * end.x,
                      s * s * start.y + 2 * s * t * control.y + t * t * end.y});
  }
  points.push_back(end);
}

// A contour of a letter as a polygon. Between two control points lies a point of the curve, in the middle.
std::vector<CanvasPoint> flattened(const std::vector<OutlinePoint>& contour, CanvasPoint origin, double size) {
  const auto count = contour.size();
  const auto place = [&](std::size_t i) {
    return CanvasPoint{origin.x + size * contour[i % count].x, origin.y - size * contour[i % count].y};
  };
  if (count < 2) return {};
  std::size_t first = 0;
  while (first < count && !contour[first].on_curve) ++first;
  const bool all_control = first == count;
  if (all_control) first = 0;
  std::vector<CanvasPoint> points{all_control ? between(place(count - 1), place(0)) : place(first)};
  const std::size_t begin = all_control ? 0 : first + 1;
  for (std::size_t i = begin; i < begin + count; ++i) {
    if (contour[i % count].on_curve) {
      points.push_back(place(i));
      continue;
    }
    const bool next_on_curve = contour[(i + 1) % count].on_curve;
    append_curve(points, place(i), next_on_curve ? place(i + 1) : between(place(i), place(i + 1)));
    if (next_on_curve) ++i;
  }
  return points;
}

// Adds up the signed area to the right of edges: in each pixel the change against its left neighbour.
class AreaSum {
 public:
  explicit AreaSum(const Tile& pixels)
      : pixels_(pixels),
        stride_(static_cast<std::size_t>(pixels.width()) + 2),
        changes_(stride_ * static_cast<std::size_t>(pixels.height())) {}

  void add_edge(CanvasPoint a, CanvasPoint b) {
    if (a.y == b.y) return;
    const double direction = a.y < b.y ? 1 : -1;
    if (b.y < a.y) std::swap(a, b);
    const double x_per_y = (b.x - a.x) / (b.y - a.y);
    const double left = std::min(a.x, b.x);
    const double right = std::max(a.x, b.x);
    const int y_end = static_cast<int>(std::ceil(b.y));
    for (int y = static_cast<int>(std::floor(a.y)); y < y_end; ++y) {
      const double top = std::max(a.y, double(y));
      const double bottom = std::min(b.y, y + 1.0);
      if (!(top < bottom)) continue;
      const double x_top = std::clamp(a.x + (top - a.y) * x_per_y, left, right);
      const double x_bottom = std::clamp(a.x + (bottom - a.y) * x_per_y, left, right);
      add_in_row(y, std::min(x_top, x_bottom), std::max(x_top, x_bottom), direction * (bottom - top));
    }
  }

  std::vector<float> shares() const {
    const auto width = static_cast<std::size_t>(pixels_.width());
    const auto height = static_cast<std::size_t>(pixels_.height());
    std::vector<float> shares(width * height);
    for (std::size_t y = 0; y < height; ++y) {
      double sum = 0;
      for (std::size_t x = 0; x < width; ++x) {
        sum += double(changes_[y * stride_ + x]);
        // What rounding leaves behind an edge is nothing.
        const double share = std::abs(sum);
        shares[y * width + x] = share < 1e-5 ? 0.0F : static_cast<float>(std::min(share, 1.0));
      }
    }
    return shares;
  }

 private:
  // An edge that crosses x0 to x1 evenly while it covers `height` of a row.
  void add_in_row(int y, double x0, double x1, double height) {
    float* const row = &changes_[static_cast<std::size_t>(y - pixels_.y0) * stride_];
    const int first = static_cast<int>(std::floor(x0));
    const int last = std::max(first, static_cast<int>(std::ceil(x1)) - 1);
    double before = 0;  // the area of the pixels so far
    double height_so_far = 0;
    for (int x = first; x <= last; ++x) {
      // The edge's height inside of this pixel; to its right, the pixel is covered.
      const double from = std::max(x0, double(x));
      const double to = std::min(x1, x + 1.0);
      const double part = x == last ? height - height_so_far : height * ((to - from) / (x1 - x0));
      const double area = height_so_far + part * (x + 1 - 0.5 * (from + to));
      row[x - pixels_.x0] += static_cast<float>(area - before);
      before = area;
      height_so_far += part;
    }
    row[last + 1 - pixels_.x0] += static_cast<float>(height - before);
  }

  Tile pixels_;
  std::size_t stride_;
  std::vector<float> changes_;
};

// The pixels that the outlines touch.
Tile bounds_of(const std::vector<std::vector<CanvasPoint>>& outlines) {
  bool any = false;
  CanvasArea area{0, 0, 0, 0};
  for (const std::vector<CanvasPoint>& outline : outlines)
    for (const CanvasPoint point : outline) {
      if (!any) area = {point.x, point.y, point.x, point.y};
      any = true;
      area = {std::min(area.x0, point.x), std::min(area.y0, point.y), std::max(area.x1, point.x),
              std::max(area.y1, point.y)};
    }
  return {static_cast<int>(std::floor(area.x0)), static_cast<int>(std::floor(area.y0)),
          static_cast<int>(std::ceil(area.x1)), static_cast<int>(std::ceil(area.y1))};
}

}  // namespace

void Shape::add_rectangle(const CanvasArea& area) {
  add_polygon({{area.x0, area.y0}, {area.x1, area.y0}, {area.x1, area.y1}, {area.x0, area.y1}});
}

void Shape::add_polygon(const std::vector<CanvasPoint>& points) {
  // All polygons run the same way round, so that two of them never cancel.
  double doubled_area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CanvasPoint a = points[i];
    const CanvasPoint b = points[(i + 1) % points.size()];
    doubled_area += a.x * b.y - b.x * a.y;
  }
  outlines_.push_back(points);
  if (doubled_area < 0) std::reverse(outlines_.back().begin(), outlines_.back().end());
}

void Shape::add_line(CanvasPoint a, CanvasPoint b, double width) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length_px = std::sqrt(dx * dx + dy * dy);
  if (!(length_px > 0)) return;
  const double ox = -dy / length_px * (0.5 * width);
  const double oy = dx / length_px * (0.5 * width);
  add_polygon({{a.x + ox, a.y + oy}, {b.x + ox, b.y + oy}, {b.x - ox, b.y - oy}, {a.x - ox, a.y - oy}});
}

void Shape::add_disc(CanvasPoint centre, double radius) {
  std::vector<CanvasPoint> points;
  for (int i = 0; i < kCornersOfDisc; ++i) {
    const SineCosine turn = sine_cosine_deg(i * 360.0 / kCornersOfDisc);
    points.push_back({centre.x + radius * turn.cosine, centre.y + radius * turn.sine});
  }
  add_polygon(points);
}

void Shape::add_text(std::string_view utf8, CanvasPoint start, double size, const Font* font) {
  char32_t before = 0;
  double x = start.x;
  for (const char32_t character : characters_of(utf8)) {
    const Glyph& glyph = glyph_of(character, font);
    x += size * kerning_between(before, character, font);
    for (const std::vector<OutlinePoint>& contour : glyph.contours)
      if (std::vector<CanvasPoint> points = flattened(contour, {x, start.y}, size); !points.empty())
        outlines_.push_back(std::move(points));
    x += size * glyph.advance;
    before = character;
  }
}

double text_width(std::string_view utf8, double size, const Font* font) {
  char32_t before = 0;
  double width = 0;
  for (const char32_t character : characters_of(utf8)) {
    width += size * (kerning_between(before, character, font) + glyph_of(character, font).advance);
    before = character;
  }
  return width;
}

CoverageMask mask_of(const Shape& shape) {
  CoverageMask mask;
  mask.pixels = bounds_of(shape.outlines());
  AreaSum sum(mask.pixels);
  for (const std::vector<CanvasPoint>& outline : shape.outlines())
    for (std::size_t i = 0; i < outline.size(); ++i) sum.add_edge(outline[i], outline[(i + 1) % outline.size()]);
  mask.shares = sum.shares();
  return mask;
}

CoverageMask widened(const CoverageMask& mask, double radius) {
  constexpr float kInside = 0.25F;
  const int reach = static_cast<int>(std::ceil(radius + 0.5));
  const Tile& from = mask.pixels;
  if (from.width() <= 0 || from.height() <= 0) return mask;
  CoverageMask wide;
  wide.pixels = {from.x0 - reach, from.y0 - reach, from.x1 + reach, from.y1 + reach};
  const auto width = static_cast<std::size_t>(wide.pixels.width());
  const auto height = static_cast<std::size_t>(wide.pixels.height());

  // Each pixel's distance to the mask along its column, as far as it matters.
  const int far = reach + 1;
  std::vector<int> along(width * height, far);
  for (std::size_t x = 0; x < width; ++x) {
    int distance = far;
    const auto step = [&](std::size_t y) {
      const bool inside = mask.at(wide.pixels.x0 + static_cast<int>(x), wide.pixels.y0 + static_cast<int>(y)) > kInside;
      distance = inside ? 0 : std::min(distance + 1, far);
      along[y * width + x] = std::min(along[y * width + x], distance);
    };
    for (std::size_t y = 0; y < height; ++y) step(y);
    distance = far;
    for (std::size_t y = height; y-- > 0;) step(y);
  }

  // The nearest of its row's columns.
  wide.shares.resize(width * height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t first = x < static_cast<std::size_t>(reach) ? 0 : x - static_cast<std::size_t>(reach);
      const std::size_t end = std::min(width, x + static_cast<std::size_t>(reach) + 1);
      double nearest = 2.0 * far * far;
      for (std::size_t column = first; column < end; ++column) {
        const double dx = static_cast<double>(column) - static_cast<double>(x);
        const double dy = along[y * width + column];
        if (dy < far) nearest = std::min(nearest, dx * dx + dy * dy);
      }
      wide.shares[y * width + x] = static_cast<float>(std::clamp(radius + 0.5 - std::sqrt(nearest), 0.0, 1.0));
    }
  return wide;
}

}  // namespace bihive
