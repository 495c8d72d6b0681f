#include "bihive/measure/periodic_balls.h"

#include <algorithm>
#include <cmath>

#include "bihive/measure/exact_number.h"

namespace bihive::measure {
namespace {

constexpr std::int64_t kMostCells = 1 << 13, kMostImages = std::int64_t{1} << 28;
constexpr double kMostOverlaps = 1 << 13;
// Many more than distances and shares lose by rounding.
constexpr double kReachAllowance = 1 + 0x1p-40;

// Bounds of all centres: along the axes, and in shares of the lattice's vectors.
struct Extent {
  Vec3d lo, hi, lowest_share, highest_share;
  double largest = 0;  // coordinate

  Extent(const Balls& balls, const Lattice& lattice) {
    for (std::int64_t i = 0; i < balls.size(); ++i) {
      const Vec3d centre = balls.centre[i], share = lattice.shares(centre);
      largest = std::max(largest, largest_coordinate(centre));
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = i == 0 ? centre[axis] : std::min(lo[axis], centre[axis]);
        hi[axis] = i == 0 ? centre[axis] : std::max(hi[axis], centre[axis]);
        lowest_share[axis] = i == 0 ? share[axis] : std::min(lowest_share[axis], share[axis]);
        highest_share[axis] = i == 0 ? share[axis] : std::max(highest_share[axis], share[axis]);
      }
    }
  }
  // From a point to the box along the axes.
  double distance2(Vec3d point) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double beyond = std::max({lo[axis] - point[axis], point[axis] - hi[axis], 0.0});
      sum += beyond * beyond;
    }
    return sum;
  }
};

// The nearest multiple of 2^-exponent.
Vec3d on_grid(Vec3d x, int exponent) {
  const auto round = [exponent](double number) {
    const double scaled = std::ldexp(number, exponent);
    return std::abs(scaled) < 0x1p52 ? std::ldexp(std::nearbyint(scaled), -exponent) : number;
  };
  return {round(x.x), round(x.y), round(x.z)};
}

// centre + counts * vectors as a sum of two numbers of binary64, without rounding.
struct Place {
  Vec3d centre, rest;
};
Place place_of(Vec3d centre, const ImageCounts& counts, const std::array<Vec3d, 3>& vectors) {
  Place place{centre, {}};
  if (counts == ImageCounts{}) return place;
  for (int axis = 0; axis < 3; ++axis) {
    ExactNumber sum(centre[axis]);
    for (std::size_t k = 0; k < 3; ++k)
      sum = sum + ExactNumber(static_cast<double>(counts[k])) * ExactNumber(vectors[k][axis]);
    place.centre[axis] = sum.to_double();
    place.rest[axis] = (sum - ExactNumber(place.centre[axis])).to_double();
  }
  return place;
}

Image image_of(std::int64_t ball, const ImageCounts& counts) {
  return {ball, static_cast<std::int32_t>(counts[0]), static_cast<std::int32_t>(counts[1]),
          static_cast<std::int32_t>(counts[2])};
}

Error too_large(const std::string& what) {
  return {what, "", 0, 0, "a smaller probe or smaller radii"};
}

}  // namespace

Result<std::vector<ImageCounts>> add_images(Balls& balls, const Lattice& lattice) {
  const std::int64_t own = balls.size();
  std::vector<ImageCounts> moved(static_cast<std::size_t>(own));
  if (own == 0) return moved;

  // Into the cell that begins with the lowest shares; rounded for the time being.
  std::vector<Vec3d> stored = balls.centre;
  const Vec3d lowest = Extent(balls, lattice).lowest_share;
  for (std::int64_t i = 0; i < own; ++i) {
    const Vec3d share = lattice.shares(stored[i]) - lowest;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cells = std::floor(share[static_cast<int>(k)]);
      if (!(std::abs(cells) <= kMostCells))
        return Error{"spheres lie more than 8,192 cells from each other", "", 0, 0, ""};
      moved[i][k] = -static_cast<std::int64_t>(cells);
    }
    balls.centre[i] = stored[i] + lattice.shift(moved[i]);
  }

  // Images that may share a point with a ball of the cell.
  const Extent extent(balls, lattice);
  const double largest_radius = *std::max_element(balls.radius.begin(), balls.radius.end());
  std::vector<Image> images;
  bool too_many = false;
  double largest = extent.largest;
  std::array<std::int64_t, 3> most_counts{};
  for (std::int64_t i = 0; i < own && !too_many; ++i) {
    const double reach = (balls.radius[i] + largest_radius) * kReachAllowance + 0x1p-40 * extent.largest;
    const Lattice::Range range =
        lattice.images_within(reach, balls.centre[i], extent.lowest_share, extent.highest_share, extent.largest);
    if (range.count() > kMostOverlaps) return too_large("a sphere may meet more than 8,192 images along the cell");
    for (std::size_t k = 0; k < 3; ++k)
      most_counts[k] =
          std::max({most_counts[k], std::abs(moved[i][k]), std::abs(range.first[k]), std::abs(range.last[k])});
    any_image(range, [&](const ImageCounts& against) {
      // Counts that bring the others to ball i: the opposite ones bring it to them.
      const ImageCounts counts{-against[0], -against[1], -against[2]};
      const Vec3d centre = balls.centre[i] + lattice.shift(counts);
      if (counts == ImageCounts{} || extent.distance2(centre) > reach * reach) return false;
      images.push_back(image_of(i, counts));
      largest = std::max(largest, largest_coordinate(centre));
      too_many = static_cast<std::int64_t>(images.size()) > kMostImages;
      return too_many;
    });
  }
  if (too_many) return too_large("the spheres have more than 2^28 images that may meet them");
  std::sort(images.begin(), images.end());

  // Multiples of 2^-100 of what no coordinate exceeds: they are sums of two numbers of binary64.
  const int exponent = std::max(std::ilogb(4 * (largest + largest_radius)) + 1, 0);
  std::array<Vec3d, 3> vectors;
  for (std::size_t k = 0; k < 3; ++k) {
    if (most_counts[k] == 0) continue;
    ImageCounts one{};
    one[k] = 1;
    vectors[k] = lattice.shift(one);
  }
  for (Vec3d& vector : vectors) vector = on_grid(vector, 100 - exponent);
  balls.rest.resize(static_cast<std::size_t>(own));
  for (std::int64_t i = 0; i < own; ++i) {
    stored[i] = on_grid(stored[i], 100 - exponent);
    const Place place = place_of(stored[i], moved[i], vectors);
    balls.centre[i] = place.centre;
    balls.rest[i] = place.rest;
    balls.image.push_back(image_of(i, {}));
  }
  for (const Image& image : images) {
    const Place place = place_of(stored[image.ball], image.counts() + moved[image.ball], vectors);
    balls.centre.push_back(place.centre);
    balls.rest.push_back(place.rest);
    balls.radius.push_back(balls.radius[image.ball]);
    balls.image.push_back(image);
  }
  return moved;
}

std::int64_t find_image(const Balls& balls, std::int64_t cell_balls, const Image& image) {
  if (image.counts() == ImageCounts{}) return image.ball;
  const auto first = balls.image.begin() + cell_balls;
  const auto found = std::lower_bound(first, balls.image.end(), image);
  return found != balls.image.end() && *found == image ? found - balls.image.begin() : -1;
}

}  // namespace bihive::measure
