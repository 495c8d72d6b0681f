// A camera and a light for a set without its own: the whole set in view, as large as possible.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The side from which the camera looks. front: from +z with y up; left from -x, right from +x, back
/// from -z, top from +y (with -z up), bottom from -y (with +z up), iso from (1, 1, 1).
enum class ViewFrom { front, back, left, right, top, bottom, iso };

/// A direction of view, as two unit vectors at right angles: from look_at towards the eye, and up.
struct Side {
  Vec3d back;
  Vec3d up;
};
Side side_of(ViewFrom from);

/// The projection and its margins.
struct Lens {
  double fov_deg = 30;
  Projection projection = Projection::perspective;
};

/// The margin on each side of the picture, as a share of that side.
constexpr double kFreeBorder = 0.04;

/// Further free margins of the picture: shares of its width (left, right) and height, each from 0 to kMostInset.
struct Insets {
  double left = 0, right = 0, top = 0, bottom = 0;

  bool any() const { return left > 0 || right > 0 || top > 0 || bottom > 0; }
};
constexpr double kMostInset = 0.4;

/// Every sphere lies wholly inside the picture (width x height pixels) less a margin of 4 % on each side, or less the
/// insets where these are wider, and the set is as large as that allows. perspective: the eye is as near as possible,
/// and shifted sideways. orthographic: the eye is where that of the perspective is or farther away, in front of all
/// spheres, and the shorter side is as short as possible. An empty or single-point set is seen from distance 1.
Camera frame_spheres(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px,
                     const Insets& insets = {});
Camera frame_spheres(const SphereSet& spheres, ViewFrom from, double fov_deg, int width_px, int height_px);

/// The picture that a camera shall fill, and the middle of all spheres.
struct Framing {
  Side side;
  Lens lens;
  int width_px, height_px;
  Insets insets;
  Vec3d middle;
};
/// The middle of a box; 0 for the bounds of an empty set.
Vec3d middle_of(const SphereSet::Bounds& bounds);

/// The extent of spheres towards the planes that bound a picture, and towards the eye: everything that framing needs.
/// For several sets of spheres, take the maximum of each number.
struct ViewReach {
  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  double across_low = kNone, across_high = kNone, along_low = kNone, along_high = kNone;  ///< planes through the eye
  double left = kNone, right = kNone, below = kNone, above = kNone;                       ///< from the middle
  double front = 0;
};
/// `points`: to be in view besides the spheres.
ViewReach reach_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Framing& framing);
/// The camera of frame_spheres() for spheres of this extent.
Camera camera_for(const Framing& framing, const ViewReach& reach);

/// One white light above, left of and behind the camera, at least as far from look_at as the camera is.
PointLight light_behind(const Camera& camera);

}  // namespace bihive
