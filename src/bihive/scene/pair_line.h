// A line between two spheres, of two halves, whole or dashed: links and hydrogen bonds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"

namespace bihive {

/// A dash is 3 radii long and the next one begins 8 radii after it, both a little more or less, so that a line begins
/// and ends with a dash: with their round ends 5 and 3 radii are seen.
constexpr double kDashLength = 3, kDashPeriod = 8;

struct PairLine {
  std::int32_t one = 0, other = 0;   ///< ids
  ImageCounts image{};               ///< of the other
  double radius = 0;                 ///< world units, above 0
  std::optional<Vec3f> colour = {};  ///< linear RGB; unset: half by half that of the sphere
  bool dashed = false;
};

/// Appends the halves, which meet in the middle; either belongs to the sphere at its end. That of the other sphere is
/// where this sphere is, and not its image: a line to an image is two stubs. `lattice`: of the spheres' cell.
void add_pair_line(const SphereSet& spheres, const std::optional<Lattice>& lattice, const PairLine& line,
                   std::vector<OwnStick>& sticks);

}  // namespace bihive
