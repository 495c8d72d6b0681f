// Which points of a union's boundary are the walls of cavities.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/measure/piece_arcs.h"

namespace bihive {

/// The union of all spheres of a set, and the cavities that measure_union() finds in it (measure/union_measures.h).
/// Cells do not count.
class CavityWalls {
 public:
  /// Errors: those of measure_union().
  static Result<CavityWalls> of(SphereSet spheres, int threads = 0);

  const SphereSet& spheres() const { return spheres_; }
  /// For each sphere the number of the largest cavity that it lines, from 1 on by descending volume; 0: it lines none.
  const std::vector<std::int32_t>& cavity_of_sphere() const { return cavity_of_sphere_; }
  int cavities() const { return cavities_; }
  /// Spheres whose pieces of the boundary could not be told apart (UnionMeasures::undecided_spheres).
  std::int64_t undecided_spheres() const { return undecided_; }

  /// Whether a point of the boundary, on the sphere in this direction from its centre, belongs to the wall of a cavity.
  /// Of a sphere that lines both a cavity and something else binary64 decides.
  bool is_wall(std::int64_t id, Vec3d direction) const;

 private:
  // Of a sphere with a piece that is no wall beside one that is.
  struct Mixed {
    measure::PieceArcs arcs;
    std::vector<std::uint8_t> is_wall;  // of each piece
  };

  CavityWalls() = default;

  SphereSet spheres_;
  int cavities_ = 0;
  std::int64_t undecided_ = 0;
  std::vector<std::int32_t> cavity_of_sphere_;
  std::map<std::int64_t, Mixed> mixed_;
};

}  // namespace bihive
