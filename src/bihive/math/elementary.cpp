#include "bihive/math/elementary.h"

#include <cmath>
#include <limits>

namespace bihive {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr double kLog2E = 1.44269504088896340736;
constexpr double kPi = 3.14159265358979323846;
constexpr double kSqrtHalf = 0.70710678118654752440;

// tan on [0, pi/4] as the quotient of the series of sine and cosine; the first terms left out are below 1e-22.
double tan_small(double x) {
  const double x2 = x * x;
  double sine = 1;
  double cosine = 1;
  for (int k = 20; k >= 2; k -= 2) {
    sine = 1 - x2 / (k * (k + 1.0)) * sine;
    cosine = 1 - x2 / ((k - 1.0) * k) * cosine;
  }
  return x * sine / cosine;
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
  // ln m = 2 artanh(s) with s = (m - 1) / (m + 1), |s| < 0.172: the first term left out is below 1e-19.
  const double s = (mantissa - 1) / (mantissa + 1);
  const double s2 = s * s;
  double series = 0;
  for (int k = 23; k >= 3; k -= 2) series = (series + 1.0 / k) * s2;
  return static_cast<double>(exponent) + 2 * s * (1 + series) * kLog2E;
}

double portable_exp2(double x) {
  if (!(x >= -1075)) return x != x ? x : 0;
  if (x > 1024) return std::numeric_limits<double>::infinity();
  // Split into integer and fraction in [-1/2, 1/2]; the series of e^y with |y| < 0.347 is cut below 1e-18.
  const double whole = std::floor(x + 0.5);
  const double y = (x - whole) * kLn2;
  double series = 1;
  for (int k = 14; k >= 1; --k) series = 1 + series * y / k;
  return std::ldexp(series, static_cast<int>(whole));
}

double portable_pow(double x, double y) {
  if (y == 0) return 1;
  if (x <= 0) return y > 0 ? 0 : std::numeric_limits<double>::infinity();
  return portable_exp2(y * portable_log2(x));
}

double tan_deg(double degrees) {
  if (degrees <= 45) return tan_small(degrees * (kPi / 180));
  return 1 / tan_small((90 - degrees) * (kPi / 180));
}

}  // namespace bihive
