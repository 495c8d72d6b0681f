#include "bihive/measure/exposed_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/base/check.h"
#include "bihive/measure/direction_angle.h"

namespace bihive::measure {
namespace {

// Bounds of absolute errors, derived in docs/measures.md, "Errors". u = 2^-53.
constexpr double kCapError = 0x1p-48;       // of c and g: 32 u
constexpr double kCrossingError = 0x1p-44;  // of d: 512 u
constexpr double kAccurateError = 0x1p-47;  // of unit vectors from accurate quantities

// Caps whose radius is less than 1/32, or whose ball is more than 4 times as large, get accurate numbers.
constexpr double kSmallSine2 = 0x1p-10;
constexpr double kLargeRatio = 4;
// Below these products of d and the squared sine between the axes, corners do.
constexpr double kSharpInFilter = 0x1p-30, kSharpInResult = 0x1p-20;
// Angles of corners that are nearer to each other are compared exactly.
constexpr double kNear = 0x1p-26;

// For is_surely_covered(): points of a greater error are in doubt.
constexpr double kSure = 0x1p-28;

// Of a corner, computed in binary64: 1 / sine + 1 / (sine root), times 2^-45.
double corner_error(double sine2, double root_of_d) {
  return 0x1p-45 * (1 + root_of_d) / (std::sqrt(sine2) * root_of_d);
}

}  // namespace

ExposedPart ExposedSphere::measure(std::int64_t i, const std::int64_t* neighbours, std::int64_t count) {
  i_ = i;
  cycles_ = 0;
  part_ = {};
  container_ = -1;
  all_covered_ = !find_caps(neighbours, count) || !drop_redundant_caps();
  if (all_covered_) return {};
  uncovered_.clear();
  for (int p = 0; p < static_cast<int>(caps_.size()); ++p) {
    Cap& cap = caps_[p];
    if (cap.redundant) continue;
    const int other = find_crossing(p);
    cap.crosses = other >= 0;
    cap.covered = cap.crosses && is_surely_covered(p, other);
    if (!cap.covered) uncovered_.push_back(p);
  }
  corners_.clear();
  for (const int q : uncovered_)
    for (const int p : uncovered_) {
      if (p == q) break;
      if (const std::optional<Crossing> crossing = crossing_of(p, q)) find_corners(*crossing);
    }
  part_ = sum_up();
  return part_;
}

// False: another ball contains this one.
bool ExposedSphere::find_caps(const std::int64_t* neighbours, std::int64_t count) {
  found_.clear();
  const double radius = balls_.radius[i_];
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t j = neighbours[n];
    if (j == i_) continue;
    const Vec3d a = balls_.between(i_, j);
    const double distance2 = dot(a, a);
    const TwoBalls related = relation(balls_, i_, j, distance2);
    if (related == TwoBalls::first_in_second) {
      container_ = j;
      return false;
    }
    if (related != TwoBalls::cross) continue;
    const double distance = std::sqrt(distance2), other = balls_.radius[j];
    Cap cap{{(1 / distance) * a, 0, 0}, j, false, false, false, false};
    cap.c = (distance2 + (radius - other) * (radius + other)) / (2 * distance * radius);
    const double sine2 = (1 - cap.c) * (1 + cap.c);
    cap.accurate = sine2 < kSmallSine2 || other > kLargeRatio * radius;
    if (cap.accurate) {
      const CapAngle angle = accurate_cap(balls_, i_, j);
      cap.c = angle.cosine;
      cap.s = angle.sine;
    } else {
      cap.s = std::sqrt(sine2);
    }
    found_.push_back(cap);
  }
  // Large caps cover most.
  order_.clear();
  for (const Cap& cap : found_) order_.push_back({cap.c, static_cast<int>(order_.size())});
  std::sort(order_.begin(), order_.end());
  return true;
}

