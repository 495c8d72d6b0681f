// Chooses the order of a call's rays, and the traversal that answers them. A traversal returns the rays that it is not
// made for; the next pass answers those. No pass calls an earlier one:
//
//   closest hits   blocks: beams -> the remaining ones: lists
//                  any:    scattered? in the order of cells: lists; else lists
//   occluded       blocks: beams -> the remaining ones: as any
//                  any:    to one light? in that order: beams -> the remaining ones: lists
//                          else scattered? in the order of cells: lists
//                          else lists
//   all hits       beams -> the remaining ones, by the sphere that they exit: beams -> the rest: lists
//                  without such spheres: beams -> the remaining ones, in the order of cells if scattered: lists
//   depths         beams -> the remaining ones, by the sphere that they exit: beams -> the rest: scalar traversal
//
// Lists answer all rays that beams do not take at all (beams_take()). Where spheres lie inside others, closest and any
// hit trace the outer tree first, and then the whole tree with the rays that may reach a core (schedule/core_rays.h).
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/wide/optical_depths.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/schedule/cell_order.h"
#include "bihive/wide/schedule/core_rays.h"
#include "bihive/wide/schedule/light_order.h"
#include "bihive/wide/schedule/reordered_batch.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/trace/beams.h"
#include "bihive/wide/trace/lists.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/trace/single_ray.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/tree/duplicates.h"

