#include "bihive/measure/boundary.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/watch.h"
#include "bihive/measure/neighbour_grid.h"
#include "bihive/measure/periodic_balls.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/wide_builder.h"

namespace bihive::measure {
namespace {

// Lists of the tree for this many spheres are in memory at once.
constexpr std::int64_t kBlock = 1 << 13;
// A thread takes this many spheres at once.
constexpr std::int64_t kChunk = 64;

// A multiple of 2^-160.
double on_grid(double x) {
  return x >= 0x1p-100 ? x : std::ldexp(std::floor(std::ldexp(x, 160)), -160);
}

std::int64_t chunks_of(std::int64_t count) {
  return (count + kChunk - 1) / kChunk;
}

// Takes one ball after the other of a chunk.
class Chunk {
 public:
  Chunk(const Counted& counted, std::int64_t number, Boundary& boundary)
      : counted_(counted), number_(static_cast<std::size_t>(number)), boundary_(boundary), sphere_(counted.balls) {}

  void take(std::int64_t i, const std::int64_t* near, std::int64_t count) {
    boundary_.parts[i] = sphere_.measure(i, near, count);
    if (!boundary_.cells.empty()) take_facets(i);
    if (!boundary_.pieces.empty()) take_pieces(i);
    if (!boundary_.changes.empty()) {
      std::vector<AreaChange>& changes = boundary_.changes[number_];
      std::size_t n = changes.size();
      sphere_.append_area_changes(changes);
      for (; n < changes.size() && counted_.balls.is_periodic(); ++n)
        changes[n].ball = counted_.balls.image[changes[n].ball].ball;
    }
    if (!boundary_.links.empty()) {
      neighbours_.clear();
      sphere_.append_neighbours(neighbours_);
      for (const std::int64_t j : neighbours_) boundary_.links[number_].push_back({i, j});
    }
  }

 private:
  const Counted& counted_;
  std::size_t number_;
  Boundary& boundary_;
  ExposedSphere sphere_;
  std::vector<Facet> facets_;
  std::vector<std::int64_t> neighbours_;

  // Cones from the centre, and the sector of the exposed part.
  void take_facets(std::int64_t i) {
    facets_.clear();
    sphere_.append_facets(facets_);
    const ExposedPart& part = boundary_.parts[i];
    double sum = part.solid_angle, error = part.solid_angle_error + 0x1p-50 * part.solid_angle;
    for (const Facet& facet : facets_) {
      sum += facet.distance * facet.area;
      error += std::abs(facet.distance) * facet.area_error + 0x1p-48 * facet.area;
      // A degenerate facet, where four planes and more meet in a line, has an area of about 0.
      if (!boundary_.facets.empty() && facet.area > facet.area_error && counted_.balls.comes_before(i, facet.ball))
        boundary_.facets[number_].push_back({i, facet});
    }
    boundary_.cells[i] = {std::max(sum, 0.0) / 3, error / 3};
  }

