// Small sets of balls for tests of measures: few balls at few coordinates with few radii.
#pragma once

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

}  // namespace bihive::test