namespace bihive {
namespace wide {
namespace {

// Each thread keeps it between calls.
struct Memory {
  CellOrder by_cell;
  LightOrder by_light;
  ReorderedBatch sorted, remaining_of_blocks, remaining_of_sorted, to_cores;
};

Memory& memory_of_this_thread() {
  thread_local const std::unique_ptr<Memory> memory(new Memory);
  return *memory;  // NOLINT(clang-analyzer-cplusplus.NewDelete): it takes the memory for freed at once
}

// Calls body(first, count) for consecutive pieces of `total`, each of at most `at_a_time`.
template <class Body>
void for_some(std::int64_t total, std::int64_t at_a_time, const Body& body) {
  for (std::int64_t first = 0; first < total; first += at_a_time) body(first, std::min(at_a_time, total - first));
}

// Sorts rays by cells, many at a time. Calls answer(batch, some, from, first) for one tile after the other: `some` are
// the rays of the batch from number `from` on, and the batch holds rays of the span from number `first` on. Tiles are
// small, so that answers are scattered back while they are in the cache.
template <class Answer>
void in_cell_order(const WideTree& tree, const RaySpan& rays, const Answer& answer) {
  Memory& memory = memory_of_this_thread();
  ReorderedBatch& batch = memory.sorted;
  for_some(rays.count, kScatteredAtATime, [&](std::int64_t first, std::int64_t count) {
    const RaySpan unsorted = rays.part(first, count);
    memory.by_cell.find(tree, unsorted, batch.order());
    batch.gather(unsorted);
    for_some(count, kTileRays,
             [&](std::int64_t from, std::int64_t n) { answer(batch, batch.rays().part(from, n), from, first); });
  });
}

// Handles the rays that remain after a traversal. Long runs go to in_place(first, count); the others are gathered in
// `batch`, and gathered() is called whenever it is full.
template <class InPlace, class Gathered>
void for_remaining(const RaySpan& rays, const RemainingRays& remaining, ReorderedBatch& batch, const InPlace& in_place,
                   const Gathered& gathered) {
  std::vector<std::uint32_t>& order = batch.order();
  order.clear();
  const auto finish = [&] {
    if (order.empty()) return;
    batch.gather(rays);
    gathered();
    order.clear();
  };
  for (const RemainingRays::Run& run : remaining.runs()) {
    if (run.count >= kLongRun) {
      in_place(run.first, run.count);
      continue;
    }
    if (static_cast<std::int64_t>(order.size()) + run.count > kRemainingAtATime) finish();
    for (std::int64_t i = 0; i < run.count; ++i) order.push_back(static_cast<std::uint32_t>(run.first + i));
  }
  finish();
}

// ---- Closest hits ----

void closest_hits_by_cell(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  in_cell_order(tree, rays, [&](ReorderedBatch& batch, const RaySpan& some, std::int64_t from, std::int64_t first) {
    closest_hits_by_lists(tree, some, batch.hits(some.count));
    batch.put_back(from, some.count, hits.part(first));
  });
}

void closest_hits_in_any_order(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  if (scattered(tree, rays)) {
    closest_hits_by_cell(tree, rays, hits);
  } else {
    closest_hits_by_lists(tree, rays, hits);
  }
}

void closest_hits_in_blocks(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  if (!beams_take(tree, rays)) return closest_hits_by_lists(tree, rays, hits);
  const RemainingRays remaining = closest_hits_by_beams(tree, rays, hits);
  if (remaining.count() == 0) return;
  ReorderedBatch& batch = memory_of_this_thread().remaining_of_blocks;
  for_remaining(
      rays, remaining, batch,
      [&](std::int64_t first, std::int64_t count) {
        closest_hits_by_lists(tree, rays.part(first, count), hits.part(first));
      },
      [&] {
        const RaySpan some = batch.rays();
        closest_hits_by_lists(tree, some, batch.hits(some.count));
        batch.put_back(0, some.count, hits);
      });
}

void closest_hits_of_tree(const WideTree& tree, const RaySpan& rays, RayOrder order, const HitSpan& hits) {
  if (order == RayOrder::blocks) {
    closest_hits_in_blocks(tree, rays, hits);
  } else {
    closest_hits_in_any_order(tree, rays, hits);
  }
}

// The answers of the outer tree become those of the whole tree.
void closest_hits_in_cores(const WideTree& tree, const RaySpan& rays, RayOrder order, const HitSpan& hits) {
  ReorderedBatch& batch = memory_of_this_thread().to_cores;
  for_remaining(
      rays, rays_to_cores(tree, rays, hits.t, nullptr), batch,
      [&](std::int64_t first, std::int64_t count) {
        closest_hits_of_tree(tree, rays.part(first, count), order, hits.part(first));
      },
      [&] {
        const RaySpan some = batch.rays();
        closest_hits_of_tree(tree, some, order, batch.hits(some.count));
        batch.put_back(0, some.count, hits);
      });
}

// ---- Any hit ----

using Occluded = void (*)(const WideTree&, const RaySpan&, std::uint8_t*);

// The rays that remain, answered by `answer`; `batch` holds copies of them.
void occluded_remaining(const WideTree& tree, const RaySpan& rays, const RemainingRays& remaining,
                        ReorderedBatch& batch, Occluded answer, std::uint8_t* hidden) {
  for_remaining(
      rays, remaining, batch,
      [&](std::int64_t first, std::int64_t count) { answer(tree, rays.part(first, count), hidden + first); },
      [&] {
        const RaySpan some = batch.rays();
        answer(tree, some, batch.hidden(some.count));
        batch.put_back(0, some.count, hidden);
      });
}

void occluded_by_cell(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  in_cell_order(tree, rays, [&](ReorderedBatch& batch, const RaySpan& some, std::int64_t from, std::int64_t first) {
    occluded_by_lists(tree, some, batch.hidden(some.count));
    batch.put_back(from, some.count, hidden + first);
  });
}

// Do beams pay? No if most of the `tried` rays remain, or if the beams met many spheres.
bool beams_pay(const SortedBeams& trial, std::int64_t tried) {
  const std::int64_t answered = tried - trial.remaining.count();
  return trial.remaining.count() <= tried / 2 && trial.spheres_met <= answered * kMostSpheresMet;
}

// Sorted beams, or lists for rays that do not suit beams.
void occluded_to_light(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  Memory& memory = memory_of_this_thread();
  ReorderedBatch& batch = memory.sorted;
  if (!beams_take(tree, rays) || !memory.by_light.find(tree, rays, batch.order()))
    return occluded_by_lists(tree, rays, hidden);
  batch.gather(rays);
  const RaySpan sorted = batch.rays();
  std::uint8_t* const sorted_hidden = batch.hidden(rays.count);

  // Try some evenly spread blocks. If beams do not pay, lists do best with all rays in the caller's order.
  const std::int64_t blocks = (rays.count + kBeamRays - 1) / kBeamRays;
  const std::int64_t step = std::max(kBlocksPerTrial, blocks / kSortedTrialBlocks);
  SortedBeams trial = occluded_by_sorted_beams(tree, sorted, {step, false}, sorted_hidden);
  if (!beams_pay(trial, (blocks + step - 1) / step * kBeamRays)) return occluded_by_lists(tree, rays, hidden);
  const SortedBeams rest = occluded_by_sorted_beams(tree, sorted, {step, true}, sorted_hidden);
  for (const RemainingRays::Run& run : rest.remaining.runs()) trial.remaining.add(run.first, run.count);
  occluded_remaining(tree, sorted, trial.remaining, memory.remaining_of_sorted, occluded_by_lists, sorted_hidden);
  batch.put_back(0, rays.count, hidden);
}

void occluded_in_any_order(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  if (converge(rays)) {
    for_some(rays.count, kToLightAtATime, [&](std::int64_t first, std::int64_t count) {
      occluded_to_light(tree, rays.part(first, count), hidden + first);
    });
  } else if (scattered(tree, rays)) {
    occluded_by_cell(tree, rays, hidden);
  } else {
    occluded_by_lists(tree, rays, hidden);
  }
}

void occluded_in_blocks(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  if (!beams_take(tree, rays)) return occluded_by_lists(tree, rays, hidden);
  const RemainingRays remaining = occluded_by_beams(tree, rays, hidden);
  if (remaining.count() == 0) return;
  occluded_remaining(tree, rays, remaining, memory_of_this_thread().remaining_of_blocks, occluded_in_any_order, hidden);
}

void occluded_of_tree(const WideTree& tree, const RaySpan& rays, RayOrder order, std::uint8_t* hidden) {
  if (order == RayOrder::blocks) {
    occluded_in_blocks(tree, rays, hidden);
  } else {
    occluded_in_any_order(tree, rays, hidden);
  }
}

// ---- All hits ----

// Nothing lies between the start and the end of the ray.
bool is_empty(const RaySpan& rays, std::int64_t i) {
  return rays.t_max != nullptr && rays.t_max[i] < (rays.t_min != nullptr ? rays.t_min[i] : 0);
}

// Rays that are not neighbours may still start on the same spheres, as with many layers of surfaces: in this order
// beams take most of them. False: all are empty.
bool gather_by_left_sphere(const RaySpan& rays, const RemainingRays& which, ReorderedBatch& batch) {
  std::vector<std::uint32_t>& order = batch.order();
  order.clear();
  for (const RemainingRays::Run& run : which.runs())
    for (std::int64_t i = run.first; i < run.first + run.count; ++i)
      if (!is_empty(rays, i)) order.push_back(static_cast<std::uint32_t>(i));
  if (order.empty()) return false;
  if (rays.leaves != nullptr)
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rays.leaves[a] < rays.leaves[b]; });
  batch.gather(rays);
  return true;
}

// Turns the numbers of hits from number `known` on, which count among the rays of a batch from number `from` on, into
// those of the span.
void number_in_span(const ReorderedBatch& batch, std::int64_t from, std::int64_t first, std::size_t known,
                    std::vector<RayHit>& hits) {
  for (std::size_t i = known; i < hits.size(); ++i)
    hits[i].ray = first + batch.order()[static_cast<std::size_t>(from + hits[i].ray)];
}

void all_hits_by_cell(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits) {
  in_cell_order(tree, rays, [&](ReorderedBatch& batch, const RaySpan& some, std::int64_t from, std::int64_t first) {
    const std::size_t known = hits.size();
    all_hits_by_lists(tree, some, hits);
    number_in_span(batch, from, first, known, hits);
  });
}

void all_hits_by_left_sphere(const WideTree& tree, const RaySpan& rays, const RemainingRays& which,
                             std::vector<RayHit>& hits) {
  Memory& memory = memory_of_this_thread();
  ReorderedBatch& batch = memory.sorted;
  if (!gather_by_left_sphere(rays, which, batch)) return;
  const RaySpan sorted = batch.rays();
  const std::size_t known = hits.size();
  const RemainingRays remaining = all_hits_by_beams(tree, sorted, hits);
  if (remaining.count() > 0) {
    ReorderedBatch& rest = memory.remaining_of_sorted;
    for_remaining(
        sorted, remaining, rest,
        [&](std::int64_t first, std::int64_t count) {
          const std::size_t before = hits.size();
          all_hits_by_lists(tree, sorted.part(first, count), hits);
          for (std::size_t i = before; i < hits.size(); ++i) hits[i].ray += first;
        },
        [&] {
          const std::size_t before = hits.size();
          all_hits_by_lists(tree, rest.rays(), hits);
          number_in_span(rest, 0, 0, before, hits);
        });
  }
  number_in_span(batch, 0, 0, known, hits);
}

void all_hits_in_any_order(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits) {
  if (!beams_take(tree, rays)) return all_hits_by_lists(tree, rays, hits);
  const RemainingRays remaining = all_hits_by_beams(tree, rays, hits);
  if (remaining.count() == 0) return;
  if (rays.leaves != nullptr) return all_hits_by_left_sphere(tree, rays, remaining, hits);
  // Beams give up early where rays are not neighbours, so that one long run remains.
  ReorderedBatch& batch = memory_of_this_thread().remaining_of_blocks;
  for_remaining(
      rays, remaining, batch,
      [&](std::int64_t first, std::int64_t count) {
        const RaySpan some = rays.part(first, count);
        const std::size_t before = hits.size();
        if (scattered(tree, some))
          all_hits_by_cell(tree, some, hits);
        else
          all_hits_by_lists(tree, some, hits);
        for (std::size_t i = before; i < hits.size(); ++i) hits[i].ray += first;
      },
      [&] {
        const std::size_t before = hits.size();
        all_hits_by_lists(tree, batch.rays(), hits);
        number_in_span(batch, 0, 0, before, hits);
      });
}

// ---- Optical depths ----

void depths_of_ray(const WideTree& tree, const RaySpan& rays, std::int64_t i, const SphereDepths& depths,
                   const DepthSums& sums) {
  for_hits_of_ray(tree, rays.at(i), [&](double, std::int64_t id) {
    sums.add(i, depths.row(id), depths.columns);
    for_duplicates(tree, id, [&](std::int64_t other) { sums.add(i, depths.row(other), depths.columns); });
  });
}

void depths_by_left_sphere(const WideTree& tree, const RaySpan& rays, const RemainingRays& which,
                           const SphereDepths& depths, const DepthSums& sums) {
  ReorderedBatch& batch = memory_of_this_thread().sorted;
  if (!gather_by_left_sphere(rays, which, batch)) return;
  const std::vector<std::uint32_t>& order = batch.order();
  thread_local std::vector<OpticalDepth> of_batch;
  of_batch.assign(order.size() * static_cast<std::size_t>(depths.columns), 0);
  DepthSums here;
  for (int c = 0; c < depths.columns; ++c) here.columns[c] = of_batch.data() + c * order.size();
  const RemainingRays remaining = depths_by_beams(tree, batch.rays(), true, depths, here);
  for (int c = 0; c < depths.columns; ++c)
    for (std::size_t i = 0; i < order.size(); ++i) sums.columns[c][order[i]] = here.columns[c][i];
  for (const RemainingRays::Run& run : remaining.runs())
    for (std::int64_t i = run.first; i < run.first + run.count; ++i)
      depths_of_ray(tree, rays, order[static_cast<std::size_t>(i)], depths, sums);
}

// Counting sort by ray; then the few hits of each ray are sorted by t and id. They are appended, their rays counted
// from `first_ray` on.
void append_sorted(std::int64_t rays, std::int64_t first_ray, const std::vector<RayHit>& hits,
                   std::vector<RayHit>& sorted) {
  std::vector<std::size_t> next(static_cast<std::size_t>(rays) + 1, 0);
  auto look = [looked = std::int64_t{0}](std::int64_t more) mutable {
    if ((looked += more) < kHitsBetweenLooks) return;
    looked = 0;
    stop_chunk_if_cancelled();
  };
  for (const RayHit& hit : hits) ++next[static_cast<std::size_t>(hit.ray) + 1];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  const std::size_t known = sorted.size();
  sorted.resize(known + hits.size());
  const auto place_of = [&](const RayHit& hit) -> std::size_t& { return next[static_cast<std::size_t>(hit.ray)]; };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (i + kHitsAhead < hits.size()) __builtin_prefetch(sorted.data() + known + place_of(hits[i + kHitsAhead]), 1);
    sorted[known + place_of(hits[i])++] = {first_ray + hits[i].ray, hits[i].t, hits[i].sphere_id};
  }
  stop_chunk_if_cancelled();
  // Now `next` holds the end of each ray's hits.
  std::size_t begin = 0;
  for (std::size_t ray = 0; ray + 1 < next.size(); begin = next[ray], ++ray) {
    const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(known + begin);
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(known + next[ray]);
    look(last - first);
    std::sort(first, last,
              [](const RayHit& a, const RayHit& b) { return a.t != b.t ? a.t < b.t : a.sphere_id < b.sphere_id; });
  }
}

}  // namespace
}  // namespace wide