// Keeps the caps that lie in no other one. False: two caps cover the sphere.
bool ExposedSphere::drop_redundant_caps() {
  caps_.clear();
  arrays_.clear(found_.size());
  for (const auto& [c, index] : order_) {
    const Cap& cap = found_[index];
    bool kept = true;
    for (int p = first_unclear(arrays_, 0, cap, kCrossingError); p < arrays_.size() && kept;
         p = first_unclear(arrays_, p + 1, cap, kCrossingError)) {
      Cap& larger = caps_[p];
      if (larger.redundant) continue;
      const auto [g, d] = CirclePair::of(larger, cap);
      if (d >= -kCrossingError && circle_meets(balls_, i_, larger.id, cap.id)) continue;
      // Either circle lies inside the other cap, or outside.
      const double t = g - larger.c * cap.c;
      bool cap_inside, larger_inside;
      const bool clear = d < -kCrossingError && std::abs(t > 0 ? larger.c - cap.c : larger.c + cap.c) > 0x1p-40;
      if (clear && t > 0) {
        cap_inside = larger.c < cap.c;
        larger_inside = !cap_inside;
      } else if (clear) {
        cap_inside = larger_inside = larger.c + cap.c < 0;
      } else {
        cap_inside = circle_in_ball(balls_, i_, cap.id, larger.id);
        larger_inside = circle_in_ball(balls_, i_, larger.id, cap.id);
      }
      if (cap_inside && larger_inside) return false;
      if (cap_inside) kept = false;
      if (!larger_inside) continue;
      larger.redundant = true;
      arrays_.erase(p);
    }
    if (!kept) continue;
    caps_.push_back(cap);
    arrays_.push(cap);
  }
  return true;
}

// Of circles p < q, if they cross.
std::optional<ExposedSphere::Crossing> ExposedSphere::crossing_of(int p, int q) const {
  const auto [g, d] = CirclePair::of(caps_[p], caps_[q]);
  if (d > kCrossingError) return Crossing{p, q, g, d};
  if (d >= -kCrossingError && circle_meets(balls_, i_, caps_[p].id, caps_[q].id)) return Crossing{p, q, g, 0};
  return std::nullopt;
}

// A cap whose circle crosses that of cap p, and covers much of it; -1: none.
int ExposedSphere::find_crossing(int p) {
  const int sure = widest_crossing(arrays_, caps_[p], kCrossingError, crossing_);
  if (sure < arrays_.size()) return sure;
  for (int q = 0; q < arrays_.size(); ++q)
    if (q != p && !caps_[q].redundant && crossing_of(std::min(p, q), std::max(p, q))) return q;
  return -1;
}

ExposedSphere::Points ExposedSphere::points_of(const Cap& p, const Cap& q, double g, double d) const {
  const Vec3d normal = cross(p.axis, q.axis);
  const double sine2 = dot(normal, normal);
  if (!(sine2 * d > kSharpInFilter)) return {{}, {}, std::numeric_limits<double>::infinity()};
  const double inverse = 1 / sine2, root = std::sqrt(d);
  const Vec3d middle = p.c * p.axis + ((q.c - g * p.c) * inverse) * (q.axis - g * p.axis);
  return {middle, (root * inverse) * normal, corner_error(sine2, root)};
}

// Whether other caps cover all of the circle of cap p, after find_crossing(p). Looks for it in binary64, and gives up
// where anything is in doubt: then it is not sure, and exact decisions follow for each corner.
bool ExposedSphere::is_surely_covered(int p, int widest) const {
  const Cap& own = caps_[p];
  if (own.accurate) return false;
  const CirclePair pair = CirclePair::of(own, caps_[widest]);
  if (!(pair.d > kCrossingError)) return false;
  const Points points = points_of(own, caps_[widest], pair.g, pair.d);
  const double doubt = 4 * (points.error + 4 * kCapError);
  if (!(doubt < kSure)) return false;
  // The arc that the widest cap leaves.
  const Vec3d from_centre = points.middle - own.c * own.axis;
  const Vec3d middle = -own.s * normalized(caps_[widest].axis - pair.g * own.axis);
  return surely_cover(crossing_, own, {from_centre + points.offset, middle, from_centre - points.offset}, doubt);
}

// Whether a corner of the circles p and q lies in a third ball.
bool ExposedSphere::is_covered(Vec3d x, double error, int p, int q, int side) const {
  const double doubt = error + 4 * kCapError;
  bool doubtful = false;
  for (int l = first_holding(arrays_, 0, x, x, doubt); l < arrays_.size();
       l = first_holding(arrays_, l + 1, x, x, doubt)) {
    if (l == p || l == q) continue;
    if (dot(x, caps_[l].axis) - caps_[l].c > doubt) return true;
    doubtful = true;
  }
  if (!doubtful) return false;
  for (int l = 0; l < arrays_.size(); ++l) {
    if (l == p || l == q || caps_[l].redundant) continue;
    if (!(std::abs(dot(x, caps_[l].axis) - caps_[l].c) <= doubt)) continue;
    if (point_in_ball(balls_, i_, caps_[p].id, caps_[q].id, side, caps_[l].id)) return true;
  }
  return false;
}

