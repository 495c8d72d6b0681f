#include "bihive/math/optical_depth.h"

#include <cmath>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr int kFractionBits = 22;
constexpr double kUnits = 1 << kFractionBits;
constexpr int kBits = kFractionBits / 2;  // of a table
constexpr int kEntries = 1 << kBits;

// Powers of two by table: 2^-i for the whole halvings of a depth, and 2^-(i / 2^11) and 2^-(i / 2^22) for the upper and
// lower half of its fraction.
struct Tables {
  double coarse[kEntries], fine[kEntries], whole[(kDeepest >> kFractionBits) + 1];

  Tables() {
    double power = 1;
    for (double& entry : whole) {
      entry = power;
      power = power / 2;
    }
    for (int i = 0; i < kEntries; ++i) {
      coarse[i] = portable_exp2(-double(i) / kEntries);
      fine[i] = portable_exp2(-double(i) / kUnits);
    }
  }
};

}  // namespace

OpticalDepth optical_depth(double share) {
  if (!(share > 0)) return kDeepestLayer;
  const double halvings = share < 1 ? -portable_log2(share) : 0;
  return static_cast<OpticalDepth>(std::min(std::floor(halvings * kUnits + 0.5), double(kDeepestLayer)));
}

double transmittance(OpticalDepth depth) {
  static const Tables tables;
  return tables.whole[depth >> kFractionBits] *
         (tables.coarse[depth >> kBits & (kEntries - 1)] * tables.fine[depth & (kEntries - 1)]);
}

}  // namespace bihive
