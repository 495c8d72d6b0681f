// The view of a scene and the quality of its picture, for every renderer.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "bihive/image/film.h"
#include "bihive/scene/scene.h"
#include "bihive/settings/picture_settings.h"

namespace bihive {

class Font;

/// Blocks of 4 x 2 pixels have each set once.
constexpr int kSharedSets = 8;

/// shaded: Whitted's pictures. recursion: the deepest generation that hit something. traversal: gaps passed (green) and
/// nodes entered (blue) by the primary ray. normal, distance, id: those of the first hit. tree: a drawing of the tree
/// itself (render/tree_picture.h). All but `shaded` are display values.
enum class View { shaded, recursion, traversal, normal, distance, id, tree };

/// The settings of a picture, and those of a renderer alone.
struct RenderSettings : PictureSettings {
  /// Multiplies the widths of outlines and creases, for a preview in another size; 0: none.
  double line_scale = 1;
  /// For previews of one sample per pixel: neighbouring pixels take this many sets of directions and of light points in
  /// turn, and share what these bring on the same sphere. 1, or kSharedSets; 1 where rays pass straight through
  /// spheres.
  int light_sets = 1;
  double dots_per_inch = 0;          ///< of the picture in print, for letters and for lines in points; 0: not stated
  std::shared_ptr<const Font> font;  ///< of labels (image/font.h); null: DejaVu Sans
  std::optional<Camera> camera;      ///< in place of the scene's: an eye of a stereo picture
  View view = View::shaded;
  /// Only these pixels of the picture are drawn, with the same bits as in the whole picture: at least one, inside it.
  std::optional<Tile> crop;
  int threads = 0;  ///< 0 = as many as the machine runs at once; for the CPU's renderer
};

/// The camera of the picture as rays see it.
inline Camera picture_camera(const Scene& scene, const RenderSettings& settings) {
  return relative_to(settings.camera.value_or(scene.camera), scene.spheres.origin());
}

/// The drawn pixels of the whole picture.
inline Tile drawn_pixels(const RenderSettings& settings) {
  return settings.crop.value_or(Tile{0, 0, settings.width_px, settings.height_px});
}

/// The pixels of a line of width 1, without `line_scale`.
inline double line_unit_px(const RenderSettings& settings) {
  switch (settings.line_unit) {
    case LineUnit::picture:
      return std::min(settings.width_px, settings.height_px) / kLineUnitsOfPicture;
    case LineUnit::pt:
      return (settings.dots_per_inch > 0 ? settings.dots_per_inch : kDotsPerInchOfScreens) / kPointsPerInch;
    default:
      return 1;
  }
}

/// For a renderer.
inline RenderSettings settings_from(const PictureSettings& picture) {
  RenderSettings settings;
  static_cast<PictureSettings&>(settings) = picture;
  return settings;
}

}  // namespace bihive
