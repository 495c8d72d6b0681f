// Every ball's part of the boundary and of the union, on all threads.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/measure/balls.h"
#include "bihive/measure/exposed_sphere.h"
#include "bihive/measure/surfaces.h"

namespace bihive::measure {

/// The balls of a set that count: each has a radius above 0, grown by the probe, and is not masked out. In stored
/// units.
struct Counted {
  Balls balls;
  std::vector<std::int64_t> ids;   ///< of the set; a periodic set's images have none
  std::vector<ImageCounts> moved;  ///< of periodic sets, how each ball was moved into the cell
  double probe = 0;

  std::int64_t size() const { return static_cast<std::int64_t>(ids.size()); }
};

/// The part of a ball that its facets bound with its exposed part, for a radius of 1.
struct PowerCell {
  double volume = 0, volume_error = 0;
};
struct OwnedFacet {
  std::int64_t ball;
  Facet facet;
};
/// Balls of the cell that share a point with ball i, which may be an image.
struct Link {
  std::int64_t i, j;
};

struct OwnedArcs {
  std::int64_t ball;
  PieceArcs arcs;
};

struct Boundary {
  std::vector<ExposedPart> parts;
  std::vector<PowerCell> cells;                  ///< of each ball, or none
  std::vector<std::vector<OwnedFacet>> facets;   ///< each pair of balls once, or none; chunk by chunk
  std::vector<std::vector<AreaChange>> changes;  ///< or none; chunk by chunk, images as their balls
  std::vector<Pieces> pieces;                    ///< or none; chunk by chunk
  std::vector<std::vector<OwnedArcs>> arcs;      ///< of balls with several pieces, or none; chunk by chunk
  std::vector<std::vector<Link>> links;          ///< the same, of periodic sets
};

struct Wanted {
  bool cells = false, facets = false, pieces = false, changes = false;
  bool arcs = false;  ///< with pieces
};

/// `probe` in stored units. `mask`: a byte for each sphere, 0 leaves it out; null: none.
Counted counted_spheres(const SphereSet& set, double probe, const std::uint8_t* mask);

/// Errors: not enough memory for a tree, and what base/watch.h throws.
Result<Boundary> boundary_of(const Counted& counted, const SphereSet& set, const Wanted& wanted, int threads);

}  // namespace bihive::measure
