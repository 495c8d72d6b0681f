// All settings of a picture: stated in a style, in a scene file, or by the user.
#pragma once

#include <limits>
#include <optional>

#include "bihive/image/tone.h"
#include "bihive/image/transfer.h"
#include "bihive/settings/ambient_occlusion.h"
#include "bihive/settings/arrows.h"
#include "bihive/settings/hydrogen_bonds.h"
#include "bihive/settings/labels.h"
#include "bihive/settings/links.h"
#include "bihive/settings/opacity_rule.h"
#include "bihive/settings/picture_effects.h"
#include "bihive/settings/stereo.h"
#include "bihive/settings/sticks.h"
#include "bihive/settings/traces.h"
#include "bihive/settings/trails.h"

namespace bihive {

constexpr int kMostSidePx = 65535;
constexpr int kMostSamplesPerPixel = 4096;
constexpr int kMostGenerations = 16;
constexpr int kMostLightPoints = 1024;
constexpr double kLeastFitShare = 0.5;

/// Samples per pixel of adaptive sampling: for every pixel, and for those on edges.
constexpr int kFewSamples = 4;
constexpr int kManySamples = 16;
/// Default samples per pixel with depth of field: with fewer, single points of the lens are visible.
constexpr int kLensSamples = 64;

/// The table of settings/parameter.h describes each member: its range, its name, its help. The values here are the
/// defaults of files; the thesis's scenes state their own.
struct PictureSettings {
  int width_px = 1280;        ///< 1 to kMostSidePx
  int height_px = 720;        ///< 1 to kMostSidePx
  int samples_per_pixel = 4;  ///< 1 to kMostSamplesPerPixel; 1: the pixel's centre
  /// Then every pixel gets kFewSamples, and the pixels on edges (render/picture/edge_pixels.h) get kManySamples
  /// instead: each pixel is that of a picture with the one or the other number. View::shaded alone; other views get
  /// kFewSamples.
  bool adaptive_samples = false;
  int recursion = 5;  ///< generations of rays, 1 to kMostGenerations
  bool shadows = true;
  std::optional<AmbientOcclusion> ambient_occlusion;
  OpacityRule opacity_rule = OpacityRule::each_surface;
  int light_points = 8;  ///< shadow rays per light with a radius and sample; 1 to kMostLightPoints
  std::optional<Outline> outline;
  std::optional<Fog> fog;
  Sticks sticks;                 ///< for find_bonds() (scene/bonds.h), before a picture is drawn
  Arrows arrows;                 ///< for add_arrows() (scene/arrows.h), after that
  Traces traces;                 ///< for add_traces() (scene/traces.h), last
  Trails trails;                 ///< for add_trails() (scene/trails.h), with the spheres of earlier frames
  HydrogenBonds hydrogen_bonds;  ///< for add_hydrogen_bonds() (scene/hydrogen_bonds.h)
  Links links;                   ///< for add_links() (scene/links.h)
  /// The radius of the probe for show_cavities() (scene/cavities.h), world units, at least 0; infinite: whole spheres
  /// are drawn.
  double cavity_probe = std::numeric_limits<double>::infinity();
  std::optional<CellLines> cell_lines;  ///< without effect if the spheres have no cell
  LineUnit line_unit = LineUnit::px;    ///< of all widths of lines
  /// The picture has opacity instead of a background: samples that hit nothing add no light to their pixel. Reflected
  /// and transmitted rays still see the background. Not for View::traversal and View::tree.
  bool transparent = false;
  /// Linear; of a transparent picture: the colour that will lie behind it. It takes the place of the background, and
  /// programs that mix the values of the screen show the picture with this background (image/png_pixels.h).
  std::optional<Vec3d> matte;
  /// A camera that bihive places frames these spheres: along each axis, this share of them in the middle
  /// (scene/framed_spheres.h); kLeastFitShare to 1.
  double fit_share = 1;
  Stereo stereo;
  /// View::shaded: applies to the light of all samples that hit something, before outlines and fog. So the background
  /// and the colours of outlines and fog appear unchanged.
  Tone tone;
  Labels labels;                       ///< for draw_labels() (render/draw_labels.h); an animation has none
  Transfer transfer = Transfer::srgb;  ///< for png_pixels_from_film(); a film is linear

  bool shows_cavities() const { return cavity_probe < std::numeric_limits<double>::infinity(); }
};

/// Depth of field needs many samples everywhere: gives `settings` at least kLensSamples.
inline void use_lens_samples(PictureSettings& settings) {
  settings.adaptive_samples = false;
  if (settings.samples_per_pixel < kLensSamples) settings.samples_per_pixel = kLensSamples;
}

}  // namespace bihive
