#include "bihive/scene/pair_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bihive {
namespace {

// From the sphere at `half.a` to the middle of the line at `half.b`.
void add_dashes(OwnStick half, std::vector<OwnStick>& sticks) {
  const Vec3d from = half.a, axis = half.b - half.a;
  const double half_length = length(axis), radius = half.radius_a;
  const double gap = kDashPeriod - kDashLength;
  const double dashes = std::max(1.0, std::round((2 * half_length / radius + gap) / kDashPeriod));
  const double unit = 2 * half_length / (kDashPeriod * dashes - gap);  // about the radius
  if (!(half_length > 0)) return sticks.push_back(half);
  for (double k = 0; k < dashes; ++k) {
    const double begin = k * kDashPeriod * unit;
    if (!(begin < half_length)) return;
    const double end = std::min(begin + kDashLength * unit, half_length);
    half.a = from + (begin / half_length) * axis;
    half.b = from + (end / half_length) * axis;
    sticks.push_back(half);
  }
}

}  // namespace

void add_pair_line(const SphereSet& spheres, const std::optional<Lattice>& lattice, const PairLine& line,
                   std::vector<OwnStick>& sticks) {
  const Vec3d from = spheres.local_centre(line.one), to = spheres.local_centre(line.other);
  const Vec3d shift = lattice ? lattice->shift(line.image) : Vec3d{};
  const Vec3d middle = 0.5 * (from + (to + shift));
  OwnStick half;
  half.radius_a = half.radius_b = line.radius;
  half.colour = line.colour;
  half.sphere = line.one;
  half.a = from;
  half.b = middle;
  OwnStick second = half;
  second.sphere = line.other;
  second.a = middle - shift;
  second.b = to;
  if (!line.dashed) {
    sticks.push_back(half);
    sticks.push_back(second);
    return;
  }
  std::swap(second.a, second.b);
  add_dashes(half, sticks);
  add_dashes(second, sticks);
}

}  // namespace bihive
