#include "bihive/io/assemble/unknown_radii.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/readable.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/assemble/nearest_place.h"
#include "bihive/io/elements.h"
#include "bihive/io/read_spheres.h"

namespace bihive {
namespace {

// Where there are no two places to take a distance from.
constexpr double kRadiusOfOnePlace = 0.5;

// More distances would move their middle by little, and each search costs a microsecond.
constexpr std::size_t kMostSearches = 65536;
// Spheres per task.
constexpr std::size_t kSearchesOfABundle = 1024;

// The van der Waals radius, or 0 if the sphere has no known element.
double radius_by_element(const RawSpheres& spheres, std::size_t i) {
  return spheres.attributes.element.empty() ? 0 : van_der_waals_radius(spheres.attributes.element[i]);
}

}  // namespace

std::int64_t count_unknown_radii(const RawSpheres& spheres) {
  std::int64_t unknown = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) unknown += radius_by_element(spheres, i) > 0 ? 0 : 1;
  return unknown;
}

bool lacks_radii(const RawSpheres& spheres) {
  return spheres.r.empty() && count_unknown_radii(spheres) > 0;
}

std::vector<Vec3d> search_origins(const RawSpheres& chunk, std::int64_t first, std::int64_t all) {
  const auto before = static_cast<std::size_t>(first);
  const std::size_t searches = std::min(static_cast<std::size_t>(all), kMostSearches);
  std::vector<Vec3d> origins;
  for (std::size_t k = 0; k < searches; ++k) {
    const auto i = static_cast<std::size_t>(std::uint64_t{k} * static_cast<std::uint64_t>(all) / searches);
    if (i < before || i - before >= chunk.size()) continue;
    origins.push_back({chunk.x[i - before], chunk.y[i - before], chunk.z[i - before]});
  }
  return origins;
}

std::vector<double> nearest_distances(const RawSpheres& chunk, const std::optional<Cell>& cell,
                                      const std::vector<Vec3d>& origins) {
  std::vector<double> distances(origins.size(), std::numeric_limits<double>::infinity());
  if (chunk.size() == 0) return distances;
  std::vector<Vec3d> centres(chunk.size());
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = {chunk.x[i], chunk.y[i], chunk.z[i]};
  const NearestPlace nearest(std::move(centres), Lattice::of(cell));
  const std::size_t bundles = (origins.size() + kSearchesOfABundle - 1) / kSearchesOfABundle;
  parallel_for(0, static_cast<std::int64_t>(bundles), [&](std::int64_t bundle) {
    const std::size_t begin = static_cast<std::size_t>(bundle) * kSearchesOfABundle;
    for (std::size_t k = begin; k < std::min(origins.size(), begin + kSearchesOfABundle); ++k)
      distances[k] = nearest.distance_from(origins[k]);
  });
  return distances;
}

std::optional<double> radius_from_distances(std::vector<double> distances) {
  if (std::isinf(distances.front())) return std::nullopt;  // one has no other place, so none has
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::min(0.5 * *middle, double(std::numeric_limits<float>::max()));  // larger ones are no radii
}

std::optional<double> radius_from_neighbours(const RawSpheres& spheres, const std::optional<Cell>& cell) {
  if (spheres.size() == 0) return std::nullopt;
  return radius_from_distances(
      nearest_distances(spheres, cell, search_origins(spheres, 0, static_cast<std::int64_t>(spheres.size()))));
}

void fill_radii(RawSpheres& spheres, const UnknownRadii& whole) {
  spheres.r.resize(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) spheres.r[i] = radius_by_element(spheres, i);
  if (whole.unknown < whole.all) spheres.rules.push_back("radii: van der Waals, by element");
  if (whole.unknown == 0) return;

  const bool of_first_frame = spheres.unknown_radius.has_value();
  if (!of_first_frame) spheres.unknown_radius = whole.radius;
  const double radius = spheres.unknown_radius.value_or(kRadiusOfOnePlace);
  for (double& r : spheres.r)
    if (!(r > 0)) r = radius;

  const std::string number = readable_number(radius);
  const std::string source =
      !spheres.unknown_radius
          ? "as all centres are at one place"
          : std::string("half the middle distance to the nearest neighbour") + (of_first_frame ? " in frame 0" : "");
  const bool all = whole.unknown == whole.all;
  spheres.assumed_radii = all;
  spheres.rules.push_back("radii: " + number + (all ? ", " : " where neither element nor radius is known, ") + source);
  spheres.warnings.push_back(
      (all ? std::string(kNoRadii) : spheres_have(whole.unknown) + " neither element nor radius; each") +
      " gets radius " + number + ", " + source + "; " + setting_name("radius") + " sets another");
}

}  // namespace bihive
