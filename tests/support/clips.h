// Random clips for the spheres of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/clip.h"
#include "bihive/math/rng.h"
#include "bihive/scene/scene.h"

namespace bihive::test {

/// A plane, a box or a sphere around the origin, in a world that reaches to `size` on each side.
inline Clip random_clip(SplitMix64& rng, double size) {
  const auto within = [&](double reach) { return reach * (2 * rng.next_double() - 1); };
  const Vec3d at{within(0.7 * size), within(0.7 * size), within(0.7 * size)};
  switch (rng.next() % 3) {
    case 0: {
      Vec3d normal{within(3), within(3), within(3)};
      if (rng.next() % 3 == 0) normal = {0, rng.next() % 2 == 0 ? 2.0 : -1.0, 0};
      return PlaneClip{normal, dot(normal, at)};
    }
    case 1: {
      const Vec3d half{size * (0.05 + rng.next_double()), size * (0.05 + rng.next_double()),
                       size * (0.05 + 0.5 * rng.next_double())};
      return BoxClip{at - half, at + half};
    }
    default:
      return SphereClip{at, size * (0.1 + 0.5 * rng.next_double())};
  }
}

/// One to four clips, each for all spheres or for half of them.
inline void add_random_clips(std::uint64_t seed, double size, Scene& scene) {
  SplitMix64 rng(seed + 77);
  const auto count = static_cast<int>(1 + rng.next() % 4);
  std::vector<std::uint64_t>& bits = scene.spheres.attributes().clips;
  bits.assign(static_cast<std::size_t>(scene.spheres.size()), 0);
  for (int k = 0; k < count; ++k) {
    scene.clips.push_back(random_clip(rng, size));
    const bool all = rng.next() % 2 == 0;
    for (std::uint64_t& of_sphere : bits)
      if (all || rng.next() % 2 == 0) of_sphere |= std::uint64_t{1} << k;
  }
}

}  // namespace bihive::test
