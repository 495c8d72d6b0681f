// grid: cells of one size, each with a list of the spheres whose boxes reach into it; rays go from cell to cell
// [Amanatides1987].
//
// Near an edge of two cells, rounding may lead a ray through either. So a sphere is listed in every cell that its box,
// padded by kPad, touches. That is more than the error of a ray whose padding of boxes is at most kLargestError, which
// holds for origins within 2^22 extents of the set. A ray from beyond tests every sphere.

#include <algorithm>
#include <array>
#include <cmath>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

constexpr double kPad = 0x1p-22, kLargestError = 0x1p-24;  // stored units
constexpr double kCellsPerSphere = 2;
constexpr int kMostCellsAlong = 1024;
// Cells become larger until all lists together have at most this many entries per sphere.
constexpr std::int64_t kMostEntries = 12;

using Cell = std::array<int, 3>;

class Grid final : public ByRay<Grid> {
 public:
  explicit Grid(const SphereSet& spheres) : ByRay(spheres) {
    if (spheres.empty()) return;
    for (std::int64_t id = 0; id < spheres.size(); ++id) box_.add(padded_box(id));
    choose_cells();
    list_spheres();
  }

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = static_cast<std::int64_t>(sizeof(Grid) + 4 * (begin_.capacity() + ids_.capacity()));
    if (begin_.empty()) return facts;
    const auto cells = static_cast<std::int64_t>(begin_.size()) - 1;
    facts.nodes = cells;
    facts.depth = 1;
    facts.references = static_cast<std::int64_t>(ids_.size());
    for (std::int64_t i = 0; i < cells; ++i)
      facts.leaves += begin_[static_cast<std::size_t>(i)] < begin_[static_cast<std::size_t>(i + 1)] ? 1 : 0;
    const double share = (size_.x * size_.y + size_.y * size_.z + size_.z * size_.x) / half_surface(box_);
    facts.expected_nodes = share * static_cast<double>(cells);
    facts.expected_spheres = facts.expected_test_steps = share * static_cast<double>(ids_.size());
    return facts;
  }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    // Find where the ray enters the grid.
    const RayAndBoxes boxes(ray);
    if (boxes.pad() > kLargestError) return trace_all(ray, answer, counter);
    counter.box_test();
    const Interval part = boxes.inside(box_);
    if (part.empty()) return;
    Cell cell = cell_at(ray.origin + ray.direction * part.t_near);

    // Find the t of the next plane along each axis.
    Vec3d next_t;
    Cell step{};
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t k = static_cast<std::size_t>(axis);
      const double direction = ray.direction[axis];
      step[k] = direction > 0 ? 1 : direction < 0 ? -1 : 0;
      next_t[axis] = step[k] == 0 ? std::numeric_limits<double>::infinity()
                                  : plane_t(ray, boxes, axis, cell[k] + (step[k] > 0 ? 1 : 0));
    }

    for (;;) {
      counter.node(first_of(cell) < end_of(cell));
      for (std::uint32_t i = first_of(cell); i < end_of(cell); ++i)
        if (test(ray, std::int64_t{ids_[i]}, answer, counter)) return;
      // Cross the nearest plane, unless the answer lies before it.
      const int axis = next_t.x <= next_t.y && next_t.x <= next_t.z ? 0 : next_t.y <= next_t.z ? 1 : 2;
      const std::size_t k = static_cast<std::size_t>(axis);
      if (next_t[axis] > std::min(answer.limit(), part.t_far)) return;
      cell[k] += step[k];
      if (cell[k] < 0 || cell[k] >= count_[k]) return;
      next_t[axis] = plane_t(ray, boxes, axis, cell[k] + (step[k] > 0 ? 1 : 0));
    }
  }

  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    // Take shell after shell of cells around the one that is nearest to the point.
    const Cell middle = cell_at(point);
    const double pad = rounding_pad(point);
    for (int shell = 0;; ++shell) {
      bool any = false;
      Cell lo, hi;
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::max(middle[k] - shell, 0);
        hi[k] = std::min(middle[k] + shell, count_[k] - 1);
      }
      for (int z = lo[2]; z <= hi[2]; ++z)
        for (int y = lo[1]; y <= hi[1]; ++y) {
          const bool inner = std::abs(z - middle[2]) < shell && std::abs(y - middle[1]) < shell;
          for (int x = lo[0]; x <= hi[0]; ++x) {
            if (inner && std::abs(x - middle[0]) < shell) {
              x = middle[0] + shell - 1;  // to the other side of the shell
              continue;
            }
            any = true;
            const Cell cell{x, y, z};
            counter.node(first_of(cell) < end_of(cell));
            for (std::uint32_t i = first_of(cell); i < end_of(cell); ++i)
              test(point, std::int64_t{ids_[i]}, nearest, counter);
          }
        }
      if (!any) return;
      if (beyond(shell, middle, point) - pad > nearest.limit()) return;
    }
  }

 private:
  Aabb box_;
  Vec3d size_;  // of a cell
  Cell count_{};
  std::vector<std::uint32_t> begin_, ids_;  // cell -> its first entry; one more than there are cells

  Aabb padded_box(std::int64_t id) const {
    Aabb box = outward_box(spheres(), id);
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = rounded_down(double(box.lo[axis]) - kPad);
      box.hi[axis] = rounded_up(double(box.hi[axis]) + kPad);
    }
    return box;
  }

  double plane(int axis, int number) const { return double(box_.lo[axis]) + number * size_[axis]; }
  double plane_t(const ScaledRay& ray, const RayAndBoxes& boxes, int axis, int number) const {
    return (plane(axis, number) - ray.origin[axis]) * boxes.inverse(axis);
  }

  Cell cell_at(Vec3d position) const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      const auto last = static_cast<double>(count_[static_cast<std::size_t>(axis)] - 1);
      const double place = std::floor((position[axis] - double(box_.lo[axis])) / size_[axis]);
      cell[static_cast<std::size_t>(axis)] = static_cast<int>(std::clamp(place, 0.0, last));
    }
    return cell;
  }
  std::size_t number_of(const Cell& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(cell[0]);
  }
  std::uint32_t first_of(const Cell& cell) const { return begin_[number_of(cell)]; }
  std::uint32_t end_of(const Cell& cell) const { return begin_[number_of(cell) + 1]; }

  void set_cells(double side) {
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = double(box_.hi[axis]) - double(box_.lo[axis]);
      const double along = std::clamp(std::ceil(extent / side), 1.0, double(kMostCellsAlong));
      count_[static_cast<std::size_t>(axis)] = static_cast<int>(along);
      size_[axis] = extent / along;
    }
  }

  // Cubes, kCellsPerSphere for each sphere; larger ones if too many spheres reach into several.
  void choose_cells() {
    const Vec3d extent = to_double(box_.hi) - to_double(box_.lo);
    double side = std::cbrt(extent.x * extent.y * extent.z / (kCellsPerSphere * double(spheres().size())));
    for (set_cells(side); count_ != Cell{1, 1, 1}; set_cells(side *= 1.5)) {
      const double cells = double(count_[0]) * count_[1] * count_[2];
      if (cells <= kMostEntries * double(spheres().size()) + 64 && entries() <= kMostEntries * spheres().size()) return;
    }
  }

  std::int64_t entries() const {
    std::int64_t sum = 0;
    for (std::int64_t id = 0; id < spheres().size() && sum <= kMostEntries * spheres().size(); ++id) {
      const auto [lo, hi] = cells_of(id);
      sum += (std::int64_t{hi[0]} - lo[0] + 1) * (hi[1] - lo[1] + 1) * (hi[2] - lo[2] + 1);
    }
    return sum;
  }
  std::pair<Cell, Cell> cells_of(std::int64_t id) const {
    const Aabb box = padded_box(id);
    return {cell_at(to_double(box.lo)), cell_at(to_double(box.hi))};
  }
  template <class Use>
  void for_each_entry(const Use& use) const {
    for (std::int64_t id = 0; id < spheres().size(); ++id) {
      const auto [lo, hi] = cells_of(id);
      for (int z = lo[2]; z <= hi[2]; ++z)
        for (int y = lo[1]; y <= hi[1]; ++y)
          for (int x = lo[0]; x <= hi[0]; ++x) use(number_of({x, y, z}), static_cast<std::uint32_t>(id));
    }
  }

  // Counts the entries of each cell, then lists them.
  void list_spheres() {
    begin_.assign(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                          static_cast<std::size_t>(count_[2]) +
                      1,
                  0);
    for_each_entry([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    ids_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_entry([&](std::size_t cell, std::uint32_t id) { ids_[next[cell]++] = id; });
  }

  template <class Answer, class Counter>
  void trace_all(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    for (std::int64_t id = 0; id < spheres().size(); ++id)
      if (test(ray, id, answer, counter)) return;
  }

  // A lower bound of the distance between the point and anything that only cells beyond the shell list. Those spheres
  // lie outside the shell's cells. From a point beside the grid, everything in it is at least as far as the grid, and
  // as the nearest point of the grid is from the shell's end.
  double beyond(int shell, const Cell& middle, Vec3d point) const {
    double outside_squared = 0, inside = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t k = static_cast<std::size_t>(axis);
      const double lo = box_.lo[axis], hi = box_.hi[axis];
      const double nearest = std::clamp(point[axis], lo, hi);
      outside_squared += (point[axis] - nearest) * (point[axis] - nearest);
      if (middle[k] - shell > 0) inside = std::min(inside, nearest - plane(axis, middle[k] - shell));
      if (middle[k] + shell < count_[k] - 1) inside = std::min(inside, plane(axis, middle[k] + shell + 1) - nearest);
    }
    return std::sqrt(outside_squared + std::max(inside, 0.0) * std::max(inside, 0.0));
  }
};

}  // namespace

Result<StructurePointer> build_grid(const SphereSet& spheres, const StructureParameters&, int) {
  return build_or_error(
      spheres, "grid", [&]() -> StructurePointer { return std::make_unique<Grid>(spheres); }, kMostEntries);
}

}  // namespace bihive::workbench
