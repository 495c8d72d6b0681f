// The labels of a picture, one function each. Each stays inside the picture where there is room.
#pragma once

#include <string>
#include <vector>

#include "bihive/render/picture/labels/label_pen.h"
#include "bihive/scene/legend.h"

namespace bihive {

/// At the top, in the middle; too long lines are broken between words. Returns the height that it takes, in pixels.
double draw_title(LabelPen& pen, const std::string& title);

/// At the right, between these heights in pixels.
void draw_legend(LabelPen& pen, const std::vector<LegendKey>& keys, double top, double bottom);

/// In the lower right corner. `length_per_px`: world units. Returns the height that it takes, in pixels.
double draw_scale_bar(LabelPen& pen, double length_per_px, const std::string& unit);

/// In the lower left corner: the world's axes as the camera's right, up and backward directions see them.
void draw_axes(LabelPen& pen, const Camera& camera);

}  // namespace bihive
