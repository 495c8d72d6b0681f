// The sphere set: structure of arrays of centres and radii, with optional attributes.
//
// Centres and radii are binary32 in *stored units* = world units times 2^scale_exponent. The exponent brings every
// bound of the set into [-1, 1]. The power of two is exact, and it keeps squares of binary32 away from overflow and
// underflow for worlds measured in 1e-20 as in 1e20. Ids are 0-based positions in the order in which the set was read;
// counts are 64-bit.
//
// Far from 0 binary32 is coarse: at 5,400,000 m its numbers are 0.5 m apart. Such a set has an *origin* in binary64,
// and stored units are relative to it: stored = (world - origin) times 2^scale_exponent. A position relative to the
// origin, in units of the world, is called *local*; without an origin that is the world. Rays are local
// (geometry/ray.h).
//
// A set may represent copies of itself (images, geometry/cell.h), of which only the first is stored. The others have
// ids too: that of sphere `id` in copy k is k * size() + id.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

  static NumbersView of(const std::vector<double>& numbers) {
    return {numbers.data(), static_cast<std::ptrdiff_t>(sizeof(double)), numbers.size(), Precision::binary64};
  }

  /// Number i, which must be of this type.
  template <class T>
  T get(std::size_t i) const {
    T number;
    std::memcpy(&number, static_cast<const char*>(first) + static_cast<std::ptrdiff_t>(i) * step_bytes, sizeof number);
    return number;
  }
  double at(std::size_t i) const { return precision == Precision::binary32 ? double(get<float>(i)) : get<double>(i); }
};

/// Spheres as a set stores them: binary32, world units times 2^scale_exponent.
struct StoredSpheres {
  std::vector<float> x, y, z, r;
};

/// The ends of spheres along the axes, in world units: the greatest of radius - centre, then the greatest of centre +
/// radius. Those of a whole set are the maximum of those of its chunks.
struct WorldEnds {
  std::array<double, 3> below{}, above{};

  /// The farthest bound from a point along an axis.
  double extent(Vec3d from = {}) const;
  /// A point near the middle, with few bits: a multiple of a power of two of about half the extent. So world - origin
  /// is exact for numbers with as many bits after the point as binary64 has for the farthest of them. 0 if numbers
  /// about it would not have at least a bit more than about 0.
  Vec3d origin() const;
};

class SphereSet {
 public:
  SphereSet() = default;

  /// The origin of a set made from world units: 0, or WorldEnds::origin() where units about 0 are coarse: rounding
  /// would move some centre by more than kHarmlessShift of its radius; or the set lies kFarExtents of its own extents
  /// away or more, so that some radius would be below kFineRadius stored units, which the filters of queries cannot
  /// tell from 0 although binary32 may hold every number of the set.
  enum class Origin { zero, fitting };
  static constexpr double kHarmlessShift = 0.01, kFarExtents = 8, kFineRadius = 0x1p-14;

  /// A set of these spheres in these units, without images: a subset of a larger set, which defines the units. Every
  /// bound must lie in [-1, 1].
  static SphereSet from_stored(StoredSpheres spheres, int scale_exponent, Vec3d origin);
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
  /// The same from local numbers.
  static Result<SphereSet> from_local(const std::vector<double>& x, const std::vector<double>& y,
                                      const std::vector<double>& z, const std::vector<double>& r, Vec3d origin);
  /// A chunk of a larger set, in the units of the whole set and relative to its origin. `ends` must hold those of every
  /// chunk, so ends_of_world() has checked the numbers.
  static Result<SphereSet> chunk_from_world(const std::vector<double>& x, const std::vector<double>& y,
                                            const std::vector<double>& z, const std::vector<double>& r,
                                            const WorldEnds& ends, Vec3d origin);
  /// Errors as from_world(), whose messages count the spheres from `first_id`. Without spheres all ends are -inf.
  static Result<WorldEnds> ends_of_world(const std::vector<double>& x, const std::vector<double>& y,
                                         const std::vector<double>& z, const std::vector<double>& r,
                                         std::int64_t first_id);
  /// Whether the units about 0 of a whole set with these ends are coarse for some of these spheres, as Origin says.
  static bool is_coarse_about_zero(const std::vector<double>& x, const std::vector<double>& y,
                                   const std::vector<double>& z, const std::vector<double>& r, const WorldEnds& ends);
  /// The same from numbers in place. x, y and z must have the same precision.
  static Result<SphereSet> from_world(const NumbersView& x, const NumbersView& y, const NumbersView& z,
                                      const NumbersView& r, Origin origin = Origin::zero);

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

  /// Makes sure that points up to this far from the origin along an axis (world units) have coordinates of at most 1 in
  /// stored units, which may change by a power of two: exact but for the smallest numbers of binary32.
  void make_room(double extent);

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
  /// stored = local * scale(); a power of two, exact in binary64 (2^-129 to 2^149).
  double scale() const { return std::ldexp(1.0, scale_exponent_); }

  /// World units.
  Vec3d centre(std::int64_t id) const { return in_world(local_centre(id)); }
  Vec3d local_centre(std::int64_t id) const { return stored_centre(id) * inverse_scale(); }
  Vec3d origin() const { return origin_; }
  bool has_origin() const { return origin_ != Vec3d{}; }
  Vec3d to_local(Vec3d world) const { return world - origin_; }
  Vec3d in_world(Vec3d local) const { return has_origin() ? local + origin_ : local; }  // -0 stays -0
  double radius(std::int64_t id) const { return stored_radius(id) * inverse_scale(); }
  double inverse_scale() const { return std::ldexp(1.0, -scale_exponent_); }
  /// The smallest box around all spheres and images (radius 0 too), in world units as binary64: lo and hi. An empty set
  /// has lo = inf and hi = -inf. With spheres on several ranks: the box of this rank's own; WholeSet has that of all.
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
  Vec3d origin_;
  std::int64_t vanishing_radii_ = 0;
  SphereAttributes attributes_;
  std::optional<Cell> cell_;
  Images images_;

  Vec3d stored_image_centre(std::int64_t id) const;
  void count_vanishing_radii();
  void change_exponent(int exponent);

  template <class Coordinates, class Radii>
  static Result<WorldEnds> ends_of(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                   std::int64_t first_id);
  template <class Coordinates, class Radii>
  static bool is_coarse(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                        const WorldEnds& ends);
  template <class Coordinates, class Radii>
  static Result<SphereSet> make(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                Origin origin = Origin::zero);
  template <class Coordinates, class Radii>
  static Result<SphereSet> make_about(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                      const WorldEnds& ends, Vec3d origin);
};

}  // namespace bihive
