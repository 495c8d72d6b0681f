// The sphere set: structure of arrays of centres and radii, with optional attributes.
//
// Centres and radii are binary32 in *stored units* = world units times 2^scale_exponent. The exponent brings every
// bound of the set into [-1, 1]. The power of two is exact, and it keeps squares of binary32 away from overflow and
// underflow for worlds measured in 1e-20 as in 1e20. Ids are 0-based positions in the order in which the set was read;
// counts are 64-bit.
//
// A set may represent copies of itself (images, geometry/cell.h), of which only the first is stored. The others have
// ids too: that of sphere `id` in copy k is k * size() + id.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/cell.h"
#include "bihive/geometry/sphere_attributes.h"
#include "bihive/math/aabb.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// A view of numbers owned by somebody else, `step_bytes` apart: for example a column of a table. The step may be
/// negative, or 0: one number for all. They need not be aligned.
struct NumbersView {
  enum class Precision { binary32, binary64 };

  const void* first = nullptr;
  std::ptrdiff_t step_bytes = 0;
  std::size_t count = 0;
  Precision precision = Precision::binary64;
};

/// Spheres as a set stores them: binary32, world units times 2^scale_exponent.
struct StoredSpheres {
  std::vector<float> x, y, z, r;
};

class SphereSet {
 public:
  SphereSet() = default;

  /// A set of these spheres in these units, without images: a subset of a larger set, which defines the units. Every
  /// bound must lie in [-1, 1].
  static SphereSet from_stored(StoredSpheres spheres, int scale_exponent);
  /// Appends spheres in the set's own stored units. The set has no images.
  void append_stored(const StoredSpheres& spheres);
  /// The spheres with these ids, in this order, without touching the attributes.
  void order_stored(const std::vector<std::int64_t>& ids);
  /// Keeps the first `count` spheres, without touching the attributes.
  void keep_first(std::int64_t count);

  /// Takes world units, n entries each; rounds once, to binary32 in stored units. Error: NaN, an infinity, a coordinate
  /// or radius beyond binary32's range (3.4e38), or a radius below 0; the message names the sphere's position. A radius
  /// of 0 is allowed; that sphere is never hit. Arrays of unequal length are a programmer's error.
  static Result<SphereSet> from_world(const std::vector<double>& x, const std::vector<double>& y,
                                      const std::vector<double>& z, const std::vector<double>& r);
  static Result<SphereSet> from_world(const std::vector<float>& x, const std::vector<float>& y,
                                      const std::vector<float>& z, const std::vector<float>& r);
  /// A chunk of a larger set, in the units of the whole set. `first_id`: of the chunk's first sphere in the whole set,
  /// for messages. `extent`: the greatest extent_of_world() of all chunks.
  static Result<SphereSet> chunk_from_world(const std::vector<double>& x, const std::vector<double>& y,
                                            const std::vector<double>& z, const std::vector<double>& r,
                                            std::int64_t first_id, double extent);
  /// The farthest bound of these spheres from 0 along an axis, which decides the units. Errors as from_world().
  static Result<double> extent_of_world(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& z, const std::vector<double>& r,
                                        std::int64_t first_id);
  /// The same from numbers in place. x, y and z must have the same precision.
  static Result<SphereSet> from_world(const NumbersView& x, const NumbersView& y, const NumbersView& z,
                                      const NumbersView& r);

  /// The spheres that are stored.
  std::int64_t size() const { return static_cast<std::int64_t>(x_.size()); }
  bool empty() const { return x_.empty(); }

  /// The spheres with all their images. Every id below is one.
  std::int64_t total_size() const { return size() * images_.count(); }
  bool has_images() const { return images_.count() > 1; }
  const Images& images() const { return images_; }
  /// The stored sphere of which this one is an image, or itself. Negative ids (nothing, the plane) stay what they are.
  std::int64_t stored_id(std::int64_t id) const { return id < size() ? id : id % size(); }

