#include "bihive/geometry/sphere_set.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/readable.h"

namespace bihive {
namespace {

// Radii below this fraction of the extent are counted: their squares still fit binary32, but little else does.
constexpr double kVanishingShare = 0x1p-60;

// Scales the smallest number of binary32, 2^-149, to 1. A binary64 file may hold smaller sets, but no ray can see them,
// and a larger scale could overflow.
constexpr int kLargestScaleExponent = 149;

// Ids of images stay far from the end of 64 bits, and are exact in binary64.
constexpr double kMostImages = 0x1p40;

template <class T>
std::int64_t bytes_of(const std::vector<T>& array) {
  return static_cast<std::int64_t>(array.capacity() * sizeof(T));
}

Error bad_sphere(std::size_t i, const std::string& what, double value) {
  char number[40];
  std::snprintf(number, sizeof number, "%.9g", value);
  return {"sphere " + std::to_string(i) + ": " + what + " is " + number, "", 0, 0, ""};
}

// A NumbersView of one precision, to be read like a vector.
template <class T>
class TypedView {
 public:
  explicit TypedView(const NumbersView& view) : view_(view) {}

  std::size_t size() const { return view_.count; }
  T operator[](std::size_t i) const { return view_.get<T>(i); }

 private:
  NumbersView view_;
};

}  // namespace

double WorldEnds::extent(Vec3d from) const {
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = from[static_cast<int>(k)];
    extent = std::max({extent, below[k] + at, above[k] - at});
  }
  return extent;
}

Vec3d WorldEnds::origin() const {
  double half = 0;
  Vec3d middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[static_cast<int>(k)] = 0.5 * above[k] - 0.5 * below[k];
    half = std::max(half, 0.5 * above[k] + 0.5 * below[k]);
  }
  if (!(half > 0)) return {};
  const double unit = std::ldexp(1.0, std::ilogb(half));
  const Vec3d origin{std::nearbyint(middle.x / unit) * unit, std::nearbyint(middle.y / unit) * unit,
                     std::nearbyint(middle.z / unit) * unit};
  return is_finite(origin) && extent(origin) <= 0.5 * extent() ? origin : Vec3d{};
}

// Checks every number, and finds the ends.
template <class Coordinates, class Radii>
Result<WorldEnds> SphereSet::ends_of(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                     std::int64_t first_id) {
  BIHIVE_CHECK_EQ(x.size(), y.size());
  BIHIVE_CHECK_EQ(x.size(), z.size());
  BIHIVE_CHECK_EQ(x.size(), r.size());
  const auto first = static_cast<std::size_t>(first_id);
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  WorldEnds ends;
  ends.below = ends.above = {-kInfinite, -kInfinite, -kInfinite};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double values[4] = {double(x[i]), double(y[i]), double(z[i]), double(r[i])};
    const char* const names[4] = {"x", "y", "z", "the radius"};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!std::isfinite(values[k]))
        return bad_sphere(first + i, std::string(names[k]) + " must be finite but", values[k]);
      if (!(std::abs(values[k]) <= kLargest))
        return bad_sphere(first + i, std::string(names[k]) + " must fit single precision (3.4e38) but", values[k]);
      if (k == 3) continue;
      ends.below[k] = std::max(ends.below[k], values[3] - values[k]);
      ends.above[k] = std::max(ends.above[k], values[3] + values[k]);
    }
    if (values[3] < 0) return bad_sphere(first + i, "the radius must not be negative but", values[3]);
  }
  return ends;
}

namespace {

// The exponent that brings the farthest bound into [1/2, 1].
int scale_exponent_for(double extent) {
  int exponent = 0;
  if (extent > 0) std::frexp(extent, &exponent);
  return std::min(-exponent, kLargestScaleExponent);
}

}  // namespace

