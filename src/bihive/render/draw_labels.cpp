#include "bihive/render/draw_labels.h"

#include <algorithm>

#include "bihive/render/labels/parts.h"
#include "bihive/scene/legend.h"

namespace bihive {
namespace {

// What a reader sees behind the picture: the background, or a white page.
Vec3d paper_of(const Scene& scene, const RenderSettings& settings) {
  if (settings.transparent) return {1, 1, 1};
  if (settings.view != View::shaded) return screen_colour(scene.background, Transfer::none);
  return screen_colour(scene.background, scene.picture.transfer);
}

}  // namespace

double length_of_pixel(const Camera& camera, int width_px, int height_px) {
  return camera.shorter_side / std::min(width_px, height_px);
}

Status check_labels(const Scene& scene, const RenderSettings& settings) {
  const Labels& labels = settings.labels;
  if (labels.scale_bar && scene.camera.projection != Projection::orthographic)
    return Error{"a perspective picture has no scale: what is far looks small", "", 0, 0,
                 "draw it with --projection orthographic"};
  if (labels.legend && settings.view != View::shaded)
    return Error{"the legend explains the colours of spheres, which this view does not show", "", 0, 0,
                 "choose the view shaded"};
  const bool has_meaning =
      !scene.coloured_by.empty() && (scene.coloured_by_of_sphere.empty() ||
                                     std::any_of(scene.coloured_by_of_sphere.begin(), scene.coloured_by_of_sphere.end(),
                                                 [](std::int32_t meaning) { return meaning >= 0; }));
  if (labels.legend && !has_meaning)
    return Error{"the colours of these spheres have no meaning that a legend could explain", "", 0, 0,
                 "colour them by an attribute: --colour-by z"};
  return Done{};
}

void draw_labels(PngPixels& pixels, const Scene& scene, const RenderSettings& settings, double dots_per_inch) {
  const Labels& labels = settings.labels;
  if (!labels.any()) return;
  const double em = em_of_picture(settings.width_px, settings.height_px, dots_per_inch);
  LabelPen pen(pixels, drawn_pixels(settings), settings.width_px, settings.height_px, em, paper_of(scene, settings));
  double top = pen.margin();
  double bottom = pen.margin();
  if (!labels.title.empty()) top = draw_title(pen, labels.title);
  if (labels.scale_bar)
    bottom = em + draw_scale_bar(pen, length_of_pixel(scene.camera, settings.width_px, settings.height_px),
                                 labels.length_unit.value_or(scene.length_unit));
  if (labels.axes) draw_axes(pen, scene.camera);
  if (labels.legend) draw_legend(pen, legend_of(scene), top, settings.height_px - bottom);
}

}  // namespace bihive
