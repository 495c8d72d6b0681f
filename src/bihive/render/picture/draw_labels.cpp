#include "bihive/render/draw_labels.h"

#include <algorithm>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/image/font.h"
#include "bihive/render/picture/labels/parts.h"
#include "bihive/render/stereo.h"
#include "bihive/scene/legend.h"

namespace bihive {
namespace {

// What a reader sees behind the picture: the background, or a white page.
Vec3d paper_of(const Scene& scene, const RenderSettings& settings) {
  if (settings.transparent && !settings.matte) return {1, 1, 1};
  if (settings.view != View::shaded) return screen_colour(scene.background, Transfer::none);
  return screen_colour(scene.background, scene.picture.transfer);
}

// Draws each label that the settings have, with the pen that the caller gives for it, in places where they leave each
// other alone.
struct Pens {
  LabelPen title, legend, scale_bar, axes;
};
void draw_with(Pens& pens, const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  const Labels& labels = settings.labels;
  double top = pens.legend.margin();
  double bottom = pens.legend.margin();
  if (!labels.title.empty()) top = draw_title(pens.title, labels.title);
  if (labels.scale_bar)
    bottom = pens.scale_bar.em() + draw_scale_bar(pens.scale_bar,
                                                  length_of_pixel(camera, settings.width_px, settings.height_px),
                                                  labels.length_unit.value_or(scene.length_unit));
  if (labels.axes) draw_axes(pens.axes, camera);
  if (labels.legend) draw_legend(pens.legend, legend_of(scene, labels), top, settings.height_px - bottom);
}

}  // namespace

double length_of_pixel(const Camera& camera, int width_px, int height_px) {
  return camera.shorter_side / std::min(width_px, height_px);
}

Status check_labels(const Scene& scene, const RenderSettings& settings) {
  return check_labels(scene, scene.camera, settings);
}

Status check_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  const Labels& labels = settings.labels;
  if (labels.scale_bar && camera.projection != Projection::orthographic)
    return Error{"a perspective picture has no scale: what is far looks small", "", 0, 0,
                 "draw it with " + setting_name("projection") + " orthographic"};
  if (labels.legend && settings.view != View::shaded)
    return Error{"the legend explains the colours of spheres, which this view does not show", "", 0, 0,
                 "choose the view shaded"};
  const std::vector<std::int32_t>& meanings = scene.coloured_by_of_sphere;
  const bool has_meaning = meanings.empty() ? !scene.coloured_by.empty()
                                            : std::any_of(meanings.begin(), meanings.end(),
                                                          [](std::int32_t meaning) { return meaning != -1; });
  const bool sticks_have = !scene.sticks_coloured_by.empty() && !legend_of(scene).empty();
  if (labels.legend && !has_meaning && !sticks_have)
    return Error{"the colours of these spheres have no meaning that a legend could explain", "", 0, 0,
                 "colour them by an attribute: " + setting_name("colour_by") + " z"};
  return Done{};
}

Labels possible_labels(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  Labels labels = settings.labels;
  for (bool Labels::*const label : {&Labels::legend, &Labels::scale_bar}) {
    RenderSettings alone = settings;
    alone.labels = {};
    alone.labels.*label = labels.*label;
    if (!check_labels(scene, camera, alone)) labels.*label = false;
  }
  return labels;
}

std::vector<std::string> missing_letters(const Scene& scene, const RenderSettings& settings) {
  const Labels& labels = settings.labels;
  std::vector<std::pair<std::string, std::string>> texts;  // and what they are
  if (!labels.title.empty()) texts.emplace_back("the title", labels.title);
  if (labels.scale_bar && labels.length_unit) texts.emplace_back("the scale bar", *labels.length_unit);
  if (labels.legend)
    for (const LegendKey& key : legend_of(scene, labels)) {
      texts.emplace_back("the legend", key.title);
      for (const LegendEntry& entry : key.entries) texts.emplace_back("the legend", entry.name);
    }
  std::vector<std::pair<std::string, std::vector<char32_t>>> lacking;
  for (const auto& [what, text] : texts)
    for (const char32_t letter : characters_of(text)) {
      if (has_glyph(letter, settings.font.get())) continue;
      if (lacking.empty() || lacking.back().first != what) lacking.emplace_back(what, std::vector<char32_t>());
      std::vector<char32_t>& letters = lacking.back().second;
      if (std::find(letters.begin(), letters.end(), letter) == letters.end()) letters.push_back(letter);
    }
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> sentences;
  for (const auto& [what, letters] : lacking)
    sentences.push_back(what + " has boxes in place of letters that " +
                        (settings.font ? "neither the chosen font nor DejaVu Sans has" : "DejaVu Sans lacks") + ": " +
                        text_of(letters, 0, std::min(letters.size(), kMostNamed)) +
                        (letters.size() > kMostNamed ? " and more" : "") + "; choose " +
                        (settings.font ? "another" : "a") + " font by " + setting_name("font"));
  return sentences;
}

LabelAreas label_areas(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  RenderSettings possible = settings;
  possible.labels = possible_labels(scene, camera, settings);
  const double em = em_of_picture(settings.width_px, settings.height_px, settings.dots_per_inch);
  const CanvasArea nothing{double(settings.width_px), double(settings.height_px), 0, 0};
  CanvasArea title = nothing, legend = nothing, scale_bar = nothing, axes = nothing;
  const auto pen = [&](CanvasArea& area) {
    return LabelPen(area, settings.width_px, settings.height_px, em, settings.font.get());
  };
  Pens pens{pen(title), pen(legend), pen(scale_bar), pen(axes)};
  draw_with(pens, scene, camera, possible);
  const auto found = [](const CanvasArea& area) {
    return area.x0 < area.x1 ? std::optional(area) : std::optional<CanvasArea>();
  };
  return {found(title), found(legend), found(scale_bar), found(axes)};
}

namespace {

// `part`: the pixels of the picture that `pixels` holds.
void draw_labels_of_view(PngPixels& pixels, const Tile& part, const Scene& scene, const RenderSettings& settings) {
  const double em = em_of_picture(settings.width_px, settings.height_px, settings.dots_per_inch);
  const LabelPen pen(pixels, part, settings.width_px, settings.height_px, em, paper_of(scene, settings),
                     settings.font.get());
  Pens pens{pen, pen, pen, pen};
  draw_with(pens, scene, scene.camera, settings);
}

}  // namespace

void draw_labels(PngPixels& pixels, const Scene& scene, const RenderSettings& settings) {
  if (!settings.labels.any()) return;
  if (settings.stereo.form != StereoForm::none) {
    // In each view at the same place: labels lie in the plane of the screen.
    const RenderSettings view = one_view(settings);
    const Tile drawn = drawn_pixels(settings);
    for (int left = 0; left < settings.width_px; left += view.width_px)
      draw_labels_of_view(pixels, {drawn.x0 - left, drawn.y0, drawn.x1 - left, drawn.y1}, scene, view);
    return;
  }
  draw_labels_of_view(pixels, drawn_pixels(settings), scene, settings);
}

}  // namespace bihive
