// The connected pieces of the exposed part of a sphere, for the surfaces that they form with those of other spheres.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bihive/math/elementary.h"
#include "bihive/measure/direction_angle.h"
#include "bihive/measure/exposed_sphere.h"

namespace bihive::measure {
namespace {

constexpr double kDegrees = 180 / kPi;  // of a radian

}  // namespace

bool ExposedSphere::append_pieces(std::vector<ExposedPiece>& pieces, std::vector<Junction>& junctions,
                                  PieceArcs* arcs) const {
  if (part_.solid_angle == 0 && cycles_ == 0) return true;
  const auto first = static_cast<std::int64_t>(pieces.size());
  if (cycles_ == 0) {
    pieces.push_back({part_.solid_angle, part_.outwards});
    return true;
  }
  const int count = std::max(1, static_cast<int>(std::lround((part_.solid_angle - known_) / (4 * kPi))));
  const std::vector<int> piece_of_cycle = pieces_of_cycles(count);
  // Each piece is a sphere with holes: its solid angle by Gauss and Bonnet, as that of the whole.
  const int made = 1 + *std::max_element(piece_of_cycle.begin(), piece_of_cycle.end());
  pieces.resize(pieces.size() + static_cast<std::size_t>(made));
  if (arcs != nullptr && made > 1) append_arcs(piece_of_cycle, *arcs);
  for (int p = 0; p < made; ++p) pieces[first + p].solid_angle = 4 * kPi;
  for (const int piece : piece_of_cycle) pieces[first + piece].solid_angle -= 2 * kPi;
  const auto add_arc = [&](int piece, const Cap& cap, double length, Vec3d from_start_to_end) {
    ExposedPiece& to = pieces[first + piece];
    to.solid_angle += cap.c * length;
    to.outwards = to.outwards - (0.5 * cap.s * cap.s * length) * cap.axis -
                  (0.5 * cap.c * cap.s) * cross(cap.axis, from_start_to_end);
  };
  for (std::size_t n = 0; n < whole_circles_.size(); ++n) {
    const Cap& cap = caps_[whole_circles_[n]];
    const int piece = piece_of_cycle[n];
    add_arc(piece, cap, 2 * kPi, {});
    const bool in_order = balls_.comes_before(i_, cap.id);
    junctions.push_back({in_order ? i_ : cap.id, in_order ? cap.id : i_, -1, 0, {}, first + piece});
  }
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    const Corner& corner = corners_[n];
    const int piece = piece_of_cycle[corner.cycle];
    add_arc(piece, caps_[corner.after_on], corner.length, corners_[next_[n]].before - corner.after);
    pieces[first + piece].solid_angle -= corner.turn;
    // Sort the three spheres; each exchange changes the side.
    Junction junction{i_, caps_[corner.after_on].id, caps_[corner.before_on].id, 1, {}, first + piece};
    const auto exchange = [&](std::int64_t& a, std::int64_t& b) {
      if (balls_.comes_before(a, b)) return;
      std::swap(a, b);
      junction.side = static_cast<std::int16_t>(-junction.side);
    };
    exchange(junction.i, junction.j);
    exchange(junction.j, junction.k);
    exchange(junction.i, junction.j);
    junctions.push_back(junction);
  }
  return made == count;
}

void ExposedSphere::append_arcs(const std::vector<int>& piece_of_cycle, PieceArcs& arcs) const {
  for (std::size_t n = 0; n < whole_circles_.size(); ++n) {
    const Cap& cap = caps_[whole_circles_[n]];
    arcs.arcs.push_back({cap.axis, cap.c, cap.s, across(cap.axis), 2 * kPi, piece_of_cycle[n]});
  }
  for (const Corner& corner : corners_) {
    const Cap& cap = caps_[corner.after_on];
    arcs.arcs.push_back({cap.axis, cap.c, cap.s, corner.after, corner.length, piece_of_cycle[corner.cycle]});
  }
}

