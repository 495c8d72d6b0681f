#include "bihive/io/assemble/nearest_place.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {
namespace {

// Of 8, 16, 32 and 64 points, 32 take the least time for a million random points, or nearly so.
constexpr std::size_t kMostInLeaf = 32;

// Fewer points are one thread's work.
constexpr std::size_t kFewForThreads = std::size_t{1} << 16;

// A square below this bound may have lost bits. Then all differences are multiplied by 2^600 before they are squared:
// the smallest difference of binary64 is 2^-1074, and a distance below 2^-450 becomes at most 2^150.
constexpr double kSmallestSquare = 0x1p-900;
constexpr double kScaleForSmall = 0x1p600;

// A place on the border of a cell and its image on the other side may differ by the file's last digit.
constexpr double kSamePlace = 0x1p-20;

// At most this many images are tried for one place. Two kinds of places would need more, and would take time without an
// end: those so far away that rounding leaves them outside the cell, and those without a neighbour in an extremely
// skewed cell.
constexpr double kMostImages = 4096;

double square(Vec3d difference, double scale) {
  const Vec3d scaled = scale * difference;
  return dot(scaled, scaled);
}

}  // namespace

struct NearestPlace::Search {
  Vec3d from;
  double scale;
  double best = std::numeric_limits<double>::infinity();  // squared
  Vec3d shift{};                                          // of the points
  double same_place = -1;                                 // squared; below 0: of equal points alone
  double pad = 0;                                         // of `from` and `shift`, rounded

  // Rounding keeps the order of numbers, so no point of the box has a smaller rounded square.
  double square_to(const Box& box) const {
    Vec3d outside;
    for (int axis = 0; axis < 3; ++axis)
      outside[axis] =
          std::max({box.lo[axis] - (from - shift)[axis] - pad, (from - shift)[axis] - box.hi[axis] - pad, 0.0});
    return square(outside, scale);
  }
};

// The nodes above a range of points: those that one thread made, or one node and two halves.
struct NearestPlace::Range {
  std::size_t first, end;
  std::vector<Node> nodes{};
  std::unique_ptr<Range> halves[2]{};
  std::exception_ptr thrown{};
};

NearestPlace::NearestPlace(std::vector<Vec3d> points, const std::optional<Lattice>& lattice)
    : lattice_(lattice), points_(std::move(points)) {
  BIHIVE_CHECK(!points_.empty());
  bool is_first = true;
  if (lattice_)
    for (Vec3d& point : points_) {
      point = point - lattice_->shift(lattice_->cell_of(point));
      const Vec3d share = lattice_->shares(point);
      for (int axis = 0; axis < 3; ++axis) {
        lowest_share_[axis] = is_first ? share[axis] : std::min(lowest_share_[axis], share[axis]);
        highest_share_[axis] = is_first ? share[axis] : std::max(highest_share_[axis], share[axis]);
      }
      is_first = false;
    }
  Range all{0, points_.size()};
  parallel_tasks(0, [&](TaskList& tasks) { build(all, tasks); });
  append(all);
}

double NearestPlace::distance_from(Vec3d from) const {
  Search search{from, 1};
  if (lattice_) {
    // Its own images are other places.
    search.from = from - lattice_->shift(lattice_->cell_of(from));
    search.best = lattice_->shortest() * lattice_->shortest();
    search.same_place = kSamePlace * kSamePlace * search.best;
    const double largest = largest_coordinate(search.from) + 2 * lattice_->longest();
    search.pad = 0x1p-48 * lattice_->condition() * largest;
    visit(0, search);
    const auto range =
        lattice_->images_within(std::sqrt(search.best), search.from, lowest_share_, highest_share_, largest);
    if (range.count() > kMostImages) return std::sqrt(search.best);
    any_image(range, [&](const ImageCounts& counts) {
      if (counts == ImageCounts{}) return false;
      search.shift = lattice_->shift(counts);
      visit(0, search);
      return false;
    });
    return std::sqrt(search.best);
  }
  visit(0, search);
  if (search.best >= kSmallestSquare) return std::sqrt(search.best);
  search = {from, kScaleForSmall};
  visit(0, search);
  return std::sqrt(search.best) / kScaleForSmall;
}

