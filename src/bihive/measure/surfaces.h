// The closed surfaces that bound a union of balls.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/measure/balls.h"
#include "bihive/measure/exposed_sphere.h"

namespace bihive::measure {

/// The pieces of some spheres.
struct Pieces {
  std::vector<ExposedPiece> pieces;
  std::vector<std::int64_t> owner;  ///< the ball of each
  std::vector<Junction> junctions;
  std::int64_t undecided_spheres = 0;  ///< those for which append_pieces() returned false
};

/// A connected part of the union's boundary; of a periodic set, of its images one.
struct Surface {
  double area = 0;                        ///< in one cell
  std::vector<ImageCounts> translations;  ///< of the lattice, that bring it to itself: a basis. Empty: it is closed
  double volume = 0;                      ///< that it encloses; below 0: a cavity of this volume. 0 if it is not closed
  bool encloses_balls = false;
  std::vector<std::int64_t> balls;  ///< those with a piece of it, ascending
};

/// Of all pieces, in the order of the lists. Takes them. `lattice`: of periodic balls, in their units.
/// `surface_of_piece`, if given: the surface of each piece, in the order of the lists.
std::vector<Surface> surfaces_of(const Balls& balls, const std::optional<Lattice>& lattice, std::vector<Pieces> lists,
                                 std::vector<std::int64_t>* surface_of_piece = nullptr);

}  // namespace bihive::measure
