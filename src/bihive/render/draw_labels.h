// The last step of a picture: legend, scale bar, axes and title over its finished pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/canvas.h"
#include "bihive/image/png_pixels.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Error: the scale bar of a perspective picture, a legend where colours have no meaning or the view does not show
/// them. Costs little: ask before the picture is made. `camera`: in place of the scene's.
Status check_labels(const Scene& scene, const RenderSettings& settings);
Status check_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings);

/// The labels of the settings without those that this picture cannot have.
Labels possible_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings);

/// A sentence for each label whose text has letters that the fonts lack. A legend costs a pass over all spheres.
std::vector<std::string> missing_letters(const Scene& scene, const RenderSettings& settings);

/// What each label covers of the picture, in pixels. Not there: no such label, or check_labels() refuses it.
struct LabelAreas {
  std::optional<CanvasArea> title, legend, scale_bar, axes;
};
LabelAreas label_areas(const Scene& scene, const Camera& camera, const RenderSettings& settings);

/// Draws settings.labels over the pixels that settings.crop (or the whole picture) holds. check_labels() must succeed.
/// Letters grow with the picture's shorter side; with settings.dots_per_inch above 0 they have 8 points in print,
/// within limits. They are dark on light backgrounds and light on dark ones, and stand in a seam of the background's
/// colour (white, where the background is transparent), so that they are readable above spheres and on any page. The
/// pixels depend on nothing but the arguments, and a crop's equal those of the whole picture.
void draw_labels(PngPixels& pixels, const Scene& scene, const RenderSettings& settings);

/// The world's length of one pixel of an orthographic picture.
double length_of_pixel(const Camera& camera, int width_px, int height_px);

}  // namespace bihive