void ExposedSphere::find_corners(const Crossing& crossing) {
  const Cap &p = caps_[crossing.p], &q = caps_[crossing.q];
  const Points points = points_of(p, q, crossing.g, crossing.d);
  const bool accurate = std::isinf(points.error);
  const double sharp = (1 - crossing.g * crossing.g) * crossing.d;
  for (const int side : {1, -1}) {
    Corner corner;
    AccuratePoint point;
    Vec3d x = points.middle + double(side) * points.offset;
    if (accurate) {
      point = accurate_point(balls_, i_, p.id, q.id, side);
      x = p.c * p.axis + p.s * normalized(point.on_j);
    }
    corner.error = accurate ? 40 * kCapError : points.error;
    if (is_covered(x, corner.error, crossing.p, crossing.q, side)) continue;
    if (accurate || sharp < kSharpInResult || p.accurate || q.accurate) {
      if (!accurate) point = accurate_point(balls_, i_, p.id, q.id, side);
      corner.after = normalized(point.on_j);
      corner.before = normalized(point.on_k);
      corner.turn = direction_angle(point.turn_sine, point.turn_cosine);
      corner.error = kAccurateError;
    } else {
      corner.after = (1 / p.s) * (x - p.c * p.axis);
      corner.before = (1 / q.s) * (x - q.c * q.axis);
      corner.turn = direction_angle(std::sqrt(crossing.d), crossing.g - p.c * q.c);
      corner.error /= std::min(p.s, q.s);
    }
    corner.after_on = crossing.p;
    corner.before_on = crossing.q;
    if (side < 0) {
      std::swap(corner.after, corner.before);
      std::swap(corner.after_on, corner.before_on);
    }
    corner.cycle = -1;
    corners_.push_back(corner);
  }
}

// The order of two ends of exposed arcs of one circle that are near each other, counterclockwise. Neither lies in the
// ball of the other.
bool ExposedSphere::comes_before(const End& x, const End& y) const {
  const auto other_cap = [&](const End& end) {
    const Corner& corner = corners_[end.corner];
    return caps_[end.starts ? corner.before_on : corner.after_on].id;
  };
  const std::int64_t j = caps_[x.cap].id, k = other_cap(x), l = other_cap(y);
  const auto covers_little = [&](std::int64_t ball) {
    const CapAngle half = accurate_half_arc(balls_, i_, j, ball);
    return half.cosine > 0 && half.sine < 0x1p-20 * half.cosine;
  };
  const bool little = covers_little(k);
  // An arc that ends before an exposed one starts, with what ball k covers between them.
  if (k == l) return little ? !x.starts : x.starts;
  if (!little) return x.starts;
  if (!covers_little(l)) return !y.starts;
  return is_after_middle(balls_, i_, j, k, l, y.starts ? 1 : -1);
}

// Of one circle, by angle. Sets angles so that they grow from the first end to the last, except for rounding.
void ExposedSphere::order_ends(End* first, End* last) const {
  std::sort(first, last, [](const End& a, const End& b) { return a.angle < b.angle; });
  // Begin after the largest gap, so that ends near each other are neighbours in the list.
  End* begin = first;
  double largest = first->angle + 2 * kPi - (last - 1)->angle;
  bool near = largest < kNear;
  for (End* end = first + 1; end != last; ++end) {
    const double gap = end->angle - (end - 1)->angle;
    near |= gap < kNear;
    if (gap > largest) {
      largest = gap;
      begin = end;
    }
  }
  for (End* end = first; end != begin; ++end) end->angle += 2 * kPi;
  std::rotate(first, begin, last);
  if (!near) return;
  for (End* end = first + 1; end != last; ++end)
    for (End* here = end; here != first; --here) {
      if (here->angle - (here - 1)->angle >= kNear || comes_before(*(here - 1), *here)) break;
      std::swap(*here, *(here - 1));
    }
}

