// The facets of a ball's part of the union: planes of circles, cut by each other.
#include <algorithm>
#include <cmath>
#include <functional>

#include "bihive/measure/exposed_sphere.h"

namespace bihive::measure {
namespace {

// Below this product of a crossing's d and the squared sine between the axes, its numbers come from exact ones.
constexpr double kSharp = 0x1p-20;
// For the order of lines: crossings below this squared sine have no rough distance; the others' is right up to kRough.
constexpr double kRoughSine2 = 0x1p-24, kRough = 0x1p-20;
// Bounds, derived in docs/measures.md, "Errors": of a line's position over the sine between the axes, the same from
// exact numbers, and what each facet adds.
constexpr double kLineError = 0x1p-45, kAccurateLineError = 0x1p-46, kFacetError = 0x1p-47;

}  // namespace

void ExposedSphere::append_neighbours(std::vector<std::int64_t>& neighbours) const {
  if (container_ >= 0) {
    neighbours.push_back(container_);
    return;
  }
  for (const Cap& cap : found_) neighbours.push_back(cap.id);
}

// The boundary moves where a circle does, and only that changes the solid angle: by L dc - (s E) . da, with E the
// integral of the unit vectors from the circle's centre over its arcs (docs/measures.md, "Derivatives").
void ExposedSphere::append_area_changes(std::vector<AreaChange>& changes) const {
  const double r = balls_.radius[i_];
  AreaChange own{i_, {}, 2 * r * part_.solid_angle};
  for (std::size_t c = 0; c < caps_.size() && !all_covered_; ++c) {
    const Cap& cap = caps_[c];
    const double length = arc_length_[c];
    if (length == 0) continue;
    const double d2 = dot(balls_.between(i_, cap.id), balls_.between(i_, cap.id)), d = std::sqrt(d2);
    const double other = balls_.radius[cap.id];
    const Vec3d integral = -cross(cap.axis, arc_ends_[c]);
    const double c_by_distance = (d2 + (other - r) * (other + r)) / (2 * d2 * r);
    const Vec3d by_centre = (r * r) * ((length * c_by_distance) * cap.axis - (cap.s / d) * integral);
    changes.push_back({cap.id, by_centre, -r * other * length / d});
    own.by_centre = own.by_centre - by_centre;
    own.by_radius += r * r * length * (1 / d - cap.c / r);
  }
  changes.push_back(own);
}

// In the plane of the circle of `own`, with its radius as the unit, and u and v as axes.
ExposedSphere::Line ExposedSphere::line_of(const Cap& own, const Cap& other, const Crossing& crossing, Vec3d u,
                                           Vec3d v) const {
  Line line;
  const Vec3d towards = other.axis - crossing.g * own.axis;
  const double sine2 = dot(towards, towards);
  if (own.accurate || other.accurate || !(sine2 * crossing.d > kSharp)) {
    const Vec3d normal = accurate_towards(balls_, i_, own.id, other.id);
    const CapAngle half = accurate_half_arc(balls_, i_, own.id, other.id);
    const double scale = 1 / std::sqrt(half.cosine * half.cosine + half.sine * half.sine);
    line = {dot(normal, u), dot(normal, v), scale * half.cosine, scale * half.sine, kAccurateLineError};
  } else {
    const double sine = std::sqrt(sine2), distance = (other.c - crossing.g * own.c) / (sine * own.s);
    line = {dot(towards, u) / sine, dot(towards, v) / sine, distance,
            std::sqrt(std::max((1 - distance) * (1 + distance), 0.0)), kLineError / (sine * own.s)};
  }
  return line;
}

// Cuts the sides by a line and adds it. Two lines cut each other at points that come from the same numbers: so the
// region's sides fit together however nearly they are parallel. Lines of which nothing is left go on cutting others.
void ExposedSphere::add_side(const Line& line) {
  Side added{line, -line.half_chord, line.half_chord, true, true};
  const auto cut = [](Side& side, double sine, double at) {
    if (sine > 0 && at < side.to) {
      side.to = at;
      side.to_circle = false;
    } else if (sine < 0 && at > side.from) {
      side.from = at;
      side.from_circle = false;
    }
  };
  for (Side& side : sides_) {
    const Line& own = side.line;
    const double sine = own.x * line.y - own.y * line.x, cosine = own.x * line.x + own.y * line.y;
    if (sine == 0) {
      // Parallel: the nearer one remains, of equal ones the first. Of opposite ones both or none.
      if (cosine > 0 ? line.distance >= own.distance : line.distance < -own.distance) added.to = added.from;
      if (cosine > 0 ? line.distance < own.distance : line.distance < -own.distance) side.to = side.from;
      continue;
    }
    // (other - own cosine) / sine, without the cancellation.
    double of_side, of_added;
    if (cosine > 0) {
      const double shared = (line.distance - own.distance) / sine, turn = sine / (1 + cosine);
      of_side = shared + own.distance * turn;
      of_added = shared - line.distance * turn;
    } else {
      const double shared = (line.distance + own.distance) / sine, turn = sine / (1 - cosine);
      of_side = shared - own.distance * turn;
      of_added = line.distance * turn - shared;
    }
    cut(side, sine, of_side);
    cut(added, -sine, of_added);
  }
  sides_.push_back(added);
}

// The distance of the farthest end of a side, beyond which no line cuts; 1 if there may be arcs, 0 if no side is left.
double ExposedSphere::radius_of_sides() const {
  double radius2 = 0;
  for (const Side& side : sides_) {
    if (!(side.from < side.to)) continue;
    if (side.from_circle || side.to_circle) return 1;
    const double end2 = std::max(side.from * side.from, side.to * side.to);
    radius2 = std::max(radius2, side.line.distance * side.line.distance + end2);
  }
  return std::sqrt(radius2);
}

void ExposedSphere::append_facets(std::vector<Facet>& facets) {
  if (all_covered_) return;
  crossings_.clear();
  for (int q = 0; q < static_cast<int>(caps_.size()); ++q)
    for (int p = 0; p < q && !caps_[q].redundant; ++p) {
      if (caps_[p].redundant) continue;
      if (const std::optional<Crossing> crossing = crossing_of(p, q)) crossings_.push_back(*crossing);
    }
  // The crossings of each cap.
  first_crossing_.assign(caps_.size() + 1, 0);
  for (const Crossing& crossing : crossings_) {
    ++first_crossing_[crossing.p + 1];
    ++first_crossing_[crossing.q + 1];
  }
  for (std::size_t c = 0; c < caps_.size(); ++c) first_crossing_[c + 1] += first_crossing_[c];
  crossings_of_.resize(static_cast<std::size_t>(first_crossing_.back()));
  std::vector<int>& next = next_of_cap_;
  next.assign(first_crossing_.begin(), first_crossing_.end() - 1);
  for (int n = 0; n < static_cast<int>(crossings_.size()); ++n) {
    crossings_of_[next[crossings_[n].p]++] = n;
    crossings_of_[next[crossings_[n].q]++] = n;
  }

  // The distance of the lines, roughly, tells which of them cut most.
  inverse_sine_.resize(crossings_.size());
  for (std::size_t n = 0; n < crossings_.size(); ++n) {
    const Crossing& crossing = crossings_[n];
    const double sine2 = (1 - crossing.g) * (1 + crossing.g);
    const bool is_known = sine2 > kRoughSine2 && !caps_[crossing.p].accurate && !caps_[crossing.q].accurate;
    inverse_sine_[n] = is_known ? 1 / std::sqrt(sine2) : 0;
  }

  for (int c = 0; c < static_cast<int>(caps_.size()); ++c) {
    const Cap& cap = caps_[c];
    if (cap.redundant) continue;
    nearest_.clear();
    const double inverse_s = 1 / cap.s;
    for (int n = first_crossing_[c]; n < first_crossing_[c + 1]; ++n) {
      const int index = crossings_of_[n];
      const Crossing& crossing = crossings_[index];
      const Cap& other = caps_[crossing.p == c ? crossing.q : crossing.p];
      const double distance = (other.c - crossing.g * cap.c) * inverse_sine_[index] * inverse_s;
      nearest_.push_back({inverse_sine_[index] == 0 ? -2 : distance, index});
    }
    std::make_heap(nearest_.begin(), nearest_.end(), std::greater<>());

    // The nearest lines first, until none can cut what is left.
    const Vec3d u = across(cap.axis), v = cross(cap.axis, u);
    sides_.clear();
    double radius = 1;
    for (auto end = nearest_.end(); end != nearest_.begin() && nearest_.front().first < radius + kRough; --end) {
      const Crossing& crossing = crossings_[nearest_.front().second];
      std::pop_heap(nearest_.begin(), end, std::greater<>());
      add_side(line_of(cap, caps_[crossing.p == c ? crossing.q : crossing.p], crossing, u, v));
      radius = radius_of_sides();
      if (radius == 0 && arc_length_[c] == 0) break;
      if (arc_length_[c] > 0) radius = 1;
    }

    // The area of a region of arcs about the origin and sides is half the sum of distance times length.
    double sum = arc_length_[c], error = arc_error_[c];
    for (const Side& side : sides_) {
      const double length = std::max(side.to - side.from, 0.0);
      sum += side.line.distance * length;
      error += 2 * side.line.error * length;
    }
    const double s2 = 0.5 * cap.s * cap.s;
    if (sum > 0) facets.push_back({cap.id, s2 * sum, cap.c, s2 * error + 2 * s2 * kFacetError});
  }
}

}  // namespace bihive::measure
