#include "bihive/geometry/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"

namespace bihive {
namespace {

constexpr std::uint64_t kMostGridCells = 1 << 21;  // along an axis, with one to spare at either end
constexpr std::int64_t kCellsOfChunk = 4096;       // for a thread at a time
constexpr double kMostImagesOfPoint = 1 << 10;     // of a point

// The points in the cell of the lattice at the origin, and images of them beyond its sides.
struct Spread {
  std::vector<Vec3d> at;
  std::vector<std::int32_t> point;  // which one it is
  std::vector<ImageCounts> image;   // how often it is moved; of the first: to where they are
};

Result<Spread> spread_out(const std::vector<Vec3d>& points, const std::vector<double>& radii,
                          const std::optional<Lattice>& lattice, double longest) {
  Spread spread;
  spread.at.reserve(points.size());
  spread.point.reserve(points.size());
  spread.image.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(radii[i] > 0)) continue;
    const ImageCounts from = lattice && lattice->holds(points[i]) ? lattice->cell_of(points[i]) : ImageCounts{};
    spread.at.push_back(lattice ? points[i] - lattice->shift(from) : points[i]);
    spread.point.push_back(static_cast<std::int32_t>(i));
    spread.image.push_back(ImageCounts{} - from);
  }
  if (!lattice) return spread;

  double largest = 0;
  for (const Vec3d at : spread.at) largest = std::max(largest, largest_coordinate(at));
  const std::size_t count = spread.at.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d at = spread.at[i];
    // Deep inside the cell all images are too far away: most points of a large one.
    const Vec3d share = lattice->shares(at);
    bool is_deep = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double margin = longest * lattice->share_of_length(k) * (1 + 0x1p-10) + 0x1p-10;
      const double along = share[static_cast<int>(k)];
      is_deep = is_deep && (lattice->share_of_length(k) == 0 || (along > margin && along < 1 - margin));
    }
    if (is_deep) continue;
    if (!lattice->holds(points[static_cast<std::size_t>(spread.point[i])])) continue;
    // Counts that bring the cell near the point: the opposite ones bring the point near the cell.
    const Lattice::Range range = lattice->images_within(longest, at, {0, 0, 0}, {1, 1, 1}, largest);
    if (range.count() > kMostImagesOfPoint)
      return Error{"the periodic cell is so small that a point is near more than 1,000 of its images", "", 0, 0,
                   "leave the cell out"};
    any_image(range, [&](const ImageCounts& against) {
      if (against == ImageCounts{}) return false;
      spread.at.push_back(at - lattice->shift(against));
      spread.point.push_back(spread.point[i]);
      spread.image.push_back(spread.image[i] - against);
      return false;
    });
  }
  if (spread.at.size() > std::numeric_limits<std::int32_t>::max()) return no_memory_for("the images of the points");
  return spread;
}

// Positions sorted by the cells of a grid. Cells are as long as the longest distance, or longer in very large sets.
class Grid {
 public:
  Grid(const std::vector<Vec3d>& at, double longest) {
    Vec3d lo = at.front(), hi = lo;
    for (const Vec3d& one : at)
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], one[axis]);
        hi[axis] = std::max(hi[axis], one[axis]);
      }
    const double extent = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
    const double side = std::max(longest, extent / static_cast<double>(kMostGridCells / 2));
    std::vector<std::pair<std::uint64_t, std::int32_t>> sorted;
    sorted.reserve(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::uint64_t cell = 0;
      for (int axis = 2; axis >= 0; --axis)
        cell = cell * kMostGridCells + static_cast<std::uint64_t>((at[i][axis] - lo[axis]) / side) + 1;
      sorted.emplace_back(cell, static_cast<std::int32_t>(i));
    }
    std::sort(sorted.begin(), sorted.end());
    places_.reserve(at.size());
    for (const auto& [cell, i] : sorted) {
      if (cells_.empty() || cells_.back() != cell) {
        cells_.push_back(cell);
        begins_.push_back(places_.size());
      }
      places_.push_back({at[static_cast<std::size_t>(i)], i});
    }
    begins_.push_back(places_.size());
  }

  std::int64_t cells() const { return static_cast<std::int64_t>(cells_.size()); }

  /// Calls use(i, at_i, j, at_j) once for any two positions in the same cell or in neighbouring ones, of which the
  /// first is in a cell from `first` to before `end`.
  template <class Use>
  void for_each_near_pair(std::int64_t first, std::int64_t end, const Use& use) const {
    // The neighbours that come after a cell: one along x, and four rows of three, which follow each other. As cells
    // ascend, so do the rows.
    constexpr std::uint64_t kY = kMostGridCells, kZ = kMostGridCells * kMostGridCells;
    constexpr std::uint64_t kRows[] = {kY, kZ - kY, kZ, kZ + kY};
    std::size_t row_begins[4];
    for (std::size_t row = 0; row < 4; ++row)
      row_begins[row] = first_cell_from(cells_[static_cast<std::size_t>(first)] + kRows[row] - 1);
    for (auto cell = static_cast<std::size_t>(first); cell < static_cast<std::size_t>(end); ++cell) {
      const std::size_t begin = begins_[cell], behind = begins_[cell + 1];
      const bool has_next = cell + 1 < cells_.size() && cells_[cell + 1] == cells_[cell] + 1;
      const std::size_t next_end = has_next ? begins_[cell + 2] : behind;
      for (std::size_t i = begin; i < behind; ++i)
        for (std::size_t j = i + 1; j < next_end; ++j) use(places_[i], places_[j]);
      for (std::size_t row = 0; row < 4; ++row) {
        const std::uint64_t middle = cells_[cell] + kRows[row];
        std::size_t& from = row_begins[row];
        while (from < cells_.size() && cells_[from] < middle - 1) ++from;
        std::size_t to = from;
        while (to < cells_.size() && cells_[to] <= middle + 1) ++to;
        for (std::size_t i = begin; i < behind; ++i)
          for (std::size_t j = begins_[from]; j < begins_[to]; ++j) use(places_[i], places_[j]);
      }
    }
  }

  struct Place {
    Vec3d at;
    std::int32_t number;
  };

 private:
  std::size_t first_cell_from(std::uint64_t cell) const {
    return static_cast<std::size_t>(std::lower_bound(cells_.begin(), cells_.end(), cell) - cells_.begin());
  }

  std::vector<std::uint64_t> cells_;  // those that are not empty
  std::vector<std::size_t> begins_;   // of their places
  std::vector<Place> places_;
};