  void take_pieces(std::int64_t i) {
    Pieces& own = boundary_.pieces[number_];
    const std::size_t known = own.junctions.size();
    PieceArcs arcs;
    PieceArcs* const wanted = boundary_.arcs.empty() ? nullptr : &arcs;
    own.undecided_spheres += sphere_.append_pieces(own.pieces, own.junctions, wanted) ? 0 : 1;
    own.owner.resize(own.pieces.size(), i);
    if (!arcs.arcs.empty()) boundary_.arcs[number_].push_back({i, std::move(arcs)});
    if (!counted_.balls.is_periodic()) return;
    // Move each junction so that its first ball is in the cell.
    for (std::size_t n = known; n < own.junctions.size(); ++n) {
      Junction& junction = own.junctions[n];
      const Image first = counted_.balls.image[junction.i];
      const auto move = [&](std::int64_t& ball) {
        Image image = counted_.balls.image[ball];
        image.a -= first.a;
        image.b -= first.b;
        image.c -= first.c;
        ball = find_image(counted_.balls, counted_.size(), image);
        BIHIVE_CHECK(ball >= 0);
      };
      if (first.counts() == ImageCounts{}) continue;
      move(junction.j);
      if (junction.k >= 0) move(junction.k);
      junction.i = first.ball;
      junction.lift = {static_cast<std::int16_t>(-first.a), static_cast<std::int16_t>(-first.b),
                       static_cast<std::int16_t>(-first.c)};
    }
  }
};

void measure_by_grid(const Counted& counted, const NeighbourGrid& grid, int threads, Boundary& boundary) {
  const std::vector<std::int64_t>& order = grid.order();
  const auto count = static_cast<std::int64_t>(order.size());
  watched_for(threads, chunks_of(count), [&](std::int64_t number) {
    Chunk chunk(counted, number, boundary);
    std::vector<std::int64_t> near;
    const std::int64_t end = std::min(count, (number + 1) * kChunk);
    for (std::int64_t n = number * kChunk; n < end; ++n) {
      if (order[n] >= counted.size()) continue;  // an image
      near.clear();
      grid.find(counted.balls, order[n], near);
      chunk.take(order[n], near.data(), static_cast<std::int64_t>(near.size()));
    }
  });
}

// The spheres of a tree: without the probe as they are stored; of periodic sets the balls, rounded.
struct TreeSpheres {
  SphereSet set;
  double probe = 0;     // that the tree's radii lack
  double rounding = 0;  // of the tree's centres and radii
};
Result<TreeSpheres> tree_spheres(const Counted& counted, const SphereSet& set) {
  TreeSpheres made;
  const Balls& balls = counted.balls;
  if (!balls.is_periodic()) {
    StoredSpheres stored;
    for (const std::int64_t id : counted.ids) {
      const auto i = static_cast<std::size_t>(id);
      stored.x.push_back(set.x()[i]);
      stored.y.push_back(set.y()[i]);
      stored.z.push_back(set.z()[i]);
      stored.r.push_back(set.r()[i]);
    }
    made.set = SphereSet::from_stored(std::move(stored), 0, {});
    made.probe = counted.probe;
    return made;
  }
  std::vector<double> x, y, z;
  double largest = 0;
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    x.push_back(balls.centre[i].x);
    y.push_back(balls.centre[i].y);
    z.push_back(balls.centre[i].z);
    largest = std::max(largest, largest_coordinate(balls.centre[i]) + balls.radius[i]);
  }
  Result<SphereSet> rounded = SphereSet::from_world(x, y, z, balls.radius);
  if (!rounded) return rounded.error();
  made.set = std::move(*rounded);
  made.rounding = 0x1p-20 * largest;
  return made;
}

// For balls that are distributed unevenly.
Status measure_by_tree(const Counted& counted, const SphereSet& set, int threads, Boundary& boundary) {
  const Result<TreeSpheres> spheres = tree_spheres(counted, set);
  if (!spheres) return spheres.error();
  const auto tree = WideBuilder().build(spheres->set, {}, threads);
  if (!tree) return tree.error();
  const Balls& balls = counted.balls;
  const double largest = *std::max_element(balls.radius.begin(), balls.radius.end());
  PointOptions options;
  options.threads = threads;
  std::vector<double> reach;
  for (std::int64_t first = 0; first < counted.size(); first += kBlock) {
    const std::int64_t count = std::min(kBlock, counted.size() - first);
    // Ball i meets ball j where ball i, grown once more, meets the sphere of j: with an allowance for the rounding of
    // distances, since exact decisions follow.
    reach.resize(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i)
      reach[i] = (balls.radius[first + i] + spheres->probe) * (1 + 0x1p-40) + 0x1p-45 * largest + spheres->rounding;
    const auto lists =
        spheres_overlapping(**tree, PointSpan::rows(&balls.centre[first].x, count), reach.data(), options);
    if (!lists) return lists.error();
    const auto share = [&](std::int64_t balls_done) { return double(balls_done) / double(counted.size()); };
    const auto measure_chunk = [&](std::int64_t number) {
      Chunk chunk(counted, first / kChunk + number, boundary);
      const std::int64_t end = std::min(count, (number + 1) * kChunk);
      for (std::int64_t i = number * kChunk; i < end; ++i)
        chunk.take(first + i, lists->sphere_id.data() + lists->begin[i], lists->begin[i + 1] - lists->begin[i]);
    };
    watched_for(threads, chunks_of(count), measure_chunk, share(first), share(first + count));
  }
  return Done{};
}

}  // namespace

Counted counted_spheres(const SphereSet& set, double probe, const std::uint8_t* mask) {
  Counted counted;
  counted.probe = probe;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    if (mask != nullptr && mask[id] == 0) continue;
    const double radius = on_grid(set.stored_radius(id) + probe);
    if (radius == 0) continue;
    counted.ids.push_back(id);
    counted.balls.centre.push_back(set.stored_centre(id));
    counted.balls.radius.push_back(radius);
  }
  return counted;
}

Result<Boundary> boundary_of(const Counted& counted, const SphereSet& set, const Wanted& wanted, int threads) {
  Boundary boundary;
  boundary.parts.resize(static_cast<std::size_t>(counted.size()));
  if (counted.size() == 0) return boundary;
  const auto chunks = static_cast<std::size_t>(chunks_of(counted.balls.size()));
  if (wanted.cells || wanted.facets) boundary.cells.resize(boundary.parts.size());
  if (wanted.facets) boundary.facets.resize(chunks);
  if (wanted.pieces) boundary.pieces.resize(chunks);
  if (wanted.arcs) boundary.arcs.resize(chunks);
  if (wanted.changes) boundary.changes.resize(chunks);
  if (wanted.pieces && counted.balls.is_periodic()) boundary.links.resize(chunks);
  const std::optional<NeighbourGrid> grid = NeighbourGrid::of(counted.balls);
  if (grid) {
    measure_by_grid(counted, *grid, threads, boundary);
    return boundary;
  }
  if (const Status status = measure_by_tree(counted, set, threads, boundary); !status) return status.error();
  return boundary;
}

}  // namespace bihive::measure