void all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits) {
  static thread_local std::vector<RayHit> found;
  hits.clear();
  wide::for_some(rays.count, wide::kMostRaysOfHits, [&](std::int64_t first, std::int64_t count) {
    found.clear();
    wide::all_hits_in_any_order(tree, rays.part(first, count), found);
    add_duplicates(tree, 0, found);
    wide::append_sorted(count, first, found, hits);
  });
}

void optical_depths(const WideTree& tree, const RaySpan& rays, const SphereDepths& depths, const DepthSums& sums) {
  sums.clear(rays.count, depths.columns);
  if (!wide::beams_take(tree, rays)) {
    for (std::int64_t i = 0; i < rays.count; ++i) wide::depths_of_ray(tree, rays, i, depths, sums);
    return;
  }
  const RemainingRays remaining = wide::depths_by_beams(tree, rays, false, depths, sums);
  if (remaining.count() > 0) wide::depths_by_left_sphere(tree, rays, remaining, depths, sums);
}

void closest_hits(const WideTree& tree, const RaySpan& rays, RayOrder order, const HitSpan& hits) {
  if (tree.outer == nullptr) return wide::closest_hits_of_tree(tree, rays, order, hits);
  wide::closest_hits_of_tree(tree.outer->tree, rays, order, hits);
  wide::closest_hits_in_cores(tree, rays, order, hits);
}

