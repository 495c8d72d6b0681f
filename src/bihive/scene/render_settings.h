// The view of a scene and the fineness of its picture: the same for every renderer.
#pragma once

#include <optional>

#include "bihive/image/film.h"
#include "bihive/image/tone.h"
#include "bihive/scene/ambient_occlusion.h"
#include "bihive/scene/opacity_rule.h"
#include "bihive/scene/picture_effects.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// shaded: Whitted's pictures. recursion: the deepest generation that hit something. traversal: gaps passed (green) and
/// nodes entered (blue) by the primary ray. normal, distance, id: of the first hit. tree: a drawing of the tree itself
/// (render/tree_picture.h). All but `shaded` are display values.
enum class View { shaded, recursion, traversal, normal, distance, id, tree };

constexpr int kFewSamples = 4;
constexpr int kManySamples = 16;

struct RenderSettings {
  int width_px = 1280;        ///< 1 to 65535
  int height_px = 720;        ///< 1 to 65535
  int samples_per_pixel = 4;  ///< 1 to 4096; 1 = the pixel's centre
  /// Then every pixel gets kFewSamples, and the pixels on edges (render/edge_pixels.h) get kManySamples instead:
  /// each pixel is that of a picture with the one or the other number. View::shaded alone; other views get kFewSamples.
  bool adaptive_samples = false;
  int recursion = 5;  ///< 1 to 16
  bool shadows = true;
  std::optional<AmbientOcclusion> ambient_occlusion;
  OpacityRule opacity_rule = OpacityRule::each_surface;
  int light_points = 8;  ///< of each light with a radius, a sample; 1 to kMostLightPoints
  std::optional<Outline> outline;
  std::optional<Fog> fog;
  std::optional<CellLines> cell_lines;  ///< without effect if the spheres have no cell
  Labels labels;                        ///< for draw_labels() (render/draw_labels.h); a film has none
  /// The film gets coverage: samples that hit nothing add no light to their pixel. Reflected and transmitted rays see
  /// the background as ever. Not for View::traversal and View::tree.
  bool transparent = false;
  /// View::shaded: of the light of all samples that hit something, before outlines and fog. So the background and the
  /// colours of outlines and fog are on the screen what they are.
  Tone tone;
  /// Multiplies the widths of outlines; below one pixel they are left out. For a preview in another size. Above 0.
  double outline_scale = 1;
  View view = View::shaded;
  /// Only these pixels of the picture are drawn, with the same bits as in the whole picture: at least one, inside it.
  std::optional<Tile> crop;
  int threads = 0;  ///< 0 = as many as the machine runs at once; for the CPU's renderer
};

/// The pixels of the whole picture that are drawn.
inline Tile drawn_pixels(const RenderSettings& settings) {
  return settings.crop.value_or(Tile{0, 0, settings.width_px, settings.height_px});
}

/// The defaults of a scene as settings.
inline RenderSettings settings_from(const PictureDefaults& defaults) {
  RenderSettings settings;
  settings.width_px = defaults.width_px;
  settings.height_px = defaults.height_px;
  settings.samples_per_pixel = defaults.samples_per_pixel;
  settings.adaptive_samples = defaults.adaptive_samples;
  settings.recursion = defaults.recursion;
  settings.shadows = defaults.shadows;
  settings.ambient_occlusion = defaults.ambient_occlusion;
  settings.opacity_rule = defaults.opacity_rule;
  settings.light_points = defaults.light_points;
  settings.outline = defaults.outline;
  settings.fog = defaults.fog;
  settings.cell_lines = defaults.cell_lines;
  settings.transparent = defaults.transparent;
  settings.tone = defaults.tone;
  settings.labels = defaults.labels;
  return settings;
}

}  // namespace bihive
