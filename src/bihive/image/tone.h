// Exposure and tone: how bright the light of a scene becomes in its picture.
#pragma once

#include <algorithm>

#include "bihive/math/elementary.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// What happens to light that is brighter than the picture can show. All curves rise and keep 0.
/// none: it is cut off at 1, channel by channel.
/// soft: the largest channel up to 1/2 stays, what is above bends towards 1 by Reinhard's curve [Reinhard2002], and a
/// channel of 4 becomes white. The other channels keep their ratio to it, so hue and saturation stay.
/// filmic: Narkowicz's fit of the ACES film curve [Narkowicz2016], channel by channel: deep shadows become darker,
/// the middle brighter, and bright colours fade to white.
enum class ToneCurve { none, soft, filmic };

constexpr double kMostExposureStops = 32;

struct Tone {
  double exposure_stops = 0;  ///< the light is multiplied by 2^stops; from -kMostExposureStops to kMostExposureStops
  ToneCurve curve = ToneCurve::none;

  /// Whether it changes any light.
  bool any() const { return exposure_stops != 0 || curve != ToneCurve::none; }
};

/// The light of this channel becomes 1 and more stays 1.
constexpr double kSoftWhite = 4;
constexpr double kFilmicWhite = 7.25;

/// Of one channel, or of the largest; x >= 0 or NaN, which gives 0.
inline double soft_curve(double x) {
  if (!(x > 0.5)) return x > 0 ? x : 0;
  // Reinhard's extended curve s (1 + s / white^2) / (1 + s), moved and scaled to meet the straight line at 1/2 with the
  // same slope.
  constexpr double kWhite = 2 * (kSoftWhite - 0.5);
  const double s = 2 * (std::min(x, kSoftWhite) - 0.5);
  return 0.5 + 0.5 * (s * (1 + s / (kWhite * kWhite)) / (1 + s));
}

inline double filmic_curve(double x) {
  if (!(x > 0)) return 0;
  const double light = std::min(x, kFilmicWhite);
  return std::min(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 1.0);
}

/// The factor of the exposure, exact for whole stops.
inline double exposure_factor(const Tone& tone) {
  return portable_exp2(tone.exposure_stops);
}

/// The light of a sample as the picture shows it: linear, and with a curve at most 1. `factor`: exposure_factor().
inline Vec3d toned(Vec3d light, const Tone& tone, double factor) {
  const Vec3d exposed = factor * light;
  if (tone.curve == ToneCurve::none) return exposed;
  if (tone.curve == ToneCurve::filmic)
    return {filmic_curve(exposed.x), filmic_curve(exposed.y), filmic_curve(exposed.z)};
  const double largest = std::max(std::max(exposed.x, exposed.y), exposed.z);
  return largest > 0.5 ? (soft_curve(largest) / largest) * exposed : exposed;
}

}  // namespace bihive