void occluded(const WideTree& tree, const RaySpan& rays, RayOrder order, std::uint8_t* hidden) {
  if (tree.outer == nullptr) return wide::occluded_of_tree(tree, rays, order, hidden);
  wide::occluded_of_tree(tree.outer->tree, rays, order, hidden);
  wide::occluded_remaining(
      tree, rays, wide::rays_to_cores(tree, rays, nullptr, hidden), wide::memory_of_this_thread().to_cores,
      [](const WideTree& whole, const RaySpan& some, std::uint8_t* of_some) {
        wide::occluded_in_any_order(whole, some, of_some);
      },
      hidden);
}

Hit closest_hit(const WideTree& tree, const Ray& ray) {
  if (tree.outer == nullptr) return wide::closest_hit_of_ray(tree, ray);
  const Hit hit = wide::closest_hit_of_ray(tree.outer->tree, ray);
  return wide::may_reach_core(tree, ray, hit.t) ? wide::closest_hit_of_ray(tree, ray) : hit;
}

bool occluded(const WideTree& tree, const Ray& ray) {
  if (tree.outer == nullptr) return wide::ray_occluded(tree, ray);
  return wide::ray_occluded(tree.outer->tree, ray) ||
         (wide::may_reach_core(tree, ray, ray.t_max) && wide::ray_occluded(tree, ray));
}

}  // namespace bihive
