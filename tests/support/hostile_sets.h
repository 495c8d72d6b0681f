// Degenerate and extreme sets of spheres, small enough to trace by brute force.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "support/scenes.h"
#include "support/world.h"

namespace bihive::test {

/// Centres at 2^-i along the given axes (bits x = 1, y = 2, z = 4), radius `share` of the coordinate.
inline World exponential_world(const std::string& name, int count, int axes, double share) {
  World world;
  world.name = name;
  for (int i = 0; i < count; ++i) {
    const double c = std::ldexp(1, -i);
    world.add(axes & 1 ? c : 0, axes & 2 ? c : 0, axes & 4 ? c : 0, c * share);
  }
  return world;
}

/// `count` equal spheres in one place.
inline World pile(const std::string& name, int count, double x, double y, double z, double r) {
  World world;
  world.name = name;
  for (int i = 0; i < count; ++i) world.add(x, y, z, r);
  return world;
}

inline std::vector<World> degenerate_worlds() {
  std::vector<World> worlds;
  worlds.push_back(pile("none", 0, 0, 0, 0, 0));
  worlds.push_back(pile("one", 1, 1, 2, 3, 0.5));
  worlds.push_back(pile("one point at 0", 1, 0, 0, 0, 0));
  worlds.push_back(pile("one sphere at 0", 1, 0, 0, 0, 1));
  worlds.push_back(pile("two in one place", 2, 1, 2, 3, 0.5));
  worlds.push_back(pile("coincident at 0", 300, 0, 0, 0, 1));
  worlds.push_back(pile("coincident elsewhere", 300, 0.1, -0.3, 0.7, 0.01));
  worlds.push_back(pile("coincident points", 100, 0.1, -0.3, 0.7, 0));
  worlds.push_back(pile("two apart", 1, -3, 0, 0, 1));
  worlds.back().add(3, 0, 0, 1);
  worlds.push_back(pile("a pile and a stranger", 99, 1, 1, 1, 0.25));
  worlds.back().add(-1, -1, -1, 0.25);
  worlds.push_back(random_world("points", 21, 200, 1, 0.0, 0.0));
  worlds.push_back(touching_world(6));
  worlds.push_back(coincident_world(22, 40, 6));
  worlds.push_back(nested_world(23, 30));
  for (int axis = 0; axis < 3; ++axis) {
    World line = random_world(std::string("line along ") + "xyz"[axis], 24, 200, 5, 0.01, 0.1);
    World sheet = random_world(std::string("sheet across ") + "xyz"[axis], 25, 300, 5, 0.05, 0.5);
    std::vector<float>* const c[3] = {&line.x, &line.y, &line.z};
    for (int other = 0; other < 3; ++other)
      if (other != axis) std::fill(c[other]->begin(), c[other]->end(), 0.375f);
    std::vector<float>* const s[3] = {&sheet.x, &sheet.y, &sheet.z};
    std::fill(s[axis]->begin(), s[axis]->end(), -1.5f);
    worlds.push_back(line);
    worlds.push_back(sheet);
  }
  worlds.push_back(exponential_world("powers along x", 120, 1, 0.25));
  worlds.push_back(exponential_world("powers along the diagonal", 120, 7, 0.25));
  worlds.push_back(exponential_world("powers, overlapping", 120, 6, 1));
  worlds.push_back(exponential_world("powers, points", 140, 4, 0));
  worlds.push_back(random_world("mixed radii", 26, 300, 1, 1e-5, 1));
  worlds.push_back(random_world("all overlap", 27, 200, 1, 2, 4));
  worlds.push_back(random_world("far from 0", 28, 300, 12, 1, 1, 1e5, -1e5, 1e5));
  worlds.push_back(random_world("very far from 0", 29, 200, 12, 1, 1, 1e7, 0, 0));
  worlds.push_back(random_world("a few ulps wide", 30, 200, 1e-6, 1e-7, 1e-6, 1, 1, 1));
  for (const double factor : {1e-37, 1e-20, 1e20, 1e37})
    worlds.push_back(
        random_world("base", 31, 150, 1, 0.01, 0.3).scaled(factor, "scaled by " + std::to_string(std::log10(factor))));
  return worlds;
}

}  // namespace bihive::test
