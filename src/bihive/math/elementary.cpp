#include "bihive/math/elementary.h"

#include <cmath>
#include <limits>

namespace bihive {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr double kLog2E = 1.44269504088896340736;
constexpr double kSqrtHalf = 0.70710678118654752440;
constexpr double kPi = 3.14159265358979323846;

// The series of sin(x) / x and cos(x) on [-pi/4, pi/4]; the first terms left out are below 1e-22.
struct Series {
  double sine_over_x = 1, cosine = 1;
};
Series series_of(double x) {
  const double x2 = x * x;
  Series series;
  for (int k = 20; k >= 2; k -= 2) {
    series.sine_over_x = 1 - x2 / (k * (k + 1.0)) * series.sine_over_x;
    series.cosine = 1 - x2 / ((k - 1.0) * k) * series.cosine;
  }
  return series;
}

double tan_small(double x) {
  const Series series = series_of(x);
  return x * series.sine_over_x / series.cosine;
}

}  // namespace

double portable_log2(double x) {
  // Split into mantissa in [sqrt(1/2), sqrt(2)) and exponent, both exact.
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < kSqrtHalf) {
    mantissa *= 2;
    --exponent;
  }
  // ln m = 2 artanh(s) with s = (m - 1) / (m + 1), |s| < 0.172; the first term left out is below 1e-18 of the sum.
  // Neighbouring terms are added in pairs, then the pairs in pairs [Estrin1960], so that additions wait little for each
  // other.
  const double s = (mantissa - 1) / (mantissa + 1);
  const double z = s * s;
  const double z2 = z * z;
  const double z4 = z2 * z2;
  const double from_3 = (1.0 / 3 + z * (1.0 / 5)) + z2 * (1.0 / 7 + z * (1.0 / 9));
  const double from_11 = (1.0 / 11 + z * (1.0 / 13)) + z2 * (1.0 / 15 + z * (1.0 / 17));
  const double from_19 = 1.0 / 19 + z * (1.0 / 21);
  const double series = 1 + z * (from_3 + z4 * (from_11 + z4 * from_19));
  return static_cast<double>(exponent) + 2 * s * series * kLog2E;
}

double portable_exp2(double x) {
  if (!(x >= -1075)) return x != x ? x : 0;
  if (x > 1024) return std::numeric_limits<double>::infinity();
  // Split into integer and fraction in [-1/2, 1/2]; the series of e^y with |y| < 0.347 is cut below 1e-17.
  const double whole = std::floor(x + 0.5);
  const double y = (x - whole) * kLn2;
  const double y2 = y * y;
  const double y4 = y2 * y2;
  const double from_2 = (1.0 / 2 + y * (1.0 / 6)) + y2 * (1.0 / 24 + y * (1.0 / 120));
  const double from_6 = (1.0 / 720 + y * (1.0 / 5040)) + y2 * (1.0 / 40320 + y * (1.0 / 362880));
  const double from_10 = (1.0 / 3628800 + y * (1.0 / 39916800)) + y2 * (1.0 / 479001600 + y * (1.0 / 6227020800));
  const double power = 1 + (y + y2 * (from_2 + y4 * (from_6 + y4 * from_10)));
  return std::ldexp(power, static_cast<int>(whole));
}

double portable_pow(double x, double y) {
  if (y == 0) return 1;
  if (x <= 0) return y > 0 ? 0 : std::numeric_limits<double>::infinity();
  return portable_exp2(y * portable_log2(x));
}

double shading_power(double x, double y) {
  if (!is_small_whole(y)) return portable_pow(x, y);
  double raised = 1;
  for (unsigned n = static_cast<unsigned>(y); n != 0; n >>= 1) {
    if ((n & 1) != 0) raised *= x;
    x *= x;
  }
  return raised;
}

double tan_deg(double degrees) {
  if (degrees <= 45) return tan_small(degrees * (kPi / 180));
  return 1 / tan_small((90 - degrees) * (kPi / 180));
}

double atan_deg(double x) {
  if (x > 1) return 90 - atan_deg(1 / x);
  // Halve the angle three times, so that x is at most 0.1; the first term of the series left out is below 1e-18 of it.
  for (int i = 0; i < 3; ++i) x = x / (1 + std::sqrt(1 + x * x));
  const double x2 = x * x;
  double series = 1.0 / 17;
  for (int k = 15; k >= 1; k -= 2) series = 1.0 / k - x2 * series;
  return 8 * (180 / kPi) * (x * series);
}

SineCosine sine_cosine_deg(double degrees) {
  // The nearest multiple of 90 degrees and the rest from -45 to 45, both exact.
  const double turned = std::remainder(degrees, 360);
  const double quarters = std::floor(turned / 90 + 0.5);
  const double x = (turned - 90 * quarters) * (kPi / 180);
  const Series series = series_of(x);
  const double sine = x * series.sine_over_x;
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {sine, series.cosine};
    case 1:
      return {series.cosine, -sine};
    case 2:
      return {-sine, -series.cosine};
    default:
      return {-series.cosine, sine};
  }
}

}  // namespace bihive