ExposedPart ExposedSphere::sum_up() {
  // Both ends of each exposed arc, circle by circle.
  ends_.clear();
  for (int c = 0; c < static_cast<int>(corners_.size()); ++c) {
    ends_.push_back({corners_[c].after_on, c, true, 0});
    ends_.push_back({corners_[c].before_on, c, false, 0});
  }
  std::sort(ends_.begin(), ends_.end(),
            [](const End& a, const End& b) { return a.cap != b.cap ? a.cap < b.cap : a.corner < b.corner; });
  next_.assign(corners_.size(), -1);
  arc_length_.assign(caps_.size(), 0.0);
  arc_error_.assign(caps_.size(), 0.0);
  arc_ends_.assign(caps_.size(), {});
  whole_circles_.clear();

  // Length and vector of each circle's exposed arcs.
  ExposedPart part;
  double curvature = 0;  // minus the integral of the geodesic curvature
  bool exposed = caps_.empty();
  std::size_t e = 0;
  for (int c = 0; c < static_cast<int>(caps_.size()); ++c) {
    const Cap& cap = caps_[c];
    if (cap.redundant) continue;
    const std::size_t first = e;
    while (e < ends_.size() && ends_[e].cap == c) ++e;
    double length = 0;
    Vec3d from_starts_to_ends;
    double error = 0;
    if (first == e) {
      if (cap.crosses) continue;  // all covered
      length = 2 * kPi;
      whole_circles_.push_back(c);
    } else {
      const Vec3d u = across(cap.axis), v = cross(cap.axis, u);
      for (std::size_t n = first; n < e; ++n) {
        const Corner& corner = corners_[ends_[n].corner];
        const Vec3d from_centre = ends_[n].starts ? corner.after : corner.before;
        ends_[n].angle = direction_angle(dot(from_centre, v), dot(from_centre, u));
        from_starts_to_ends = ends_[n].starts ? from_starts_to_ends - from_centre : from_starts_to_ends + from_centre;
        error += corner.error + 0x1p-49;
      }
      order_ends(ends_.data() + first, ends_.data() + e);
      const std::size_t count = e - first;
      for (std::size_t n = first; n < e; ++n) {
        const End &here = ends_[n], &after = ends_[n + 1 < e ? n + 1 : first];
        BIHIVE_CHECK(here.starts != after.starts);
        if (!here.starts) continue;
        const double own = after.angle - here.angle + (n + 1 < e ? 0 : 2 * kPi);
        length += own;
        corners_[here.corner].length = own;
        next_[here.corner] = after.corner;
      }
      BIHIVE_CHECK(count % 2 == 0);
    }
    exposed = true;
    arc_length_[c] = length;
    arc_error_[c] = error;
    arc_ends_[c] = from_starts_to_ends;
    curvature += cap.c * length;
    const Vec3d moved = cross(cap.axis, from_starts_to_ends);
    part.outwards = part.outwards - (0.5 * cap.s * cap.s * length) * cap.axis - (0.5 * cap.c * cap.s) * moved;
    part.solid_angle_error += std::abs(cap.c) * error + kCapError * length;
    part.outwards_error += cap.s * error + kCapError * length;
  }
  if (!exposed) return {};

  // Turns at the corners, and the cycles of arcs that they link.
  double turns = 0;
  cycles_ = static_cast<int>(whole_circles_.size());
  for (int c = 0; c < static_cast<int>(corners_.size()); ++c) {
    turns += corners_[c].turn;
    part.solid_angle_error += 2 * corners_[c].error + 0x1p-49;
    if (corners_[c].cycle >= 0) continue;
    for (int at = c; corners_[at].cycle < 0; at = next_[at]) corners_[at].cycle = cycles_;
    ++cycles_;
  }

  // The exposed part of m pieces with n cycles has Euler's characteristic 2 m - n: 4 pi m is left open.
  const double known = curvature - turns - 2 * kPi * cycles_;
  known_ = known;
  part.solid_angle = known - 4 * kPi * std::floor(known / (4 * kPi));
  // About nothing or about everything: all caps together are small, or one of them is not.
  constexpr double kDoubt = 0x1p-30;
  if (part.solid_angle > 4 * kPi - kDoubt && !caps_.empty() && caps_[0].c < 1 - kDoubt)
    part.solid_angle = std::max(part.solid_angle - 4 * kPi, 0.0);
  else if (part.solid_angle < kDoubt && (caps_.empty() || caps_[0].c >= 1 - kDoubt))
    part.solid_angle = 4 * kPi;
  return part;
}

}  // namespace bihive::measure
