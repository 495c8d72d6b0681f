#include <algorithm>

#include "bihive/image/font.h"
#include "bihive/image/round_numbers.h"
#include "bihive/render/picture/labels/parts.h"

namespace bihive {
namespace {

constexpr double kShareOfWidth = 0.2;
constexpr double kBarThickness = 0.2;
constexpr double kTextGap = 0.4;

}  // namespace

double draw_scale_bar(LabelPen& pen, double length_per_px, const std::string& unit) {
  // Choose the length.
  const RoundNumber length = nearest_round_number(kShareOfWidth * pen.width() * length_per_px);
  const double length_px = length.value() / length_per_px;
  const std::string text = number_label(length.value(), length) + (unit.empty() ? "" : "\u00A0" + unit);

  // The bar lies in the corner, its text above its middle, or as far left of it as the border asks for.
  const double thickness = std::max(2.0, kBarThickness * pen.em());
  const double right = pen.width() - pen.margin();
  const double bottom = pen.height() - pen.margin();
  Shape bar;
  bar.add_rectangle({right - length_px, bottom - thickness, right, bottom});
  pen.draw(bar);
  const double text_px = pen.width_of(text, pen.em());
  const double text_x = std::min(right - 0.5 * (length_px + text_px), right - text_px);
  pen.write(text, {text_x, bottom - thickness - kTextGap * pen.em()}, 1);
  return pen.margin() + thickness + (kTextGap + kCapitalHeight) * pen.em();
}

}  // namespace bihive
