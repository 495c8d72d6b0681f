// Pairs of points that are near each other, by the cells of a grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/lattice.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Points `one` <= `other`, the second moved by `image` times the lattice's vectors. Of a point and its own image, the
/// first count that is not 0 is above 0: the opposite image is the same pair.
struct NearPair {
  std::array<std::int32_t, 2> points{};
  ImageCounts image{};
  double distance_squared = 0;
};

/// All pairs that are at most radii[one] + radii[other] apart, but not in one position, in ascending order of `points`,
/// then `image`. Points whose radius is 0 have none. `lattice` makes the images of points count; points that it does
/// not hold have none. O(n log n) for points of even density; the same on any number of threads (0: all). Error: a cell
/// of which a point is near more than 1,000 images. Throws what base/watch.h does, and std::bad_alloc.
Result<std::vector<NearPair>> near_pairs(const std::vector<Vec3d>& points, const std::vector<double>& radii,
                                         const std::optional<Lattice>& lattice, int threads);

}  // namespace bihive
