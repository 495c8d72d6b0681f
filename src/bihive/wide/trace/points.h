// One point at a time against a wide tree, on the active target. docs/precision.md, "Points", derives the padding.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/sphere_distance.h"
#include "bihive/math/vec3.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// A sphere and its distance, in stored units.
struct NearSphere {
  double distance;
  std::int64_t id;
};

/// The order of answers.
inline bool operator<(const NearSphere& a, const NearSphere& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
}

/// The spheres, each moved by `shift`, at a distance of at most `limit` from `point`; stored units.
struct PointQuestion {
  Vec3d point;
  double limit;
  DistanceTo to;
  const std::uint8_t* mask;  ///< null: all spheres
  Vec3d shift{};
};

/// The nearest `most` of them, in order, to `nearest`, which has room for as many. Returns how many there are. `known`:
/// as many are there already, from other shifts.
std::int64_t find_nearest(const WideTree& tree, const PointQuestion& question, std::int64_t most, NearSphere* nearest,
                          std::int64_t known = 0);

/// Appends all of them to `found`, in any order.
void find_within(const WideTree& tree, const PointQuestion& question, std::vector<NearSphere>& found);

/// For each sphere in slots `first` to before first + count, which are neighbours as those of a leaf are: appends the
/// spheres with a larger id at a distance of at most `reach`, between surfaces or between centres, to `found`, by id,
/// and sets counts[i] to their number. Stored units. The tree is no image and has no piles. `mask`: null, or a byte for
/// each sphere; those of 0 have no pairs.
void find_pairs_of_leaf(const WideTree& tree, std::int64_t first, std::int64_t count, double reach, DistanceTo to,
                        const std::uint8_t* mask, std::vector<NearSphere>& found, std::int64_t* counts);

}  // namespace bihive::wide
