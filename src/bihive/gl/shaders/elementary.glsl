// Twin of math/elementary.h: powers with a known error. A driver's pow() may be coarse near 1.
#include "common"

// log2(x) for x > 0: the exponent, and a series of the mantissa between sqrt(1/2) and sqrt(2).
float portable_log2(float x) {
  int bits = floatBitsToInt(x);
  int exponent = (bits - 0x3F3504F3) >> 23;
  float mantissa = intBitsToFloat(bits - (exponent << 23));
  float s = (mantissa - 1.0) / (mantissa + 1.0);
  float s2 = s * s;
  float series = s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0))));
  return float(exponent) + 2.885390082 * (s + s * series);
}

// 2^x; 0 below -126.
float portable_exp2(float x) {
  if (x < -126.0) return 0.0;
  float whole = floor(x + 0.5);
  float y = (x - whole) * 0.6931471806;
  float series = 1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0 + y * (1.0 / 120.0 + y / 720.0)))));
  return series * intBitsToFloat((int(min(whole, 127.0)) + 127) << 23);
}

// x^y for x >= 0; 0^y = 0 for y > 0.
float portable_pow(float x, float y) {
  return x < 1.2e-38 ? (y == 0.0 ? 1.0 : 0.0) : portable_exp2(y * portable_log2(x));
}
