// The distance from a place to the nearest other one, exact in binary64. Places may repeat along a cell.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/geometry/lattice.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// A tree of boxes above points. Every inner node parts its points at a median, so neither clusters nor points far away
/// make it deep. Equal points share one leaf; any number of them makes a search no longer.
class NearestPlace {
 public:
  /// The points must be finite, below 1e39 in size, and at least one. With a lattice their images are places too, and
  /// the points are moved into the cell at the origin first.
  explicit NearestPlace(std::vector<Vec3d> points, const std::optional<Lattice>& lattice = std::nullopt);

  /// The distance to the nearest of the points that differs from `from`; infinity if none does. It is the smallest of
  /// all distances length(point - from), bit for bit, but where their squares would underflow it is exact as well. Of
  /// a lattice, `from` is one of the places, also where it is not among the points; and what lies nearer to it than a
  /// millionth of the cell is at its own place, such as a point on the far border of the cell. Where more than 4,096
  /// images could be nearest, the distance is that to the nearest point in the cell, at most the shortest vector.
  double distance_from(Vec3d from) const;

 private:
  struct Box {
    Vec3d lo, hi;
  };
  // The left child of an inner node is the next node.
  struct Node {
    Box box;
    std::size_t right;       // the right child of an inner node; 0 in a leaf
    std::size_t first, end;  // the points of a leaf
  };
  struct Search;
  struct Range;

  void build(Range& range, TaskList& tasks);
  void append(Range& range);
  Box box_of(std::size_t first, std::size_t end) const;
  void build_into(std::vector<Node>& nodes, std::size_t first, std::size_t end);
  std::size_t part(std::size_t first, std::size_t end, int axis);
  void visit(std::size_t node, Search& search) const;

  std::optional<Lattice> lattice_;
  Vec3d lowest_share_, highest_share_;
  std::vector<Vec3d> points_;
  std::vector<Node> nodes_;
};

}  // namespace bihive
