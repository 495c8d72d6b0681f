// Small sets of balls for tests of measures: few balls at few coordinates with few radii.
#pragma once

#include <cmath>
#include <cstdint>

#include "bihive/math/rng.h"
#include "bihive/measure/balls.h"

namespace bihive::test {

/// Spheres that touch, share circles, and meet four or more in a point. `kind` is from 0 to 3.
inline measure::Balls hostile_balls(SplitMix64& rng, int kind) {
  const auto below = [&](int n) { return static_cast<double>(static_cast<int>(n * rng.next_double())); };
  measure::Balls balls;
  const int count = 2 + static_cast<int>(below(13));
  for (int i = 0; i < count; ++i) {
    switch (kind) {
      case 0:  // a lattice
        balls.centre.push_back(Vec3d{below(5), below(5), below(5)} * 0.125 - Vec3d{0.25, 0.25, 0.25});
        balls.radius.push_back((1 + below(4)) / 8);
        break;
      case 1:  // two layers of it, nearly equal radii
        balls.centre.push_back({below(3) / 8, below(3) / 8, below(2) / 8});
        balls.radius.push_back(below(2) == 0 ? 0.3125 : (3 + below(3)) / 16);
        break;
      case 2:  // near a line
        balls.centre.push_back({below(9) / 16, 0, below(2) * below(3) / 16});
        balls.radius.push_back((1 + below(10)) / 32);
        break;
      default: {  // right triangles with whole sides
        constexpr double kSteps[] = {0, 3, 4, 5, 6, 8, -3, -4, -5}, kRadii[] = {2.5, 5, 3, 4, 6.5, 1, 2};
        const auto step = [&] { return kSteps[static_cast<int>(below(9))] / 16; };
        balls.centre.push_back({step(), step(), below(2) * step()});
        balls.radius.push_back(kRadii[static_cast<int>(below(7))] / 16);
      }
    }
  }
  return balls;
}

/// Eight balls around a middle that they close to a hollow, to a point or wholly, or leave open: their centres are the
/// corners of a box of sides 4, 4 and 2, so that spheres of radius 3 all meet in its middle.
inline measure::Balls enclosing_balls(SplitMix64& rng) {
  constexpr double kUnit = 0.125;
  measure::Balls balls;
  const auto flat = static_cast<int>(rng.next_below(3));
  const double common = 2.75 + 0.25 * static_cast<double>(rng.next_below(3));
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d centre;
    for (int axis = 0; axis < 3; ++axis) centre[axis] = (corner >> axis & 1 ? 1 : -1) * (axis == flat ? 1 : 2) * kUnit;
    balls.centre.push_back(centre);
    const bool is_usual = rng.next_below(4) != 0;
    balls.radius.push_back((is_usual ? common : 2.5 + 0.25 * static_cast<double>(rng.next_below(4))) * kUnit);
  }
  return balls;
}

/// Centres in a cube of side 1, radii of up to this many octaves.
inline measure::Balls random_balls(SplitMix64& rng, int count, double octaves) {
  measure::Balls balls;
  for (int i = 0; i < count; ++i) {
    balls.centre.push_back({rng.next_double() - 0.5, rng.next_double() - 0.5, rng.next_double() - 0.5});
    balls.radius.push_back(0.5 * std::exp2(-octaves * rng.next_double()));
  }
  return balls;
}

}  // namespace bihive::test
