#include "bihive/scene/lens_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "bihive/math/turn.h"

namespace bihive {
namespace {

constexpr double kGolden = 0.61803398874989484820;  // 1 / (the golden ratio)

// The number next to n / (golden ratio) that has no divisor in common with n. Its multiples modulo n are all numbers
// below n, and successive ones are far apart.
int golden_step(int n) {
  int step = static_cast<int>(std::floor(n * kGolden + 0.5));
  while (step > 1 && std::gcd(step, n) != 1) --step;
  return std::max(step, 1);
}

}  // namespace

// Vogel's spiral: point j of n at radius sqrt(j + 1/2), a golden angle further than the previous one. The samples visit
// it in golden steps, because their positions in the pixel go from left to right: no region of the pixel sees through
// one ring of the lens alone.
std::vector<CameraSample> camera_samples(int n) {
  std::vector<CameraSample> samples;
  const int step = golden_step(n);
  for (int i = 0; i < n; ++i) {
    const auto j = static_cast<int>(std::int64_t{i} * step % n);
    const double radius = n == 1 ? 0 : std::sqrt((j + 0.5) / n);
    const double turns = j * kGolden;
    const Rotation turn = turn_by(turns - std::floor(turns));
    samples.push_back({sample_place(i, n), {radius * turn.cosine, radius * turn.sine}});
  }
  return samples;
}

}  // namespace bihive
