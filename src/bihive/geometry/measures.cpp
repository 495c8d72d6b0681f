#include "bihive/geometry/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The direction of (x, y), above -180 to 180. Not both are 0.
double direction_deg(double y, double x) {
  const double steep = std::abs(y), flat = std::abs(x);
  const double acute = steep <= flat ? atan_deg(steep / flat) : 90 - atan_deg(flat / steep);
  const double upper = x < 0 ? 180 - acute : acute;
  return y < 0 ? -upper : upper;
}

// Scaled by a power of two so that the largest coordinate is about 1: products of tiny or huge vectors stay finite.
Vec3d scaled(Vec3d v) {
  const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(most > 0) || std::isinf(most)) return v;
  const int exponent = -std::ilogb(most);
  return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

}  // namespace

double angle_deg(Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d u = scaled(a - b), v = scaled(c - b);
  if (!(dot(u, u) > 0 && dot(v, v) > 0)) return kUnknown;
  return direction_deg(length(cross(u, v)), dot(u, v));
}

double dihedral_deg(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  const Vec3d first = scaled(b - a), axis = scaled(c - b), last = scaled(d - c);
  const Vec3d before = cross(first, axis), after = cross(axis, last);
  if (!(dot(before, before) > 0 && dot(after, after) > 0)) return kUnknown;
  return direction_deg(length(axis) * dot(first, after), dot(before, after));
}

double measured(const SphereSet& spheres, std::span<const std::int64_t> ids, const std::optional<Lattice>& lattice) {
  std::array<Vec3d, 4> at;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Vec3d centre = spheres.centre(ids[i]);
    at[i] = i == 0 ? centre : at[i - 1] + shortest_image(centre - at[i - 1], lattice);
  }
  if (ids.size() == 2) return length(at[1] - at[0]);
  return ids.size() == 3 ? angle_deg(at[0], at[1], at[2]) : dihedral_deg(at[0], at[1], at[2], at[3]);
}

Vec3d shortest_image(Vec3d vector, const std::optional<Lattice>& lattice) {
  if (!lattice || !lattice->holds(vector)) return vector;
  const ImageCounts cell = lattice->cell_of(vector);
  const Vec3d inside = vector - lattice->shift(cell);
  const Vec3d at[] = {inside};
  const Vec3d shares = lattice->shares(at[0]);
  const double largest = std::max({std::abs(inside.x), std::abs(inside.y), std::abs(inside.z)});
  const Lattice::Range range = lattice->images_within(lattice->covering(), {}, shares, shares, largest);
  Vec3d best = inside;
  any_image(range, [&](const ImageCounts& counts) {
    const Vec3d other = inside + lattice->shift(counts);
    if (dot(other, other) < dot(best, best)) best = other;
    return false;
  });
  return best;
}

}  // namespace bihive
