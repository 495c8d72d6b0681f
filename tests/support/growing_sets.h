// Hostile sets of spheres that exist in every size, for tests of how time, work and memory grow.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "support/hostile_sets.h"

namespace bihive::test {

/// A hostile set of any number of spheres.
struct GrowingSet {
  const char* name;
  std::function<World(int)> make;
};

inline World filled(int n, const std::function<void(World&, SplitMix64&, int)>& add) {
  World world;
  SplitMix64 rng(77);
  for (int i = 0; i < n; ++i) add(world, rng, i);
  return world;
}

inline const std::vector<GrowingSet>& growing_sets() {
  static const std::vector<GrowingSet> sets{
      {"coincident", [](int n) { return pile("", n, 0.1, 0.2, 0.3, 1); }},
      {"nested",
       [](int n) { return filled(n, [](World& w, SplitMix64& g, int) { w.add(1, 2, 3, g.next_double() + 0.1); }); }},
      {"exponential",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int) {
           w.add(std::exp2(-140 * g.next_double()), std::exp2(-140 * g.next_double()),
                 std::exp2(-140 * g.next_double()), 0);
         });
       }},
      {"piles at powers of two",
       [](int n) {
         return filled(n, [](World& w, SplitMix64&, int i) {
           const double c = std::ldexp(1, -(i % 140));
           w.add(c, c, c, 1e-3);
         });
       }},
      {"clusters with exponential distances",
       [](int n) {
         return filled(n, [](World& w, SplitMix64&, int i) {
           const double c = 0.5 + 0.4 * std::ldexp(1, -(i % 20));
           w.add(c + i / 20 % 31, c + i / 620 % 37, c + i / 22940, 1e-5);
         });
       }},
      {"flat",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int) { w.add(g.next_double(), 7, g.next_double(), 1e-3); });
       }},
      {"on a line",
       [](int n) { return filled(n, [](World& w, SplitMix64& g, int) { w.add(3, g.next_double(), 4, 1e-3); }); }},
      {"needle",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int) {
           w.add(g.next_double(), 1e-5 * g.next_double(), 1e-5 * g.next_double(), 1e-6);
         });
       }},
      {"one huge sphere over tiny ones",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int i) {
           w.add(1e-3 * g.next_double(), 1e-3 * g.next_double(), 1e-3 * g.next_double(), i == 0 ? 1e3 : 1e-6);
         });
       }},
      {"on few planes",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int) {
           w.add(std::floor(3 * g.next_double()), std::floor(1e3 * g.next_double()), std::floor(5 * g.next_double()),
                 0.1);
         });
       }},
      {"smallest and largest numbers",
       [](int n) {
         return filled(n, [](World& w, SplitMix64& g, int i) {
           constexpr double kLargest = std::numeric_limits<float>::max() / 4, kSmallest = 1.5e-45;
           const double size = i % 3 == 0 ? kLargest : i % 3 == 1 ? kSmallest : 1;
           w.add(size * (g.next_double() - 0.5), size * (g.next_double() - 0.5), size * (g.next_double() - 0.5),
                 size * g.next_double() * 0.1);
         });
       }},
  };
  return sets;
}

}  // namespace bihive::test
