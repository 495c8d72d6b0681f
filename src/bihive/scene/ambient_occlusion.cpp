#include "bihive/scene/ambient_occlusion.h"

#include <algorithm>
#include <cmath>

#include "bihive/math/turn.h"
#include "bihive/scene/sample_pattern.h"

namespace bihive {

// A spiral from pole to pole: equal steps along the axis are equal areas, and each step turns by the golden angle. The
// sets are interleaved: set i starts a fraction of a step lower and is rotated as the sample positions are. Of two
// directions, the second is opposite.
DirectionSets::DirectionSets(int directions, int samples_per_pixel) {
  const double golden = (3 - std::sqrt(5.0)) / 2;  // of a whole turn
  const Rotation step = turn_by(golden);
  const int sets = std::min(samples_per_pixel, kMostDirectionSets);
  for (int n = 0; n < sets * kFaintLevels; ++n) {
    const int asked = used_at_level(directions, n / sets, kFewestDirections);
    const int i = n % sets;
    const SamplePlace place = sample_place(i, sets);
    std::vector<Vec3f>& set = sets_.emplace_back();
    Rotation turn = turn_by(place.y);
    for (int k = 0; k < asked; ++k) {
      const double z = 1 - 2 * (k + place.x) / asked;
      const double radius = std::sqrt(std::max(0.0, 1 - z * z));
      set.push_back(to_float(Vec3d{radius * turn.cosine, radius * turn.sine, z}));
      turn = after(turn, step);
    }
    if (asked == 2) set[1] = -set[0];
  }
}

}  // namespace bihive