  /// Makes the set represent counts[0] x counts[1] x counts[2] copies of it along `vectors` (world units). The centre
  /// of an image is the stored centre plus Images::shift(), a sum in binary64, rounded once to binary32. Nothing is
  /// copied; the stored units change, so that all images are within [-1, 1]. Images that it had before are gone; 1 x 1
  /// x 1 leaves none. Error: a count below 1, a vector that is not finite or of length 0 where there are copies along
  /// it, copies beyond binary32's range, or more than 2^40 spheres with images (of an empty set: 2^40
  /// copies).
  Status replicate(const std::array<Vec3d, 3>& vectors, const std::array<std::int32_t, 3>& counts);
  /// The same copies and cell as `other` has; for a set that was made from its spheres.
  Status keep_cell_of(const SphereSet& other);

  /// The periodic cell, if one is known.
  std::optional<Cell>& cell() { return cell_; }
  const std::optional<Cell>& cell() const { return cell_; }

  /// The stored spheres' centres and radii, in stored units.
  const std::vector<float>& x() const { return x_; }
  const std::vector<float>& y() const { return y_; }
  const std::vector<float>& z() const { return z_; }
  const std::vector<float>& r() const { return r_; }
  Vec3d stored_centre(std::int64_t id) const {
    if (id >= size()) return stored_image_centre(id);
    const auto i = static_cast<std::size_t>(id);
    return {double(x_[i]), double(y_[i]), double(z_[i])};
  }
  double stored_radius(std::int64_t id) const { return double(r_[static_cast<std::size_t>(stored_id(id))]); }
  /// The sphere's box as the tree uses it: centre -/+ radius in binary32, rounded to nearest.
  Aabb stored_box(std::int64_t id) const {
    const auto i = static_cast<std::size_t>(id);
    return {{x_[i] - r_[i], y_[i] - r_[i], z_[i] - r_[i]}, {x_[i] + r_[i], y_[i] + r_[i], z_[i] + r_[i]}};
  }

  int scale_exponent() const { return scale_exponent_; }
  /// stored = world * scale(); a power of two, exact in binary64 (2^-129 to 2^149).
  double scale() const { return std::ldexp(1.0, scale_exponent_); }

  /// World units.
  Vec3d centre(std::int64_t id) const { return stored_centre(id) * inverse_scale(); }
  double radius(std::int64_t id) const { return stored_radius(id) * inverse_scale(); }
  double inverse_scale() const { return std::ldexp(1.0, -scale_exponent_); }
  /// The smallest box around all spheres and images (radius 0 too), in world units as binary64: lo and hi. An empty set
  /// has lo = inf and hi = -inf.
  struct Bounds {
    Vec3d lo, hi;
  };
  Bounds bounds() const;

  /// The number of radii above 0 but below 2^-60 of the set's extent: such a radius cannot be told apart from 0
  /// reliably.
  std::int64_t vanishing_radii() const { return vanishing_radii_; }

  /// The stored spheres of these ids in their order, in the same stored units, with the same images; without
  /// attributes.
  SphereSet part(const std::vector<std::int64_t>& ids) const;

  SphereAttributes& attributes() { return attributes_; }
  const SphereAttributes& attributes() const { return attributes_; }

  /// Bytes held by centres, radii and attributes.
  std::int64_t allocated_bytes() const;

 private:
  std::vector<float> x_, y_, z_, r_;
  int scale_exponent_ = 0;
  std::int64_t vanishing_radii_ = 0;
  SphereAttributes attributes_;
  std::optional<Cell> cell_;
  Images images_;

  Vec3d stored_image_centre(std::int64_t id) const;
  void count_vanishing_radii();

  template <class Coordinates, class Radii>
  static Result<double> extent(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                               std::int64_t first_id);
  template <class Coordinates, class Radii>
  static Result<SphereSet> make(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                std::int64_t first_id = 0, double extent_of_others = 0);
};

}  // namespace bihive
