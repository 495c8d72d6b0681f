// The part of one sphere that lies in no other ball: its area, and what volumes need of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bihive/measure/balls.h"
#include "bihive/measure/cap_lanes.h"
#include "bihive/measure/decisions.h"
#include "bihive/measure/piece_arcs.h"
#include "bihive/measure/union_find.h"

namespace bihive::measure {

/// A unit vector across another one.
inline Vec3d across(Vec3d axis) {
  const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
  const Vec3d along = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  return normalized(cross(axis, along));
}

/// Of a unit sphere: the exposed part of sphere i, seen from its centre.
struct ExposedPart {
  double solid_angle = 0;                            ///< from 0 to 4 pi
  Vec3d outwards;                                    ///< the integral of the outward normal over the part
  double solid_angle_error = 0, outwards_error = 0;  ///< bounds
};

/// Of a unit sphere: where its ball's part of the union ends at another ball. It lies in the plane of their circle, and
/// is what other such planes leave of the disc in it.
struct Facet {
  std::int64_t ball;
  double area;
  double distance;    ///< of the plane from the centre; below 0: the centre is beyond it
  double area_error;  ///< a bound
};

/// How the area of the exposed part of sphere i grows with ball `ball`, i itself or another one. In the units of the
/// balls.
struct AreaChange {
  std::int64_t ball;
  Vec3d by_centre;
  double by_radius;
};

/// A connected piece of the exposed part.
struct ExposedPiece {
  double solid_angle = 0;
  Vec3d outwards;
};

/// Says that a piece goes on beyond the sphere: through a point of spheres i < j < k, or with k -1 through the whole
/// circle of i < j. The pieces of two or three spheres have the same junction.
///
/// In a periodic set, i is a ball of the cell, and the piece lies on the image of its ball by `lift`.
struct Junction {
  std::int64_t i, j, k;
  std::int16_t side;
  std::array<std::int16_t, 3> lift;
  std::int64_t piece;

  friend bool operator==(const Junction&, const Junction&) = default;
  friend bool operator<(const Junction& a, const Junction& b) {
    return std::tie(a.i, a.j, a.k, a.side, a.lift, a.piece) < std::tie(b.i, b.j, b.k, b.side, b.lift, b.piece);
  }
};

/// Computes one sphere after the other in memory that it keeps. One thread at a time.
///
/// Every other ball cuts a cap off the sphere. What is exposed is bounded by arcs of the caps' circles, between points
/// where two circles cross and which lie in no third ball. By Gauss and Bonnet its area is that of its boundary's turns
/// and curvature up to a multiple of 4 pi, which leaves no choice: docs/measures.md has the formulae and the bounds.
class ExposedSphere {
 public:
  explicit ExposedSphere(const Balls& balls) : balls_(balls) {}

  /// `neighbours`: every ball that shares a point with ball i, others too, in ascending order; i itself may be among
  /// them.
  ExposedPart measure(std::int64_t i, const std::int64_t* neighbours, std::int64_t count);

  /// Appends the facets of the ball that measure() took last, those with an area above 0. The ball's part of the union,
  /// all points that are not deeper in another ball (by the power distance), is the exposed part's sector and the
  /// facets' cones.
  void append_facets(std::vector<Facet>& facets);

  /// Appends the changes of the exposed area with sphere i and those whose circles have exposed arcs.
  void append_area_changes(std::vector<AreaChange>& changes) const;

  /// Appends the balls that cross the one that measure() took last; if another one contains it, that one alone.
  void append_neighbours(std::vector<std::int64_t>& neighbours) const;

  /// Appends the pieces of the part that measure() returned last, and their junctions. False: in binary64 it could not
  /// be told which cycles of arcs bound one piece together, so that there are more pieces than the solid angle tells.
  /// `arcs`, if given, gets the arcs of all pieces, which it numbers from 0 on, if there are several.
  bool append_pieces(std::vector<ExposedPiece>& pieces, std::vector<Junction>& junctions,
                     PieceArcs* arcs = nullptr) const;