template <class Coordinates, class Radii>
bool SphereSet::is_coarse(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                          const WorldEnds& ends) {
  const double scale = std::ldexp(1.0, scale_exponent_for(ends.extent()));
  const bool is_far = kFarExtents * ends.extent(ends.origin()) <= ends.extent();
  const auto rounding = [scale](double world) {
    const double stored = world * scale;
    return double(static_cast<float>(stored)) - stored;
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(double(r[i]) > 0)) continue;
    if (is_far && double(r[i]) * scale < kFineRadius) return true;
    const Vec3d moved{rounding(double(x[i])), rounding(double(y[i])), rounding(double(z[i]))};
    const double harmless = kHarmlessShift * double(r[i]) * scale;
    if (dot(moved, moved) > harmless * harmless) return true;
  }
  return false;
}

// Rounds once, to binary32 in stored units. A bound about an origin is a rounded difference, so its extent may be a bit
// too small.
template <class Coordinates, class Radii>
Result<SphereSet> SphereSet::make_about(const Coordinates& x, const Coordinates& y, const Coordinates& z,
                                        const Radii& r, const WorldEnds& ends, Vec3d origin) {
  // The tree of a small set decides whether it fits.
  constexpr std::size_t kSmallSet = 1 << 16;
  if (x.size() > kSmallSet)
    if (Status status = check_memory(static_cast<double>(x.size()) * 4 * sizeof(float),
                                     "a set of " + grouped(static_cast<std::int64_t>(x.size())) + " spheres");
        !status)
      return status.error();

  SphereSet set;
  set.origin_ = origin;
  set.scale_exponent_ = scale_exponent_for(set.has_origin() ? ends.extent(origin) * (1 + 0x1p-50) : ends.extent());
  const double scale = set.scale();
  bool as_before = true;
  const auto round = [scale, &as_before](const auto& world, double from) {
    std::vector<float> stored(world.size());
    bool small = true;
    for (std::size_t i = 0; i < world.size(); ++i) {
      stored[i] = static_cast<float>((double(world[i]) - from) * scale);
      small &= std::abs(stored[i]) <= 1;
    }
    as_before &= small;
    return stored;
  };
  set.x_ = round(x, origin.x);
  set.y_ = round(y, origin.y);
  set.z_ = round(z, origin.z);
  set.r_ = round(r, 0);
  for (const float radius : set.r_) as_before &= radius >= 0;
  if (!as_before)
    return Error{"the numbers of the spheres change while they are read", "", 0, 0, "another thread writes"};
  for (std::size_t i = 0; i < r.size(); ++i)
    if (r[i] > 0 && double(r[i]) * scale < kVanishingShare) ++set.vanishing_radii_;
  return set;
}

template <class Coordinates, class Radii>
Result<SphereSet> SphereSet::make(const Coordinates& x, const Coordinates& y, const Coordinates& z, const Radii& r,
                                  Origin origin) {
  const Result<WorldEnds> ends = ends_of(x, y, z, r, 0);
  if (!ends) return ends.error();
  const bool coarse = origin == Origin::fitting && is_coarse(x, y, z, r, *ends);
  return make_about(x, y, z, r, *ends, coarse ? ends->origin() : Vec3d{});
}

Result<SphereSet> SphereSet::from_world(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& z, const std::vector<double>& r) {
  return make(x, y, z, r);
}

Result<SphereSet> SphereSet::from_local(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& z, const std::vector<double>& r, Vec3d origin) {
  Result<SphereSet> set = make(x, y, z, r);
  if (set) set->origin_ = origin;
  return set;
}

Result<SphereSet> SphereSet::chunk_from_world(const std::vector<double>& x, const std::vector<double>& y,
                                              const std::vector<double>& z, const std::vector<double>& r,
                                              const WorldEnds& ends, Vec3d origin) {
  return make_about(x, y, z, r, ends, origin);
}

Result<WorldEnds> SphereSet::ends_of_world(const std::vector<double>& x, const std::vector<double>& y,
                                           const std::vector<double>& z, const std::vector<double>& r,
                                           std::int64_t first_id) {
  return ends_of(x, y, z, r, first_id);
}

