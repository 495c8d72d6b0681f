#include "bihive/render/picture/labels/label_pen.h"

#include <algorithm>
#include <cmath>

#include "bihive/settings/picture_effects.h"

namespace bihive {
namespace {

constexpr double kShareOfSide = 0.028;  // of the shorter side: 20 pixels of 720
constexpr double kLeastShare = 0.015, kMostShare = 0.06;
// Small pictures have larger letters, as long as those leave room for a picture.
constexpr double kReadablePx = 10;
constexpr double kLeastPx = 6;
constexpr double kPoints = 8;  // in print
constexpr double kLineEm = 0.07;
constexpr double kSeamEm = 0.12;
constexpr double kSeamOpacity = 0.85;
constexpr Vec3d kDarkInk{0.1, 0.1, 0.1};
constexpr Vec3d kLightInk{0.96, 0.96, 0.96};

// Of a colour of the screen, roughly as the eye sees it: half of it is a middle grey.
bool is_light(Vec3d colour) {
  return 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z > 0.5;
}

// Whether a shape, `border` pixels wider, may cover some of these rows.
bool meets_rows(const Shape& shape, const Tile& part, double border) {
  for (const std::vector<CanvasPoint>& outline : shape.outlines()) {
    if (outline.empty()) continue;
    const auto [top, bottom] =
        std::minmax_element(outline.begin(), outline.end(), [](CanvasPoint a, CanvasPoint b) { return a.y < b.y; });
    if (bottom->y + border >= part.y0 && top->y - border <= part.y1) return true;
  }
  return false;
}

}  // namespace

LabelPen::LabelPen(PngPixels& pixels, const Tile& part, int width_px, int height_px, double em_px, Vec3d paper,
                   const Font* font)
    : pixels_(&pixels),
      part_(part),
      width_px_(width_px),
      height_px_(height_px),
      em_px_(em_px),
      font_(font),
      paper_(paper),
      ink_(is_light(paper) ? kDarkInk : kLightInk) {}

LabelPen::LabelPen(CanvasArea& covered, int width_px, int height_px, double em_px, const Font* font)
    : covered_(&covered), width_px_(width_px), height_px_(height_px), em_px_(em_px), font_(font) {}

void LabelPen::cover(const Shape& shape, double border) {
  for (const std::vector<CanvasPoint>& outline : shape.outlines())
    for (const CanvasPoint point : outline) {
      covered_->x0 = std::min(covered_->x0, point.x - border);
      covered_->y0 = std::min(covered_->y0, point.y - border);
      covered_->x1 = std::max(covered_->x1, point.x + border);
      covered_->y1 = std::max(covered_->y1, point.y + border);
    }
}

double LabelPen::line() const {
  return std::max(1.0, std::floor(kLineEm * em_px_ + 0.5));
}

void LabelPen::fill(const Shape& shape, Vec3d colour) {
  if (covered_ != nullptr) return cover(shape, 0);
  blend(*pixels_, part_, mask_of(shape), colour);
}

void LabelPen::draw(const Shape& shape, Vec3d colour) {
  if (covered_ != nullptr) return cover(shape, kSeamEm * em_px_);
  // A picture in bands has many parts, and large masks take time.
  if (!meets_rows(shape, part_, kSeamEm * em_px_ + 2)) return;
  const CoverageMask mask = mask_of(shape);
  blend(*pixels_, part_, widened(mask, kSeamEm * em_px_), paper_, kSeamOpacity);
  blend(*pixels_, part_, mask, colour);
}

void LabelPen::write(const std::string& text, CanvasPoint start, double size) {
  Shape shape;
  shape.add_text(text, start, size * em_px_, font_);
  draw(shape);
}

LabelPen LabelPen::with_em(double em_px) const {
  LabelPen pen = *this;
  pen.em_px_ = em_px;
  return pen;
}

double em_of_picture(int width_px, int height_px, double dots_per_inch) {
  const double shorter = std::min(width_px, height_px);
  double em = kShareOfSide * shorter;
  if (dots_per_inch > 0)
    em = std::clamp(kPoints / kPointsPerInch * dots_per_inch, kLeastShare * shorter, kMostShare * shorter);
  return std::max({em, std::min(kReadablePx, kMostShare * shorter), kLeastPx});
}

}  // namespace bihive
