#include "bihive/wide/schedule/leftover_rays.h"

#include <algorithm>

#include "bihive/wide/schedule/any_rays.h"
#include "bihive/wide/trace/lists.h"

namespace bihive {
namespace {

// Runs of at least this many rays are answered where they lie, shorter ones are copied into a tile of kTile.
constexpr std::int64_t kLongRun = 4096;
constexpr std::int64_t kTile = 16384;

// A tile of copied rays, and their answers.
struct Tile {
  RayBatch rays;
  HitBatch hits;
  std::vector<std::uint8_t> hidden;

  void begin() { rays.clear(); }

  void add(const RaySpan& from, std::int64_t first, std::int64_t count) {
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis].insert(rays.origin[axis].end(), from.origin[axis] + first, from.origin[axis] + first + count);
      rays.direction[axis].insert(rays.direction[axis].end(), from.direction[axis] + first,
                                  from.direction[axis] + first + count);
    }
    const auto append = [&](auto& to, const auto* values) {
      if (values != nullptr) to.insert(to.end(), values + first, values + first + count);
    };
    append(rays.t_min, from.t_min);
    append(rays.t_max, from.t_max);
    append(rays.leaves, from.leaves);
    append(rays.inside, from.inside);
  }
};

// While a tile is answered, some of its rays can be left over once more.
Tile& tile_of_thread(bool again = false) {
  static thread_local Tile tiles[2];
  return tiles[again ? 1 : 0];
}

}  // namespace

float leaf_extent(const WideTree& tree) {
  constexpr std::int64_t kSamples = 8;
  float sum = 0;
  int count = 0;
  const std::int64_t step = std::max<std::int64_t>(1, tree.node_count / kSamples);
  for (std::int64_t i = tree.node_count - 1; i >= 0; i -= step) {
    const WideNode& node = tree.nodes[i];
    for (int slot = 0; slot < node.child_count; ++slot) {
      if (!node.is_leaf(slot)) continue;
      float extent = 0;
      for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, node.hi[axis][slot] - node.lo[axis][slot]);
      sum += extent;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 0;
}

template <class Tile, class Direct, class Copied>
void LeftoverRays::in_tiles(Tile& tile, const Direct& direct, const Copied& copied) const {
  tile.begin();
  std::vector<Run> in_tile;
  const auto finish = [&] {
    if (!in_tile.empty()) copied(in_tile);
    in_tile.clear();
    tile.begin();
  };
  for (const Run& run : runs_) {
    if (run.count >= kLongRun) {
      direct(run);
      continue;
    }
    if (tile.rays.size() + run.count > kTile) finish();
    tile.add(rays_, run.first, run.count);
    in_tile.push_back(run);
  }
  finish();
}

void LeftoverRays::closest_hits(const WideTree& tree, const HitSpan& hits) const {
  Tile& tile = tile_of_thread();
  in_tiles(
      tile,
      [&](const Run& run) {
        kernels::closest_hits_lists(tree, rays_.part(run.first, run.count), hits.part(run.first));
      },
      [&](const std::vector<Run>& runs) {
        tile.hits.resize(tile.rays.size());
        kernels::closest_hits_lists(tree, tile.rays.span(), tile.hits.span());
        std::int64_t from = 0;
        for (const Run& run : runs) {
          std::copy_n(tile.hits.t.data() + from, run.count, hits.t + run.first);
          std::copy_n(tile.hits.sphere_id.data() + from, run.count, hits.sphere_id + run.first);
          from += run.count;
        }
      });
}

void LeftoverRays::occluded(const WideTree& tree, bool sorted, std::uint8_t* hidden) const {
  const auto answer = sorted ? kernels::occluded_lists : kernels::occluded_any;
  Tile& tile = tile_of_thread(sorted);
  in_tiles(
      tile, [&](const Run& run) { answer(tree, rays_.part(run.first, run.count), hidden + run.first); },
      [&](const std::vector<Run>& runs) {
        tile.hidden.resize(static_cast<std::size_t>(tile.rays.size()));
        answer(tree, tile.rays.span(), tile.hidden.data());
        std::int64_t from = 0;
        for (const Run& run : runs) {
          std::copy_n(tile.hidden.data() + from, run.count, hidden + run.first);
          from += run.count;
        }
      });
}

}  // namespace bihive