bool SphereSet::is_coarse_about_zero(const std::vector<double>& x, const std::vector<double>& y,
                                     const std::vector<double>& z, const std::vector<double>& r,
                                     const WorldEnds& ends) {
  return is_coarse(x, y, z, r, ends);
}

Result<SphereSet> SphereSet::from_world(const std::vector<float>& x, const std::vector<float>& y,
                                        const std::vector<float>& z, const std::vector<float>& r) {
  return make(x, y, z, r);
}

Result<SphereSet> SphereSet::from_world(const NumbersView& x, const NumbersView& y, const NumbersView& z,
                                        const NumbersView& r, Origin origin) {
  using Precision = NumbersView::Precision;
  BIHIVE_CHECK(x.precision == y.precision && x.precision == z.precision);
  const auto with_radii = [&](const auto& one, const auto& two, const auto& three) {
    if (r.precision == Precision::binary32) return make(one, two, three, TypedView<float>(r), origin);
    return make(one, two, three, TypedView<double>(r), origin);
  };
  if (x.precision == Precision::binary32)
    return with_radii(TypedView<float>(x), TypedView<float>(y), TypedView<float>(z));
  return with_radii(TypedView<double>(x), TypedView<double>(y), TypedView<double>(z));
}

SphereSet SphereSet::from_stored(StoredSpheres spheres, int scale_exponent, Vec3d origin) {
  BIHIVE_CHECK_EQ(spheres.x.size(), spheres.y.size());
  BIHIVE_CHECK_EQ(spheres.x.size(), spheres.z.size());
  BIHIVE_CHECK_EQ(spheres.x.size(), spheres.r.size());
  SphereSet set;
  set.scale_exponent_ = scale_exponent;
  set.origin_ = origin;
  set.x_ = std::move(spheres.x);
  set.y_ = std::move(spheres.y);
  set.z_ = std::move(spheres.z);
  set.r_ = std::move(spheres.r);
  set.count_vanishing_radii();
  return set;
}

void SphereSet::append_stored(const StoredSpheres& spheres) {
  BIHIVE_CHECK(!has_images());
  x_.insert(x_.end(), spheres.x.begin(), spheres.x.end());
  y_.insert(y_.end(), spheres.y.begin(), spheres.y.end());
  z_.insert(z_.end(), spheres.z.begin(), spheres.z.end());
  r_.insert(r_.end(), spheres.r.begin(), spheres.r.end());
}

void SphereSet::order_stored(const std::vector<std::int64_t>& ids) {
  for (auto* values : {&x_, &y_, &z_, &r_}) {
    std::vector<float> ordered;
    ordered.reserve(ids.size());
    for (const std::int64_t id : ids) ordered.push_back((*values)[static_cast<std::size_t>(id)]);
    *values = std::move(ordered);
  }
}

void SphereSet::keep_first(std::int64_t count) {
  for (auto* values : {&x_, &y_, &z_, &r_}) values->resize(static_cast<std::size_t>(count));
}

SphereSet::Bounds SphereSet::bounds() const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Bounds box{{inf, inf, inf}, {-inf, -inf, -inf}};
  const Images::Shifts shifts = images_.shifts();
  for (std::int64_t id = 0; id < size(); ++id) {
    const Vec3d c = stored_centre(id);
    const double radius = stored_radius(id);
    for (int axis = 0; axis < 3; ++axis) {
      double lo = c[axis];
      double hi = c[axis];
      if (has_images()) {
        lo = double(static_cast<float>(c[axis] + scale() * shifts.lo[axis]));
        hi = double(static_cast<float>(c[axis] + scale() * shifts.hi[axis]));
      }
      box.lo[axis] = std::min(box.lo[axis], lo - radius);
      box.hi[axis] = std::max(box.hi[axis], hi + radius);
    }
  }
  return {in_world(box.lo * inverse_scale()), in_world(box.hi * inverse_scale())};
}

