// The angle of a direction, made of + - x / on binary64 alone: the same bits on every platform (math/elementary.h).
#pragma once

#include <cmath>
#include <numbers>

namespace bihive::measure {

inline constexpr double kPi = std::numbers::pi;

/// In radians, from -pi to pi, of the direction (x, y); both are finite. Its error is below 2^-50, and below 2^-50 of
/// the angle where x > 0. 0 for x = y = 0.
inline double direction_angle(double y, double x) {
  const double along = std::abs(x), up = std::abs(y);
  const double longer = along < up ? up : along, shorter = along < up ? along : up;
  if (longer == 0) return 0;
  // The angle in [0, pi/4] is that of the nearest multiple of 1/8, plus the angle between the two directions, whose
  // tangent is at most 1/15; the first term of its series left out is below 3e-18 of it.
  constexpr double kAngles[] = {0.0,
                                0.12435499454676144,
                                0.24497866312686414,
                                0.35877067027057225,
                                0.4636476090008061,
                                0.5585993153435624,
                                0.6435011087932844,
                                0.7188299996216245,
                                0.7853981633974483};
  const int nearest = static_cast<int>(8 * (shorter / longer) + 0.5);
  const double tangent = nearest * 0.125;
  const double z = (shorter - tangent * longer) / (longer + tangent * shorter);
  const double z2 = z * z, z4 = z2 * z2;
  const double from_3 = (-1.0 / 3 + z2 * (1.0 / 5)) + z4 * (-1.0 / 7 + z2 * (1.0 / 9));
  const double from_11 = -1.0 / 11 + z2 * (1.0 / 13);
  double angle = kAngles[nearest] + (z + z * z2 * (from_3 + z4 * z4 * from_11));
  if (along < up) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace bihive::measure
