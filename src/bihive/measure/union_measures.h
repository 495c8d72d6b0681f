// Area and volume of a union of balls: the solvent-accessible surface of a molecule, the solid of a packing.
//
// The measures are those of the set's spheres as stored (binary32 centres and radii), each radius grown by the probe.
// Decisions are exact, so no arrangement of spheres is out of reach: touching, equal, concentric and nested ones and
// whole lattices have the measures that are the limit of slightly smaller spheres. docs/measures.md has definitions,
// formulae, error bounds and costs.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

struct MeasureOptions {
  double probe = 0;  ///< added to every radius, in world units; at least 0. Spheres of radius 0 count if it is above 0
  const std::uint8_t* mask = nullptr;  ///< a byte for each sphere of the set, by id: 0 leaves it out. Null: all count
  int threads = 0;                     ///< 0: all. The number cannot change a bit of the result
  bool cavities = false;               ///< find them, channels, and the number of components
  bool sphere_volumes = false;         ///< compute UnionMeasures::sphere_volume
  bool contacts = false;               ///< compute UnionMeasures::contacts
  bool derivatives = false;            ///< compute UnionMeasures::derivatives
  bool periodic = false;  ///< the set repeats along its cell (SphereSet::cell); measures are those of one cell
};

/// A hollow that the union encloses, in world units.
struct Cavity {
  double volume = 0, area = 0;        ///< within its wall and of it, whatever lies inside without touching it
  std::vector<std::int64_t> spheres;  ///< those that line it, by ascending id
};

/// A surface of a periodic union that goes on from cell to cell, in world units: a channel runs along it.
struct PercolatingSurface {
  double area = 0;  ///< in one cell
  /// The translations that bring it to itself, as counts of the cell's vectors: one to three of them, a basis in
  /// Hermite's normal form. A channel along the first vector alone has (1, 0, 0).
  std::vector<std::array<std::int64_t, 3>> translations;
  std::vector<std::int64_t> spheres;  ///< those that line it, by ascending id
};

/// Where two spheres divide the union between them: the part of their common plane that belongs to no third sphere. In
/// world units.
struct Contact {
  std::int64_t first = 0, second = 0;   ///< ids. First <= second, equal for a sphere and an image of itself
  std::array<std::int64_t, 3> image{};  ///< of the second, as counts of the cell's vectors; 0 if it is not periodic
  double area = 0;
  double distance = 0;  ///< from the first centre to the plane; below 0: the centre is beyond it
  double error = 0;     ///< bounds what rounding adds to the area
};

/// How area and volume of the union grow with a sphere's centre and radius, in world units. Where spheres touch, share
/// circles or are equal, the union is not smooth: the derivatives are those of one side.
struct MeasureDerivatives {
  Vec3d area_by_centre, volume_by_centre;
  double area_by_radius = 0, volume_by_radius = 0;
};

/// In world units.
struct UnionMeasures {
  double area = 0;    ///< of the union's boundary
  double volume = 0;  ///< of the union
  /// Bounds of what rounding adds to area and volume.
  double area_error = 0, volume_error = 0;
  /// For each sphere of the set, by id, the area of its part of the boundary; the sum is `area`. 0 for spheres that are
  /// left out. Of equal spheres the one with the lowest id has the whole of it.
  std::vector<double> sphere_area;
  /// With MeasureOptions::cavities: by descending volume, and how many connected parts the union has. Hollows that are
  /// closed to nothing by the limit, of a volume within rounding of 0, do not count.
  std::vector<Cavity> cavities;
  std::int64_t components = 0;
  /// With cavities and periodic: by descending area. Where there is one, union and empty space go on along its
  /// translations.
  std::vector<PercolatingSurface> channels;
  /// Spheres whose pieces of the boundary could not be told apart in binary64 (docs/measures.md): above 0, cavities and
  /// components may be wrong. Area and volume do not depend on it.
  std::int64_t undecided_spheres = 0;
  /// With MeasureOptions::sphere_volumes: for each sphere, by id, the volume of its part of the union, all points whose
  /// power distance to it is the least. The sum is `volume`.
  std::vector<double> sphere_volume;
  /// With MeasureOptions::derivatives: for each sphere, by id. In a periodic set all images move with it.
  std::vector<MeasureDerivatives> derivatives;
  /// With MeasureOptions::contacts: every pair whose contact has an area above its error bound, by first, then second,
  /// then image.
  std::vector<Contact> contacts;
  /// Of a set that is periodic along three vectors: the volume of the cell, and the share of it that is empty, 1 -
  /// volume / cell_volume, with a bound of its rounding error. NaN of other sets.
  double cell_volume = std::numeric_limits<double>::quiet_NaN(), porosity = cell_volume, porosity_error = cell_volume;
};

/// Errors: a probe below 0, not finite, or so large that radii exceed 2^40 times the extent of the set; a set with
/// images (SphereSet::replicate); not enough memory; or cancelled (base/watch.h). With MeasureOptions::periodic also:
/// no cell, or one without images (Lattice::why_none); spheres that lie more than 2^13 cells apart; spheres so large
/// that one may meet more than 2^13 images of another, or all of them 2^28.
Result<UnionMeasures> measure_union(const SphereSet& spheres, const MeasureOptions& options = {});

}  // namespace bihive