// The piece of each cycle, from 0 on, where the part has this many pieces.
std::vector<int> ExposedSphere::pieces_of_cycles(int pieces) const {
  std::vector<int> piece(static_cast<std::size_t>(cycles_), 0);
  if (pieces == 1) return piece;
  UnionFind<int> groups(cycles_);
  // A path between two cycles of a piece that leaves it comes back through the cycle by which it left: so where it is
  // exposed, it joins cycles of one piece, and in the end the two. Try arc after arc of each cycle.
  std::vector<std::vector<Vec3d>> points(piece.size());
  const auto middle_of = [&](const Cap& cap, Vec3d from_centre, double length) {
    const Vec3d up = cross(cap.axis, from_centre);
    const SineCosine turn = sine_cosine_deg(0.5 * kDegrees * length);
    return cap.c * cap.axis + cap.s * (turn.cosine * from_centre + turn.sine * up);
  };
  for (std::size_t n = 0; n < whole_circles_.size(); ++n) {
    const Cap& cap = caps_[whole_circles_[n]];
    const Vec3d u = normalized(cross(cap.axis, std::abs(cap.axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    for (const double angle : {0.3, 2.2, 4.4}) points[n].push_back(middle_of(cap, u, angle));
  }
  for (const Corner& corner : corners_)
    points[corner.cycle].push_back(middle_of(caps_[corner.after_on], corner.after, corner.length));
  for (int a = 0; a < cycles_; ++a)
    for (int b = a + 1; b < cycles_; ++b)
      for (const Vec3d from : points[a])
        for (const Vec3d to : points[b]) {
          if (groups.groups() <= pieces || groups.group_of(a) == groups.group_of(b)) continue;
          join_along(from, a, to, b, groups);
        }
  // Number the groups.
  std::vector<int> number(piece.size(), -1);
  int next = 0;
  for (int a = 0; a < cycles_; ++a) {
    int& own = number[groups.group_of(a)];
    if (own < 0) own = next++;
    piece[a] = own;
  }
  return piece;
}

// Joins the cycles at both ends of each exposed section of a path along a great circle.
void ExposedSphere::join_along(Vec3d from, int from_cycle, Vec3d to, int to_cycle, UnionFind<int>& groups) const {
  const Vec3d normal = cross(from, to);
  if (dot(normal, normal) < 0x1p-20) return;
  const Vec3d pole = normalized(normal), up = cross(pole, from);
  const double whole = direction_angle(dot(to, up), dot(to, from));
  std::vector<std::pair<double, int>> met{{0, from_cycle}, {whole, to_cycle}};
  const auto cross_circle = [&](const Cap& cap, const auto& cycle_at) {
    // On the great circle: x . axis = c is A cos(angle) + B sin(angle) = c.
    const double A = dot(cap.axis, from), B = dot(cap.axis, up), r = std::sqrt(A * A + B * B);
    if (!(std::abs(cap.c) < r)) return;
    const double at = direction_angle(B, A), half = direction_angle(std::sqrt(r * r - cap.c * cap.c), cap.c);
    for (const double angle : {at - half, at + half, at - half + 2 * kPi, at + half + 2 * kPi}) {
      if (!(angle > 0 && angle < whole)) continue;
      const SineCosine turn = sine_cosine_deg(kDegrees * angle);
      const int cycle = cycle_at(turn.cosine * from + turn.sine * up);
      if (cycle >= 0) met.push_back({angle, cycle});
    }
  };
  for (std::size_t n = 0; n < whole_circles_.size(); ++n)
    cross_circle(caps_[whole_circles_[n]], [&](Vec3d) { return static_cast<int>(n); });
  for (const Corner& corner : corners_) {
    const Cap& cap = caps_[corner.after_on];
    cross_circle(cap, [&](Vec3d x) {
      const Vec3d along = x - cap.c * cap.axis;
      double angle = direction_angle(dot(along, cross(cap.axis, corner.after)), dot(along, corner.after));
      if (angle < 0) angle += 2 * kPi;
      return angle < corner.length ? corner.cycle : -1;
    });
  }
  std::sort(met.begin(), met.end());
  for (std::size_t n = 1; n < met.size(); ++n) {
    const SineCosine turn = sine_cosine_deg(0.5 * kDegrees * (met[n - 1].first + met[n].first));
    const Vec3d x = turn.cosine * from + turn.sine * up;
    const bool covered =
        std::any_of(caps_.begin(), caps_.end(), [&](const Cap& cap) { return dot(x, cap.axis) > cap.c + 0x1p-40; });
    if (!covered && met[n].first - met[n - 1].first > 0x1p-30) groups.join(met[n - 1].second, met[n].second);
  }
}

}  // namespace bihive::measure
