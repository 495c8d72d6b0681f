#include "bihive/scene/light_points.h"

#include <cmath>

#include "bihive/math/turn.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive {

// Evenly spread points of the sphere in four dimensions, without their fourth coordinate: by Archimedes' theorem each
// plane projection of that sphere is an evenly filled disc. Coordinates: (sqrt(u) e^ia, sqrt(1 - u) e^ib) with u even
// in [0, 1] and even angles a and b, whose steps are powers of the plastic number, the golden ratio of two dimensions.
LightPointSets::LightPointSets(int points, int samples_per_pixel) {
  constexpr double kPlastic = 1.32471795724474602596;  // the real root of x^3 = x + 1
  const Rotation step_a = turn_by(1 / kPlastic);
  const Rotation step_b = turn_by(1 / (kPlastic * kPlastic));
  const int sets = std::min(samples_per_pixel, kMostPointSets);
  for (int n = 0; n < sets * kFaintLevels; ++n) {
    const int asked = used_at_level(points, n / sets, kFewestLightPoints);
    const int i = n % sets;
    const SamplePlace place = sample_place(i, sets);
    std::vector<Vec3d>& set = sets_.emplace_back();
    Rotation a = turn_by(place.y);
    Rotation b = turn_by(place.x);
    for (int k = 0; k < asked; ++k) {
      const double u = (k + place.x) / asked;
      const double radius = std::sqrt(u);
      set.push_back({radius * a.cosine, radius * a.sine, std::sqrt(1 - u) * b.cosine});
      a = after(a, step_a);
      b = after(b, step_b);
    }
  }
}

}  // namespace bihive
