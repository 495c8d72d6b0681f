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
#include "bihive/io/assemble/nearest_place.h"
#include "bihive/io/elements.h"

namespace bihive {
namespace {

// Where there are no two places to take a distance from.
constexpr double kRadiusOfOnePlace = 0.5;

// More distances would move their middle by little, and each search costs a microsecond.
constexpr std::size_t kMostSearches = 65536;
// A thread does so many without a pause.
constexpr std::size_t kSearchesOfABundle = 1024;

// The van der Waals radius, or 0 if the sphere has no known element.
double radius_by_element(const RawSpheres& spheres, std::size_t i) {
  return spheres.attributes.element.empty() ? 0 : van_der_waals_radius(spheres.attributes.element[i]);
}

// The centres from which neighbours are searched, evenly by id among all parts.
std::vector<Vec3d> searched(const RawSpheres& spheres, const CountOfParts& all, std::size_t searches,
                            const SetParts* parts) {
  const auto first = static_cast<std::size_t>(all.before);
  std::vector<double> own;
  for (std::size_t k = 0; k < searches; ++k) {
    const auto i = static_cast<std::size_t>(std::uint64_t{k} * static_cast<std::uint64_t>(all.all) / searches);
    if (i < first || i - first >= spheres.size()) continue;
    own.insert(own.end(), {spheres.x[i - first], spheres.y[i - first], spheres.z[i - first]});
  }
  std::vector<Vec3d> centres;
  for (const std::vector<double>& one : parts != nullptr ? parts->gather(own) : std::vector<std::vector<double>>{own})
    for (std::size_t k = 0; k < one.size(); k += 3) centres.push_back({one[k], one[k + 1], one[k + 2]});
  return centres;
}

}  // namespace

bool lacks_radii(const RawSpheres& spheres) {
  if (!spheres.r.empty()) return false;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    if (!(radius_by_element(spheres, i) > 0)) return true;
  return false;
}

std::optional<double> radius_from_neighbours(const RawSpheres& spheres, const SetParts* parts) {
  const CountOfParts all = count_of_all(parts, static_cast<std::int64_t>(spheres.size()));
  const auto count = static_cast<std::size_t>(all.all);
  if (count == 0) return std::nullopt;
  const auto centre = [&](std::size_t i) { return Vec3d{spheres.x[i], spheres.y[i], spheres.z[i]}; };
  std::optional<NearestPlace> nearest;
  if (spheres.size() > 0) {
    std::vector<Vec3d> centres(spheres.size());
    for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = centre(i);
    nearest.emplace(std::move(centres));
  }

  const std::size_t searches = std::min(count, kMostSearches);
  const std::vector<Vec3d> from = searched(spheres, all, searches, parts);
  std::vector<double> distances(searches, std::numeric_limits<double>::infinity());
  const std::size_t bundles = (searches + kSearchesOfABundle - 1) / kSearchesOfABundle;
  parallel_for(0, static_cast<std::int64_t>(bundles), [&](std::int64_t bundle) {
    const std::size_t begin = static_cast<std::size_t>(bundle) * kSearchesOfABundle;
    for (std::size_t k = begin; nearest && k < std::min(searches, begin + kSearchesOfABundle); ++k)
      distances[k] = nearest->distance_from(from[k]);
  });
  if (parts != nullptr) {
    // The nearest of all parts.
    for (double& distance : distances) distance = -distance;
    greatest_of_all(parts, distances);
    for (double& distance : distances) distance = -distance;
  }
  if (std::isinf(distances.front())) return std::nullopt;  // one has no other place, so none has
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((searches - 1) / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::min(0.5 * *middle, double(std::numeric_limits<float>::max()));  // larger ones are no radii
}

void fill_radii(RawSpheres& spheres, const SetParts* parts) {
  const std::size_t count = spheres.size();
  std::size_t unknown = 0;
  spheres.r.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    spheres.r[i] = radius_by_element(spheres, i);
    unknown += spheres.r[i] > 0 ? 0 : 1;
  }
  if (unknown < count) spheres.rules.push_back("radii: van der Waals, by element");
  if (unknown == 0 && parts == nullptr) return;

  const bool of_first_frame = spheres.unknown_radius.has_value();
  if (!of_first_frame) spheres.unknown_radius = radius_from_neighbours(spheres, parts);
  const double radius = spheres.unknown_radius.value_or(kRadiusOfOnePlace);
  for (double& r : spheres.r)
    if (!(r > 0)) r = radius;

  const std::string number = readable_number(radius);
  const std::string source =
      !spheres.unknown_radius
          ? "as all centres are at one place"
          : std::string("half the middle distance to the nearest neighbour") + (of_first_frame ? " in frame 0" : "");
  const bool all = unknown == count;
  spheres.rules.push_back("radii: " + number + (all ? ", " : " where neither element nor radius is known, ") + source);
  spheres.warnings.push_back(
      (all ? "no radii; each sphere" : spheres_have(std::int64_t(unknown)) + " neither element nor radius; each") +
      " gets radius " + number + ", " + source + "; --radius R sets another");
}

}  // namespace bihive
