// Hostile sets of spheres, by name, for the differential test.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/scene/generators.h"
#include "support/world.h"

namespace bihive::test {

/// Uniform in [lo, hi).
inline double uniform(SplitMix64& rng, double lo, double hi) {
  return lo + (hi - lo) * rng.next_double();
}
/// Uniform in the logarithm; 0 < lo < hi.
inline double log_uniform(SplitMix64& rng, double lo, double hi) {
  return lo * std::exp(uniform(rng, 0, std::log(hi / lo)));
}

/// n spheres in the cube [-half, half]^3 around (cx, cy, cz), radii log-uniform in [r_lo, r_hi].
inline World random_world(const std::string& name, std::uint64_t seed, int n, double half, double r_lo, double r_hi,
                          double cx = 0, double cy = 0, double cz = 0) {
  SplitMix64 rng(seed);
  World world;
  world.name = name;
  for (int i = 0; i < n; ++i) {
    const double x = uniform(rng, -half, half), y = uniform(rng, -half, half), z = uniform(rng, -half, half);
    world.add(cx + x, cy + y, cz + z, r_lo == r_hi ? r_lo : log_uniform(rng, r_lo, r_hi));
  }
  return world;
}

/// Unit spheres on an integer grid of spacing 2: each touches up to six others, exactly.
inline World touching_world(int side) {
  World world;
  world.name = "touching";
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) world.add(2 * i - side, 2 * j - side, 2 * k - side, 1);
  return world;
}

/// Each place holds `copies` spheres that are equal in every bit, scattered over the ids.
inline World coincident_world(std::uint64_t seed, int places, int copies) {
  const World once = random_world("coincident", seed, places, 10, 0.2, 2);
  World world;
  world.name = once.name;
  for (int copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < once.size(); ++i) {
      const std::size_t j = (i * 7 + static_cast<std::size_t>(copy) * 13) % once.size();
      world.add(once.x[j], once.y[j], once.z[j], once.r[j]);
    }
  return world;
}

/// Shells around common centres, and shells that touch from inside (radii and offsets are powers of two, so they touch
/// exactly).
inline World nested_world(std::uint64_t seed, int places) {
  const World once = random_world("nested", seed, places, 10, 1, 2);
  World world;
  world.name = once.name;
  for (std::size_t i = 0; i < once.size(); ++i)
    for (int shell = 0; shell < 8; ++shell) {
      const double radius = std::ldexp(std::floor(once.r[i] * 16) / 16, -shell);
      const double offset = i % 2 == 0 ? 0 : std::floor(once.r[i] * 16) / 16 - radius;
      world.add(std::floor(once.x[i] * 64) / 64 + offset, once.y[i], once.z[i], radius);
    }
  return world;
}

/// Every scene of the differential test, with about `count` spheres each (the scenarios: `scenario_count`).
inline std::vector<World> hostile_worlds(std::int64_t scenario_count, int count) {
  std::vector<World> worlds;
  const char* const names[3] = {"scenario1", "scenario2", "scenario3"};
  for (int s = 0; s < 3; ++s) {
    const Result<SphereSet> set = scenario_spheres(static_cast<Scenario>(s + 1), {scenario_count, 1.0f, 1});
    BIHIVE_CHECK(set.ok());
    worlds.push_back(world_of(*set, names[s]));
  }
  worlds.push_back(random_world("far_small", 11, count, 20, 0.001, 0.001));
  worlds.back().view_distance = 100;
  worlds.push_back(random_world("mixed_radii", 12, count, 1, 1e-5, 1));
  worlds.push_back(random_world("offset", 13, count, 12, 1, 1, 1e5, -1e5, 1e5));
  worlds.push_back(coincident_world(14, count / 5, 5));
  worlds.push_back(touching_world(static_cast<int>(std::cbrt(double(count)) + 0.5)));
  worlds.push_back(nested_world(15, count / 8));
  worlds.push_back(random_world("zero_mixed", 16, count, 10, 0.2, 2));
  for (std::size_t i = 0; i < worlds.back().size(); i += 5) worlds.back().r[i] = 0;
  const World base = random_world("base", 17, count, 10, 0.1, 1.5);
  worlds.push_back(base.scaled(1e-20, "scaled_1e-20"));
  worlds.push_back(base.scaled(1e-15, "scaled_1e-15"));
  worlds.push_back(base.scaled(1e15, "scaled_1e15"));
  worlds.push_back(base.scaled(1e20, "scaled_1e20"));
  return worlds;
}

}  // namespace bihive::test