SphereSet SphereSet::part(const std::vector<std::int64_t>& ids) const {
  SphereSet made;
  made.scale_exponent_ = scale_exponent_;
  made.origin_ = origin_;
  made.cell_ = cell_;
  made.images_ = images_;
  const auto take = [&](const std::vector<float>& from, std::vector<float>& to) {
    to.reserve(ids.size());
    for (const std::int64_t id : ids) to.push_back(from[static_cast<std::size_t>(id)]);
  };
  take(x_, made.x_);
  take(y_, made.y_);
  take(z_, made.z_);
  take(r_, made.r_);
  made.count_vanishing_radii();
  return made;
}

void SphereSet::count_vanishing_radii() {
  vanishing_radii_ = std::count_if(r_.begin(), r_.end(), [](float r) { return r > 0 && double(r) < kVanishingShare; });
}

Vec3d SphereSet::stored_image_centre(std::int64_t id) const {
  const Vec3d own = stored_centre(id % size());
  return to_double(to_float(own + scale() * images_.shift(id / size())));
}

Status SphereSet::replicate(const std::array<Vec3d, 3>& vectors, const std::array<std::int32_t, 3>& counts) {
  const auto bad = [](const std::string& message) { return Error{message, "", 0, 0, ""}; };
  // Check the vectors and the counts.
  constexpr double kLargest = std::numeric_limits<float>::max();
  double all = static_cast<double>(std::max<std::int64_t>(1, size()));  // an empty set's copies are counted too
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name(1, "abc"[k]);
    if (counts[k] < 1) return bad("there must be at least 1 copy along the cell's vector " + name);
    if (!is_finite(vectors[k])) return bad("the cell's vector " + name + " must be finite");
    if (counts[k] > 1 && vectors[k] == Vec3d{})
      return bad("the cell has no extent along its vector " + name + ", so there are no copies along it");
    all *= counts[k];
  }
  if (all > kMostImages) return bad("more than 2^40 spheres with their copies");
  Images images{counts, vectors};
  if (images.count() == 1 && !has_images()) return Done{};

  // Find the farthest bound from 0 of all images. A rounded sum grows with its operands, so the farthest shifts do.
  const Images::Shifts shifts = images.shifts();
  double extent = 0;
  for (std::int64_t id = 0; id < size(); ++id) {
    const Vec3d c = local_centre(id);
    for (int axis = 0; axis < 3; ++axis)
      for (const double by : {shifts.lo[axis], shifts.hi[axis]}) {
        if (!(std::abs(c[axis] + by) <= kLargest))
          return bad("the copies must fit single precision (3.4e38) but a centre is beyond it");
        extent = std::max(extent, std::abs(double(static_cast<float>(c[axis] + by))) + radius(id));
      }
  }

  // Bring it into [1/2, 1] by another power of two, which is exact but for the smallest numbers of binary32. Like
  // any sum with a shift, that with 0 makes -0 to 0.
  change_exponent(scale_exponent_for(extent));
  images_ = images;
  return Done{};
}

void SphereSet::make_room(double extent) {
  if (extent * scale() > 1) change_exponent(scale_exponent_for(extent));
}

void SphereSet::change_exponent(int exponent) {
  const int change = exponent - scale_exponent_;
  for (auto* values : {&x_, &y_, &z_, &r_})
    for (float& value : *values) value = static_cast<float>(std::ldexp(double(value), change) + 0.0);
  scale_exponent_ = exponent;
  count_vanishing_radii();
}

Status SphereSet::keep_cell_of(const SphereSet& other) {
  cell_ = other.cell_;
  return other.has_images() ? replicate(other.images_.vectors, other.images_.counts) : Status(Done{});
}

std::int64_t SphereSet::allocated_bytes() const {
  std::int64_t bytes = bytes_of(x_) + bytes_of(y_) + bytes_of(z_) + bytes_of(r_);
  bytes += attributes_.allocated_bytes();
  return bytes;
}

}  // namespace bihive
