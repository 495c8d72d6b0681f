#include "bihive/image/transfer.h"

#include <cmath>

#include "bihive/math/elementary.h"

namespace bihive {

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * portable_pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : portable_pow((srgb + 0.055) / 1.055, 2.4);
}

std::uint8_t byte_from_radiance(double radiance, Transfer transfer) {
  if (!(radiance > 0)) return 0;
  const double clamped = radiance < 1 ? radiance : 1;
  const double displayed = transfer == Transfer::srgb ? srgb_from_linear(clamped) : clamped;
  return static_cast<std::uint8_t>(std::floor(displayed * 255 + 0.5));
}

}  // namespace bihive
