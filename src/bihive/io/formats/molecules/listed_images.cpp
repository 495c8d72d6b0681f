#include "bihive/io/formats/molecules/listed_images.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bihive {
namespace {

// Copies of coordinates differ by their last digit, different atoms by much more.
constexpr double kSameListedPlace = 0.05;  // Angstrom
constexpr double kMostBoxes = 1 << 20;
// Occupancies have few digits.
constexpr double kOneAtom = 1.01;
// No structure has more images in one box; those of a damaged file are not compared.
constexpr std::size_t kMostInBox = 64;

}  // namespace

ListedImages::ListedImages(const Cell& cell) : cell_(cell) {
  const auto& v = cell.vectors;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3d base = cross(v[(axis + 1) % 3], v[(axis + 2) % 3]);
    const double height = std::abs(dot(v[axis], base)) / length(base);
    const double boxes = std::clamp(std::floor(height / (2 * kSameListedPlace)), 1.0, kMostBoxes);
    boxes_[axis] = std::isfinite(boxes) ? static_cast<std::int64_t>(boxes) : 1;
  }
}

std::int64_t ListedImages::box_of(int axis, double fraction, std::int64_t step) const {
  const std::int64_t count = boxes_[static_cast<std::size_t>(axis)];
  const auto box = static_cast<std::int64_t>(fraction * static_cast<double>(count)) + step;
  return ((box % count) + count) % count;
}

std::uint64_t ListedImages::key_of(std::int64_t a, std::int64_t b, std::int64_t c) {
  return static_cast<std::uint64_t>(a) << 42 | static_cast<std::uint64_t>(b) << 21 | static_cast<std::uint64_t>(c);
}

bool ListedImages::is_same_place(Vec3d a, Vec3d b) const {
  Vec3d step = a - b;
  for (int axis = 0; axis < 3; ++axis) step[axis] -= std::floor(step[axis] + 0.5);
  const Vec3d way = step.x * cell_.vectors[0] + step.y * cell_.vectors[1] + step.z * cell_.vectors[2];
  return dot(way, way) < kSameListedPlace * kSameListedPlace;
}

void ListedImages::add(Vec3d fraction, Vec3d as_listed, int element, double occupancy) {
  const std::uint64_t key = key_of(box_of(0, fraction.x, 0), box_of(1, fraction.y, 0), box_of(2, fraction.z, 0));
  if (images_.count(key) < kMostInBox) images_.emplace(key, Image{fraction, as_listed, element, occupancy});
}

bool ListedImages::is_image_of_another(Vec3d fraction, int element, double occupancy) const {
  for (std::int64_t a = -1; a <= 1; ++a)
    for (std::int64_t b = -1; b <= 1; ++b)
      for (std::int64_t c = -1; c <= 1; ++c) {
        const auto [first, last] =
            images_.equal_range(key_of(box_of(0, fraction.x, a), box_of(1, fraction.y, b), box_of(2, fraction.z, c)));
        for (auto found = first; found != last; ++found) {
          const Image& image = found->second;
          if (image.element == element && image.occupancy + occupancy > kOneAtom &&
              is_same_place(fraction, image.fraction) && !is_same_place(fraction, image.as_listed))
            return true;
        }
      }
  return false;
}

}  // namespace bihive
