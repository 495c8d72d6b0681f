// The look of the style `density`: points as faint dots of light, so that a picture is as bright as there are points
// behind each other.
#pragma once

#include <optional>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// The key `density` of a style file (docs/styles.md).
struct DensityStyle {
  double dot = 3;           ///< diameter of points without radii, in 1/kLineUnitsOfPicture of the set's extent; above 0
  double percentile = 99;   ///< of the covered places of a picture, 0 to 100: ...
  double brightness = 0.9;  ///< ... this share of the full brightness, above 0 and below 1
};

/// Its values for one set.
struct Density {
  std::optional<double> radius;   ///< of each sphere, world units; unset: those of the file
  std::optional<double> opacity;  ///< of each sphere, at least kLeastOpacityOfDots; unset: those of the file
};

/// Fainter dots would not be seen alone on a screen of 256 levels.
constexpr double kLeastOpacityOfDots = 1.0 / 256;

/// n points without radii are dots of the style's size, or of 1/sqrt(n) of the extent where that is larger, at most
/// 1/20. The extent is that of central_box(), which leaves a few points far away out of account, along its longest
/// side. The coverage of a place is the area of the spheres' discs over that of a square of the dots' size; the
/// percentile is that of all places with a sphere, and its mean over projections along x, y and z. n discs, each of
/// which lets 1 - opacity through, have together the brightness 1 - (1 - opacity)^n. `assumed_radii`: the file states
/// none. The set is not empty.
Density density_of(const SphereSet& spheres, const DensityStyle& style, bool assumed_radii);

/// Gives all spheres this radius (world units); attributes, cell and images stay. False: it is too large for the set,
/// which is then as it was.
bool set_radius(SphereSet& spheres, double radius);

}  // namespace bihive
