#include "bihive/render/query/coinciding_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace bihive {
namespace {

// Stored units. Rounding moves a coordinate by at most 2^-25, so places farther apart than twice that never meet. A
// wider bound has room for the roundings here.
constexpr double kNear = 0x1p-22;
// The side of the cubes that places are sorted into: two spheres in one cube may coincide.
constexpr double kSide = 0x1p-18;
// How many shifts of the cell, and how many spheres for each stored one, are looked at before the answer is "may be".
constexpr double kMostShifts = 1e7;
constexpr std::int64_t kMostLooks = 64;

// The cubes that hold a sphere.
class Cubes {
 public:
  explicit Cubes(std::int64_t spheres) {
    std::size_t size = 16;
    while (size < 2 * static_cast<std::size_t>(spheres)) size *= 2;
    keys_.resize(size, kEmpty);
  }
  // False: it was there already.
  bool add(std::uint64_t key) {
    std::size_t at = place(key);
    while (keys_[at] != kEmpty && keys_[at] != key) at = (at + 1) & (keys_.size() - 1);
    if (keys_[at] == key) return false;
    keys_[at] = key;
    return true;
  }
  bool has(std::uint64_t key) const {
    std::size_t at = place(key);
    while (keys_[at] != kEmpty && keys_[at] != key) at = (at + 1) & (keys_.size() - 1);
    return keys_[at] == key;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  std::size_t place(std::uint64_t key) const {
    key *= 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(key ^ key >> 32) & (keys_.size() - 1);
  }
  std::vector<std::uint64_t> keys_;
};

// Coordinates are at most 1, so each number of a cube has 20 bits.
std::uint64_t number_of(double coordinate) {
  return static_cast<std::uint64_t>(std::floor(std::clamp(coordinate, -1.0, 1.0) / kSide) + 0x1p18);
}
std::uint64_t key_of_cube(const std::array<std::uint64_t, 3>& numbers) {
  return numbers[0] << 40 | numbers[1] << 20 | numbers[2];
}
std::uint64_t key_of(Vec3d at) {
  return key_of_cube({number_of(at.x), number_of(at.y), number_of(at.z)});
}

// Calls found(key) for the cube of a place and for those whose border is near; until it returns true.
template <class Found>
bool any_cube_near(Vec3d at, const Found& found) {
  std::array<std::array<std::uint64_t, 2>, 3> numbers{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    numbers[k] = {number_of(at[axis] - kNear), number_of(at[axis] + kNear)};
  }
  for (const std::uint64_t x : {numbers[0][0], numbers[0][1]})
    for (const std::uint64_t y : {numbers[1][0], numbers[1][1]})
      for (const std::uint64_t z : {numbers[2][0], numbers[2][1]})
        if (found(key_of_cube({x, y, z}))) return true;
  return false;
}

struct Box {
  Vec3d lo, hi;

  bool has(Vec3d at) const {
    return at.x >= lo.x && at.x <= hi.x && at.y >= lo.y && at.y <= hi.y && at.z >= lo.z && at.z <= hi.z;
  }
};

}  // namespace

bool images_may_coincide(const SphereSet& spheres) {
  const Images& images = spheres.images();
  double shifts = 1;
  for (const std::int32_t count : images.counts) shifts *= 2.0 * count - 1;
  if (shifts > kMostShifts) return true;

  // Sort the stored spheres into cubes.
  Cubes cubes(spheres.size());
  Box box{spheres.stored_centre(0), spheres.stored_centre(0)};
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d at = spheres.stored_centre(id);
    if (!cubes.add(key_of(at))) return true;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], at[axis]);
      box.hi[axis] = std::max(box.hi[axis], at[axis]);
    }
  }
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const Vec3d at = spheres.stored_centre(id);
    const std::uint64_t own = key_of(at);
    if (any_cube_near(at, [&](std::uint64_t key) { return key != own && cubes.has(key); })) return true;
  }
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] -= 2 * kNear;
    box.hi[axis] += 2 * kNear;
  }

  // Move them by each difference of two images, one of each pair of opposite ones.
  std::int64_t looks = 0;
  const auto [a, b, c] = images.counts;
  for (std::int32_t i = 0; i < a; ++i)
    for (std::int32_t j = i == 0 ? 0 : 1 - b; j < b; ++j)
      for (std::int32_t k = i == 0 && j == 0 ? 1 : 1 - c; k < c; ++k) {
        const Vec3d shift = spheres.scale() * images.shift({i, j, k});
        bool apart = false;
        for (int axis = 0; axis < 3; ++axis) apart = apart || std::abs(shift[axis]) > box.hi[axis] - box.lo[axis];
        if (apart) continue;
        looks += spheres.size();
        if (looks > kMostLooks * spheres.size()) return true;
        for (std::int64_t id = 0; id < spheres.size(); ++id) {
          const Vec3d at = spheres.stored_centre(id) + shift;
          if (box.has(at) && any_cube_near(at, [&](std::uint64_t key) { return cubes.has(key); })) return true;
        }
      }
  return false;
}

}  // namespace bihive
