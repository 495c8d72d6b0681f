#include "bihive/scene/wide_angle.h"

#include <algorithm>

#include "bihive/math/elementary.h"

namespace bihive {

double angle_for_picture(double fov_deg, int width_px, int height_px) {
  constexpr double kMostDeg = 60;
  const auto [shorter, longer] = std::minmax(width_px, height_px);
  return std::min(fov_deg, 2 * atan_deg(tan_deg(kMostDeg / 2) * shorter / longer));
}

}  // namespace bihive