NearestPlace::Box NearestPlace::box_of(std::size_t first, std::size_t end) const {
  Box box{points_[first], points_[first]};
  for (std::size_t i = first + 1; i < end; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], points_[i][axis]);
      box.hi[axis] = std::max(box.hi[axis], points_[i][axis]);
    }
  }
  return box;
}

namespace {

int widest_axis(Vec3d extent) {
  return extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
}

}  // namespace

// Builds both halves in parallel where there are many points.
void NearestPlace::build(Range& range, TaskList& tasks) {
  try {
    const auto [first, end] = std::pair(range.first, range.end);
    const Box box = box_of(first, end);
    if (end - first < kFewForThreads || box.lo == box.hi) {
      range.nodes.reserve((end - first) / (kMostInLeaf / 4) + 1);
      build_into(range.nodes, first, end);
      return;
    }
    const std::size_t middle = part(first, end, widest_axis(box.hi - box.lo));
    range.nodes = {{box, 0, first, end}};
    range.halves[0] = std::make_unique<Range>(Range{first, middle});
    range.halves[1] = std::make_unique<Range>(Range{middle, end});
    tasks.add([this, &left = *range.halves[0], &tasks] { build(left, tasks); });
    build(*range.halves[1], tasks);
  } catch (...) {
    range.thrown = std::current_exception();
  }
}

// Appends the nodes of a range.
void NearestPlace::append(Range& range) {
  if (range.thrown) std::rethrow_exception(range.thrown);
  const std::size_t at = nodes_.size();
  for (Node node : std::exchange(range.nodes, {})) {
    if (node.right != 0) node.right += at;
    nodes_.push_back(node);
  }
  if (!range.halves[0]) return;
  append(*range.halves[0]);
  nodes_[at].right = nodes_.size();
  append(*range.halves[1]);
}

void NearestPlace::build_into(std::vector<Node>& nodes, std::size_t first, std::size_t end) {
  const std::size_t at = nodes.size();
  const Box box = box_of(first, end);
  nodes.push_back({box, 0, first, end});
  if (box.lo == box.hi) {
    nodes[at].end = first + 1;  // one place, however many points
    return;
  }
  if (end - first <= kMostInLeaf) return;

  const std::size_t middle = part(first, end, widest_axis(box.hi - box.lo));
  build_into(nodes, first, middle);
  nodes[at].right = nodes.size();
  build_into(nodes, middle, end);
}

// Sorts the points into those below a value and the rest, as near to halves as can be without parting equal ones, and
// returns where the rest begins. Not all points may have the same value on this axis.
std::size_t NearestPlace::part(std::size_t first, std::size_t end, int axis) {
  const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto middle = at(first + (end - first) / 2);
  std::nth_element(at(first), middle, at(end), [axis](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
  const double value = (*middle)[axis];

  // The points of this value lie together from `low` on, up to `high`. Part at the end of them that is nearer the
  // middle.
  const auto low = std::partition(at(first), middle, [axis, value](const Vec3d& point) { return point[axis] < value; });
  const auto high =
      std::partition(middle, at(end), [axis, value](const Vec3d& point) { return !(point[axis] > value); });
  const bool at_low = low != at(first) && (high == at(end) || middle - low <= high - middle);
  return static_cast<std::size_t>((at_low ? low : high) - points_.begin());
}

void NearestPlace::visit(std::size_t at, Search& search) const {
  const Node& node = nodes_[at];
  if (node.right == 0) {
    for (std::size_t i = node.first; i < node.end; ++i)
      if (points_[i] != search.from || search.shift != Vec3d{}) {
        const double distance = square((points_[i] - search.from) + search.shift, search.scale);
        if (distance > search.same_place) search.best = std::min(search.best, distance);
      }
    return;
  }
  std::pair<double, std::size_t> near{search.square_to(nodes_[at + 1].box), at + 1};
  std::pair<double, std::size_t> far{search.square_to(nodes_[node.right].box), node.right};
  if (far < near) std::swap(near, far);
  for (const auto& [square_to_box, child] : {near, far})
    if (square_to_box < search.best) visit(child, search);
}

}  // namespace bihive
