#include "bihive/scene/density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "bihive/math/elementary.h"
#include "bihive/scene/central_box.h"
#include "bihive/settings/picture_effects.h"

namespace bihive {
namespace {

// The extent is that of this share of the points, along each axis.
constexpr double kShareOfExtent = 0.98;
// Dots of small sets, as a share of the extent.
constexpr double kLargestDotOfFew = 0.05;

// Coverage of squares of this size by the discs of spheres, in one projection of the box. Stored units.
class Coverage {
 public:
  Coverage(const CentralBox& box, std::size_t across, std::size_t up, double square)
      : box_(box), across_(across), up_(up), square_(square), columns_(squares(across)) {
    covered_.resize(columns_ * squares(up));
  }

  void add(const std::array<float, 3>& centre, double radius) {
    covered_[place(centre, up_) * columns_ + place(centre, across_)] += std::numbers::pi * radius * radius;
  }

  // The percentile of the coverage of all squares with a disc, in squares' areas.
  double percentile(double percent) {
    covered_.erase(std::remove(covered_.begin(), covered_.end(), 0.0), covered_.end());
    if (covered_.empty()) return 0;
    const double last = static_cast<double>(covered_.size() - 1);
    const auto at = covered_.begin() + static_cast<std::ptrdiff_t>(std::floor(last * percent / 100));
    std::nth_element(covered_.begin(), at, covered_.end());
    return *at / (square_ * square_);
  }

 private:
  std::size_t squares(std::size_t axis) const {
    return static_cast<std::size_t>(std::floor((double(box_.hi[axis]) - double(box_.lo[axis])) / square_)) + 1;
  }
  std::size_t place(const std::array<float, 3>& centre, std::size_t axis) const {
    return static_cast<std::size_t>(std::floor((double(centre[axis]) - double(box_.lo[axis])) / square_));
  }

  const CentralBox& box_;
  std::size_t across_, up_;
  double square_;
  std::size_t columns_;
  std::vector<double> covered_;
};

double mean_coverage(const SphereSet& spheres, const CentralBox& box, double square, std::optional<double> radius,
                     double percent) {
  double sum = 0;
  for (std::size_t along = 0; along < 3; ++along) {
    Coverage coverage(box, (along + 1) % 3, (along + 2) % 3, square);
    for (std::size_t i = 0; i < static_cast<std::size_t>(spheres.size()); ++i)
      if (box.holds(spheres, i))
        coverage.add({spheres.x()[i], spheres.y()[i], spheres.z()[i]}, radius.value_or(double(spheres.r()[i])));
    sum += coverage.percentile(percent);
  }
  return sum / 3;
}

}  // namespace

Density density_of(const SphereSet& spheres, const DensityStyle& style, bool assumed_radii) {
  const CentralBox box = central_box(spheres, kShareOfExtent);
  double extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, double(box.hi[axis]) - double(box.lo[axis]));
  const double of_few = std::min(1 / std::sqrt(static_cast<double>(spheres.size())), kLargestDotOfFew);
  const double dot = extent * std::max(style.dot / kLineUnitsOfPicture, of_few);

  Density density;
  std::optional<double> stored;
  if (assumed_radii && dot > 0) {
    stored = dot / 2;
    density.radius = *stored * spheres.inverse_scale();
  }
  double coverage = 0;
  double squares_of_radii = 0;
  for (const float r : spheres.r()) squares_of_radii += double(r) * double(r);
  // A square is as large as a typical disc, so that its coverage says how many are behind each other.
  const double typical = std::sqrt(squares_of_radii / static_cast<double>(spheres.size()));
  if (const double square = stored ? dot : std::max(dot, 2 * typical); square > 0)
    coverage = mean_coverage(spheres, box, square, stored, style.percentile);
  if (!spheres.attributes().opacity.empty()) return density;
  const double opacity = 1 - portable_pow(1 - style.brightness, 1 / std::max(coverage, 1.0));
  density.opacity = std::max(opacity, kLeastOpacityOfDots);
  return density;
}

bool set_radius(SphereSet& spheres, double radius) {
  const auto count = static_cast<std::size_t>(spheres.size());
  std::vector<double> x(count), y(count), z(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d centre = spheres.local_centre(static_cast<std::int64_t>(i));
    x[i] = centre.x;
    y[i] = centre.y;
    z[i] = centre.z;
  }
  Result<SphereSet> made = SphereSet::from_local(x, y, z, std::vector<double>(count, radius), spheres.origin());
  if (!made || !made->keep_cell_of(spheres)) return false;
  made->attributes() = std::move(spheres.attributes());
  spheres = std::move(*made);
  return true;
}

}  // namespace bihive
