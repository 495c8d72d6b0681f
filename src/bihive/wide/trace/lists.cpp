#include "bihive/wide/trace/lists.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/simd/dispatch.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/list_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void walk_closest(const WideTree& tree, const RaySpan& rays, ListTile& tile, const HitSpan& hits) {
  std::fill_n(hits.t, rays.count, std::numeric_limits<double>::infinity());
  std::fill_n(hits.sphere_id, rays.count, kNothing);
  if (tree.node_count == 0) return;
  ListWalk<ListSought::closest_hit>(tree, rays, tile, {.hits = hits}).run();
}

void walk_occluded(const WideTree& tree, const RaySpan& rays, ListTile& tile, std::uint8_t* hidden) {
  std::fill_n(hidden, rays.count, std::uint8_t{0});
  if (tree.node_count == 0) return;
  ListWalk<ListSought::any_hit>(tree, rays, tile, {.hidden = hidden}).run();
}

void walk_all_hits(const WideTree& tree, const RaySpan& rays, ListTile& tile, std::vector<RayHit>& found) {
  if (tree.node_count == 0) return;
  ListWalk<ListSought::all_hits>(tree, rays, tile, {.found = &found}).run();
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(walk_closest);
HWY_EXPORT(walk_occluded);
HWY_EXPORT(walk_all_hits);

namespace wide {
namespace {

ListTile& tile_of_this_thread() {
  thread_local const std::unique_ptr<ListTile> tile(new ListTile);
  return *tile;  // NOLINT(clang-analyzer-cplusplus.NewDelete): it takes the tile for freed at once
}

// Calls body(first, count) for each tile.
template <class Body>
void for_each_tile(std::int64_t rays, const Body& body) {
  for (std::int64_t first = 0; first < rays; first += kTileRays) {
    stop_chunk_if_cancelled();
    body(first, std::min<std::int64_t>(kTileRays, rays - first));
  }
}

}  // namespace

void closest_hits_by_lists(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  ensure_target();
  ListTile& tile = tile_of_this_thread();
  for_each_tile(rays.count, [&](std::int64_t first, std::int64_t count) {
    HWY_DYNAMIC_DISPATCH(walk_closest)(tree, rays.part(first, count), tile, hits.part(first));
  });
}

void occluded_by_lists(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  ensure_target();
  ListTile& tile = tile_of_this_thread();
  for_each_tile(rays.count, [&](std::int64_t first, std::int64_t count) {
    HWY_DYNAMIC_DISPATCH(walk_occluded)(tree, rays.part(first, count), tile, hidden + first);
  });
}

void all_hits_by_lists(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& found) {
  ensure_target();
  ListTile& tile = tile_of_this_thread();
  for_each_tile(rays.count, [&](std::int64_t first, std::int64_t count) {
    const std::size_t known = found.size();
    HWY_DYNAMIC_DISPATCH(walk_all_hits)(tree, rays.part(first, count), tile, found);
    for (std::size_t i = known; i < found.size(); ++i) found[i].ray += first;
  });
}

}  // namespace wide
}  // namespace bihive
#endif
