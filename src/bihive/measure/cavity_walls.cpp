#include "bihive/measure/cavity_walls.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <string>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/measure/boundary.h"
#include "bihive/measure/surfaces.h"
#include "bihive/measure/union_measures.h"

namespace bihive {
namespace {

using measure::Boundary;
using measure::Counted;
using measure::Surface;

// Of each surface, its cavity's number from 1 on by descending volume; 0: it is no cavity's wall.
std::vector<std::int32_t> numbers_of_cavities(const std::vector<Surface>& surfaces, double least_volume) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
    if (!surfaces[n].encloses_balls && -surfaces[n].volume > least_volume) order.push_back(n);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return surfaces[a].volume < surfaces[b].volume; });
  std::vector<std::int32_t> numbers(surfaces.size(), 0);
  for (std::size_t n = 0; n < order.size(); ++n) numbers[order[n]] = static_cast<std::int32_t>(n + 1);
  return numbers;
}

}  // namespace

Result<CavityWalls> CavityWalls::of(SphereSet spheres, int threads) {
  CavityWalls walls;
  walls.spheres_ = std::move(spheres);
  const SphereSet& set = walls.spheres_;
  MeasureOptions options;
  options.threads = threads;
  // The rounding error of the volume is the least volume of a cavity.
  const Result<UnionMeasures> measures = measure_union(set, options);
  if (!measures) return measures.error();
  try {
    WatchedWork work;
    const Counted counted = measure::counted_spheres(set, 0, nullptr);
    measure::Wanted wanted;
    wanted.pieces = wanted.arcs = true;
    Result<Boundary> boundary = measure::boundary_of(counted, set, wanted, threads);
    if (!boundary) return boundary.error();
    for (const measure::Pieces& list : boundary->pieces) walls.undecided_ += list.undecided_spheres;
    std::vector<std::int64_t> owners;
    for (const measure::Pieces& list : boundary->pieces)
      owners.insert(owners.end(), list.owner.begin(), list.owner.end());
    std::vector<std::int64_t> surface_of_piece;
    const std::vector<Surface> surfaces =
        measure::surfaces_of(counted.balls, std::nullopt, std::move(boundary->pieces), &surface_of_piece);
    const double unit = set.scale();
    const std::vector<std::int32_t> numbers =
        numbers_of_cavities(surfaces, measures->volume_error * unit * unit * unit);
    walls.cavities_ = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());

    // The pieces of a ball follow each other.
    walls.cavity_of_sphere_.assign(static_cast<std::size_t>(set.size()), 0);
    std::map<std::int64_t, std::vector<std::uint8_t>> pieces_of_mixed;
    for (std::size_t p = 0, end = 0; p < owners.size(); p = end) {
      std::int32_t& cavity = walls.cavity_of_sphere_[counted.ids[owners[p]]];
      std::vector<std::uint8_t> is_wall;
      for (end = p; end < owners.size() && owners[end] == owners[p]; ++end) {
        const std::int32_t number = numbers[surface_of_piece[end]];
        is_wall.push_back(number > 0 ? 1 : 0);
        if (number > 0 && (cavity == 0 || number < cavity)) cavity = number;
      }
      if (cavity > 0 && std::count(is_wall.begin(), is_wall.end(), std::uint8_t{0}) > 0)
        pieces_of_mixed.emplace(owners[p], std::move(is_wall));
    }
    for (std::vector<measure::OwnedArcs>& chunk : boundary->arcs)
      for (measure::OwnedArcs& own : chunk)
        if (const auto mixed = pieces_of_mixed.find(own.ball); mixed != pieces_of_mixed.end())
          walls.mixed_.emplace(counted.ids[own.ball], Mixed{std::move(own.arcs), std::move(mixed->second)});
    return walls;
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for("the cavities of " + std::to_string(set.size()) + " spheres");
  }
}

bool CavityWalls::is_wall(std::int64_t id, Vec3d direction) const {
  if (cavity_of_sphere_[static_cast<std::size_t>(id)] == 0) return false;
  const auto mixed = mixed_.find(id);
  return mixed == mixed_.end() ||
         mixed->second.is_wall[static_cast<std::size_t>(mixed->second.arcs.piece_of(direction))] != 0;
}

}  // namespace bihive
