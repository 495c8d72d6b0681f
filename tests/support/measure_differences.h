// What differs between the measures of measure/ and those in 384 bits.
#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bihive/measure/exposed_sphere.h"
#include "bihive/measure/surfaces.h"
#include "support/measure_reference.h"

namespace bihive::test {

/// The exposed part of each ball, and the surfaces of their union, without the search for neighbours.
struct SmallUnion {
  std::vector<measure::ExposedPart> parts;
  std::int64_t undecided_spheres = 0, components = 0, cavities = 0;
};
inline SmallUnion small_union(const measure::Balls& balls) {
  SmallUnion made;
  std::vector<std::int64_t> all(static_cast<std::size_t>(balls.size()));
  std::iota(all.begin(), all.end(), std::int64_t{0});
  measure::ExposedSphere sphere(balls);
  measure::Pieces pieces;
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    made.parts.push_back(sphere.measure(i, all.data(), balls.size()));
    made.undecided_spheres += sphere.append_pieces(pieces.pieces, pieces.junctions) ? 0 : 1;
    pieces.owner.resize(pieces.pieces.size(), i);
  }
  for (const measure::Surface& surface : measure::surfaces_of(balls, std::nullopt, {std::move(pieces)}))
    ++(surface.encloses_balls ? made.components : made.cavities);
  return made;
}

/// All that is not within the bound that comes with it, or not the same; empty: nothing. Connected parts and cavities
/// count if `with_holes`, and if all pieces could be told apart.
inline std::string measure_differences(const measure::Balls& balls, bool with_holes) {
  const SmallUnion own = small_union(balls);
  const ReferenceMeasures reference = reference_measures(balls);
  std::ostringstream text;
  const auto compare = [&](const std::string& what, double number, const reference::Real& right, double bound) {
    const double difference = std::abs(static_cast<double>(right - number));
    if (!(difference <= bound)) text << what << ": " << difference << " more than " << bound << "; ";
  };
  // What the amounts of the reference change, and the rounding of the last sum.
  constexpr double kLimit = 0x1p-50;
  double area = 0, volume = 0, area_error = 0, volume_error = 0;
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    const measure::ExposedPart& part = own.parts[static_cast<std::size_t>(i)];
    const reference::Part& right = reference.parts[static_cast<std::size_t>(i)];
    const std::string name = "ball " + std::to_string(i);
    compare(name + " solid angle", part.solid_angle, right.solid_angle, part.solid_angle_error + 16 * kLimit);
    const double outwards_error = part.outwards_error + 16 * kLimit;
    compare(name + " outwards x", part.outwards.x, right.outwards.x, outwards_error);
    compare(name + " outwards y", part.outwards.y, right.outwards.y, outwards_error);
    compare(name + " outwards z", part.outwards.z, right.outwards.z, outwards_error);
    const double r = balls.radius[i];
    area += r * r * part.solid_angle;
    volume += r * r * (r * part.solid_angle + dot(balls.centre[i], part.outwards)) / 3;
    area_error += r * r * (part.solid_angle_error + 16 * kLimit);
    volume_error +=
        r * r * (r + length(balls.centre[i])) * (part.solid_angle_error + part.outwards_error + 16 * kLimit);
  }
  compare("area", area, reference.area, area_error);
  compare("volume", volume, reference.volume, volume_error);
  if (with_holes && own.undecided_spheres == 0) {
    const reference::Holes holes = reference_holes(balls);
    if (own.components != holes.components || own.cavities != holes.cavities)
      text << own.components << " parts and " << own.cavities << " cavities for " << holes.components << " and "
           << holes.cavities << "; ";
  }
  return text.str();
}

/// The balls as text, exactly.
inline std::string text_of_balls(const measure::Balls& balls) {
  std::ostringstream text;
  text.precision(17);
  for (std::int64_t i = 0; i < balls.size(); ++i)
    text << balls.centre[i].x << "," << balls.centre[i].y << "," << balls.centre[i].z << "," << balls.radius[i] << "\n";
  return text.str();
}

}  // namespace bihive::test