 private:
  // The cap that ball `id` cuts off the sphere.
  struct Cap : CapNumbers {
    std::int64_t id;
    bool accurate;   // of small relative error
    bool redundant;  // it lies in another cap
    bool crosses;    // its circle another one
    bool covered;    // surely, all of its circle by other caps
  };
  // Circles p < q of two caps cross.
  struct Crossing {
    int p, q;
    double g, d;  // cosine between the axes; what is above 0 where circles cross. d 0: not known well
  };
  // The two points where circles cross: middle + side * offset.
  struct Points {
    Vec3d middle, offset;
    double error;  // infinite: not known well
  };
  // A point of the boundary, on the circles of two caps. On the first the arc after it is exposed, and before it is
  // covered by the second; on the second it is the other way round.
  struct Corner {
    int after_on, before_on;  // it is on side 1 of spheres i, after_on, before_on
    Vec3d after, before;      // unit vectors from the circles' centres
    double turn;              // angle between the circles' outward normals
    double error;             // of the point
    int cycle;                // of the arcs that start and end in it
    double length;            // of the arc that starts in it, as an angle
  };
  // A corner as seen on one circle.
  struct End {
    int cap, corner;
    bool starts;  // an exposed arc
    double angle;
  };

  const Balls& balls_;
  std::int64_t i_ = 0;
  std::vector<Cap> caps_, found_;
  std::vector<std::pair<double, int>> order_;  // of found_, by c
  CapArrays arrays_;                           // of caps_; redundant ones have no points
  CapArrays crossing_;                         // those whose circles surely cross the circle at hand
  std::vector<int> uncovered_;                 // of caps_
  std::vector<Crossing> crossings_;            // for facets alone
  std::vector<Corner> corners_;
  std::vector<End> ends_;
  std::vector<int> next_;           // of each corner: the corner at the end of the arc that starts there
  std::vector<int> whole_circles_;  // exposed ones, each the cycle of its number; those of corners follow
  int cycles_ = 0;
  ExposedPart part_;
  double known_ = 0;                            // of its solid angle, up to a multiple of 4 pi
  std::vector<double> arc_length_, arc_error_;  // of each cap's circle: exposed, as an angle
  std::vector<Vec3d> arc_ends_;                 // the sum of the arcs' ends less that of their starts, from the centre
  std::int64_t container_ = -1;                 // a ball that contains this one
  bool all_covered_ = false;                    // by one or two balls
  // What another plane leaves of a disc of radius 1: all x with x . normal <= distance.
  struct Line {
    double x, y;  // normal
    double distance, half_chord;
    double error;  // of its position
  };
  // A line with the section of it that other lines leave, counterclockwise about its normal.
  struct Side {
    Line line;
    double from, to;
    bool from_circle, to_circle;  // whether an end lies on the circle
  };
  std::vector<Side> sides_;
  std::vector<std::pair<double, int>> nearest_;  // of one circle: a line's distance, roughly, and its crossing
  std::vector<double> inverse_sine_;             // of each crossing, between the axes; 0: not known well
  // Of cap c: indices of crossings_ at first_crossing_[c] to before first_crossing_[c + 1] of crossings_of_.
  std::vector<int> first_crossing_, crossings_of_, next_of_cap_;

  Points points_of(const Cap& p, const Cap& q, double g, double d) const;
  bool find_caps(const std::int64_t* neighbours, std::int64_t count);
  bool drop_redundant_caps();
  std::optional<Crossing> crossing_of(int p, int q) const;
  int find_crossing(int p);
  bool is_surely_covered(int p, int widest) const;
  void find_corners(const Crossing& crossing);
  bool is_covered(Vec3d x, double error, int p, int q, int side) const;
  bool comes_before(const End& x, const End& y) const;
  void order_ends(End* first, End* last) const;
  ExposedPart sum_up();
  Line line_of(const Cap& own, const Cap& other, const Crossing& crossing, Vec3d u, Vec3d v) const;
  void add_side(const Line& line);
  double radius_of_sides() const;
  std::vector<int> pieces_of_cycles(int pieces) const;
  void append_arcs(const std::vector<int>& piece_of_cycle, PieceArcs& arcs) const;
  void join_along(Vec3d from, int from_cycle, Vec3d to, int to_cycle, UnionFind<int>& groups) const;
};

}  // namespace bihive::measure
