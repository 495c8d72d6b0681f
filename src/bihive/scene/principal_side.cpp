#include "bihive/scene/principal_side.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bihive/geometry/each_sphere.h"
#include "bihive/math/symmetric_eigen.h"

namespace bihive {
namespace {

constexpr double kEqual = 1e-6;        // of the greatest variance
constexpr double kNearlyAlong = 0.99;  // the cosine of 8 degrees

// The covariance of the centres, times their number. They count from the first one, so that coordinates that are the
// same for all give exactly 0.
SymmetricMatrix<3> spread_of(const SphereSet& spheres) {
  if (spheres.empty()) return {};
  const Vec3d first = spheres.centre(0);
  Vec3d sum;
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double) { sum = sum + (centre - first); });
  const Vec3d mean = sum / static_cast<double>(spheres.total_size());
  SymmetricMatrix<3> spread{};
  for_each_sphere(spheres, [&](std::int64_t, Vec3d centre, double) {
    const Vec3d from_mean = (centre - first) - mean;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        spread[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += from_mean[i] * from_mean[j];
  });
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j) spread[i][j] = spread[j][i];
  return spread;
}

// The axis or its opposite: the first of these coordinates that is not 0 is above 0.
Vec3d turned_towards(Vec3d axis, std::array<int, 3> order) {
  for (const int i : order)
    if (axis[i] != 0) return axis[i] < 0 ? -axis : axis;
  return axis;
}
Vec3d towards_the_front(Vec3d axis) {
  return turned_towards(axis, {2, 1, 0});
}

// What remains of a vector at right angles to a unit vector.
Vec3d across(Vec3d vector, Vec3d axis) {
  return normalized(vector - dot(vector, axis) * axis);
}

// The direction of view nearest to the front with this axis across the picture, or up; from the right where the axis
// runs towards the front.
Side about_one_axis(Vec3d axis, bool is_upright) {
  const bool is_along_view = std::abs(axis.z) > kNearlyAlong;
  const Vec3d back = is_along_view ? across({1, 0, 0}, axis) : across({0, 0, 1}, axis);
  return {back, turned_towards(is_upright ? axis : cross(back, axis), {1, 2, 0})};
}

}  // namespace

Side upright_side(Vec3d back) {
  if (back.y > kNearlyAlong) return {back, across({0, 0, -1}, back)};
  if (back.y < -kNearlyAlong) return {back, across({0, 0, 1}, back)};
  return {back, across({0, 1, 0}, back)};
}

Side principal_side(const SphereSet& spheres, bool is_upright) {
  const Eigensystem<3> axes = eigensystem_of(spread_of(spheres));
  const auto axis = [&axes](std::size_t i) {
    return Vec3d{axes.vectors[i][0], axes.vectors[i][1], axes.vectors[i][2]};
  };
  const double least = kEqual * axes.values[0];
  const bool has_longest = axes.values[0] - axes.values[1] > least;
  const bool has_shortest = axes.values[1] - axes.values[2] > least;
  if (!has_longest && !has_shortest) return side_of(ViewFrom::front);
  if (!has_shortest) return about_one_axis(axis(0), is_upright);
  const Vec3d back = towards_the_front(axis(2));
  if (!has_longest) return upright_side(back);
  return {back, turned_towards(axis(is_upright ? 0 : 1), {1, 2, 0})};
}

}  // namespace bihive
