// The angle of view of wide pictures.
#pragma once

namespace bihive {

/// The angle along the shorter side that a camera has which is placed for a picture of this size: `fov_deg`, or less
/// where the longer side would span more than 60 degrees. There spheres at its ends look 15 % too wide (1 / cos 30).
double angle_for_picture(double fov_deg, int width_px, int height_px);

}  // namespace bihive