// Sorts by the first point in one pass, then the few pairs of each.
std::vector<NearPair> in_order(const std::vector<std::vector<NearPair>>& chunks, std::size_t points) {
  std::vector<std::size_t> begin(points + 1, 0);
  for (const std::vector<NearPair>& chunk : chunks)
    for (const NearPair& pair : chunk) ++begin[static_cast<std::size_t>(pair.points[0]) + 1];
  for (std::size_t i = 0; i < points; ++i) begin[i + 1] += begin[i];
  std::vector<NearPair> sorted(begin[points]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const std::vector<NearPair>& chunk : chunks)
    for (const NearPair& pair : chunk) sorted[next[static_cast<std::size_t>(pair.points[0])]++] = pair;
  for (std::size_t i = 0; i < points; ++i)
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[i]),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]), [](const NearPair& a, const NearPair& b) {
                return std::tie(a.points[1], a.image) < std::tie(b.points[1], b.image);
              });
  return sorted;
}

}  // namespace

Result<std::vector<NearPair>> near_pairs(const std::vector<Vec3d>& points, const std::vector<double>& radii,
                                         const std::optional<Lattice>& lattice, int threads) {
  const double largest = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
  if (!(largest > 0)) return std::vector<NearPair>();
  const Result<Spread> spread_points = spread_out(points, radii, lattice, 2 * largest);
  if (!spread_points) return spread_points.error();
  const Spread& spread = *spread_points;
  const Grid grid(spread.at, 2 * largest * (1 + 0x1p-20));

  // The distance is that of the points where they are, so that it does not depend on the grid.
  const auto take = [&](std::int32_t first, std::int32_t second, std::vector<NearPair>& found) {
    const auto p = static_cast<std::size_t>(first), q = static_cast<std::size_t>(second);
    std::int32_t one = spread.point[p], other = spread.point[q];
    ImageCounts image = spread.image[q] - spread.image[p];
    if (one > other || (one == other && image < ImageCounts{})) {
      std::swap(one, other);
      image = ImageCounts{} - image;
    }
    const auto i = static_cast<std::size_t>(one), j = static_cast<std::size_t>(other);
    Vec3d between = points[j] - points[i];
    if (image != ImageCounts{}) between = between + lattice->shift(image);
    const double distance_squared = dot(between, between);
    const double limit = radii[i] + radii[j];
    if (distance_squared > 0 && distance_squared <= limit * limit)
      found.push_back({{one, other}, image, distance_squared});
  };
  // Any two positions far enough apart are dropped first; and of a pair and its copies across the cell, the one whose
  // first point is in the cell counts.
  const std::int32_t inside =
      static_cast<std::int32_t>(std::count_if(radii.begin(), radii.end(), [](double radius) { return radius > 0; }));
  const double farthest = 4 * largest * largest * (1 + 0x1p-10);
  const std::int64_t chunk_count = (grid.cells() + kCellsOfChunk - 1) / kCellsOfChunk;
  std::vector<std::vector<NearPair>> chunks(static_cast<std::size_t>(chunk_count));
  watched_for(threads, chunk_count, [&](std::int64_t chunk) {
    std::vector<NearPair>& found = chunks[static_cast<std::size_t>(chunk)];
    grid.for_each_near_pair(chunk * kCellsOfChunk, std::min((chunk + 1) * kCellsOfChunk, grid.cells()),
                            [&](const Grid::Place& a, const Grid::Place& b) {
                              const Vec3d apart = b.at - a.at;
                              if (dot(apart, apart) > farthest) return;
                              const bool a_is_inside = a.number < inside, b_is_inside = b.number < inside;
                              if (!a_is_inside && !b_is_inside) return;
                              if (a_is_inside != b_is_inside) {
                                // Both (i, image of j) and (j, image of i) are found.
                                const Grid::Place& real = a_is_inside ? a : b;
                                const Grid::Place& moved = a_is_inside ? b : a;
                                const std::int32_t i = spread.point[static_cast<std::size_t>(real.number)];
                                const std::int32_t j = spread.point[static_cast<std::size_t>(moved.number)];
                                if (i > j || (i == j && spread.image[static_cast<std::size_t>(moved.number)] <
                                                            spread.image[static_cast<std::size_t>(real.number)]))
                                  return;
                              }
                              take(a.number, b.number, found);
                            });
  });
  return in_order(chunks, points.size());
}

}  // namespace bihive
