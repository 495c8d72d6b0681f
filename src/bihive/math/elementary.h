// Powers and functions of angles made of + - x / on binary64 alone, so that a picture has the same bits on every
// platform. The system's math library is not used: its last bits differ between machines.
#pragma once

namespace bihive {

/// log2(x) for finite x > 0; absolute error below 2e-16 (1 + |log2 x|).
double portable_log2(double x);

/// 2^x; relative error below 4e-16 (1 + |x|), 0 below -1075, +inf above 1024.
double portable_exp2(double x);

/// x^y for x >= 0 and finite y; relative error below 1e-15 (1 + |y log2 x|). 0^0 = 1, 0^y = 0 for y > 0.
double portable_pow(double x, double y);

/// Whether y is 0, 1, 2, ... or 1024.
inline bool is_small_whole(double y) {
  return y >= 0 && y <= 1024 && y == static_cast<double>(static_cast<int>(y));
}

/// x^y for x > 0 and y >= 0, cheaper. If y is a small whole number, repeated squaring with a relative error below 2e-16
/// (1 + y); else portable_pow().
double shading_power(double x, double y);

/// tan(degrees) for 0 <= degrees < 90; relative error below 1e-14 up to 89 degrees.
double tan_deg(double degrees);

/// The angle in degrees, from 0 to 90, whose tangent is x; x >= 0. Relative error below 2e-15.
double atan_deg(double x);

/// Sine and cosine of any finite number of degrees; absolute error below 3e-16. Exact at multiples of 90 degrees.
struct SineCosine {
  double sine, cosine;
};
SineCosine sine_cosine_deg(double degrees);

}  // namespace bihive
