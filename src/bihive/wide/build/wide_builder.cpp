#include "bihive/wide/wide_builder.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/memory.h"
#include "bihive/base/parallel.h"
#include "bihive/base/readable.h"
#include "bihive/base/watch.h"
#include "bihive/simd/dispatch.h"
#include "bihive/wide/build/collapse.h"
#include "bihive/wide/build/count_limit.h"
#include "bihive/wide/build/enclosed.h"
#include "bihive/wide/build/repeated.h"
#include "bihive/wide/build/split.h"
#include "bihive/wide/build/tuning.h"
#include "bihive/wide/tree/left_sphere.h"

namespace bihive {
namespace {

// Padding after the last sphere: outside of everything, and never hit.
constexpr float kFarAway = 0x1p30F;

struct Chunks {
  std::int64_t count, size, total;

  explicit Chunks(std::int64_t spheres) : total(spheres) {
    size = std::max(kChunkSpheres, (spheres + kMostChunks - 1) / kMostChunks);
    count = (spheres + size - 1) / size;
  }
  std::int64_t begin(std::int64_t chunk) const { return chunk * size; }
  std::int64_t end(std::int64_t chunk) const { return std::min(total, (chunk + 1) * size); }
};

// Consecutive arrays: four with a palette, else five, each aligned to a cache line.
SphereArrays place_arrays(std::int64_t spheres, bool has_palette, AlignedBuffer& memory) {
  const auto padded = static_cast<std::size_t>(spheres + kWidth);
  const std::size_t an_array = (padded * sizeof(float) + 63) / 64 * 64;
  memory.reserve(an_array * (has_palette ? 4 : 5));
  auto* const bytes = static_cast<std::byte*>(memory.data());
  SphereArrays arrays;
  arrays.x = reinterpret_cast<float*>(bytes);
  arrays.y = reinterpret_cast<float*>(bytes + an_array);
  arrays.z = reinterpret_cast<float*>(bytes + 2 * an_array);
  arrays.word = reinterpret_cast<std::uint32_t*>(bytes + 3 * an_array);
  if (!has_palette) arrays.r = reinterpret_cast<float*>(bytes + 4 * an_array);
  return arrays;
}

void pad(const SphereArrays& arrays, std::int64_t spheres) {
  for (std::int64_t i = spheres; i < spheres + kWidth; ++i) {
    arrays.x[i] = arrays.y[i] = arrays.z[i] = kFarAway;
    arrays.word[i] = ~std::uint32_t{0};  // class 31, radius 0
    if (arrays.r != nullptr) arrays.r[i] = 0;
  }
}

}  // namespace

// Working memory, and a tree that nobody holds any more, whose memory the next build reuses.
struct WideBuilder::State {
  std::mutex mutex;
  std::unique_ptr<WideTree> spare;

  AlignedBuffer sphere_memory;
  NodeArena arena;
  Collapse collapse;
  std::vector<std::uint16_t> cells;
  std::vector<std::uint32_t> cell_counts;

  std::unique_ptr<WideTree> take_spare() {
    const std::lock_guard lock(mutex);
    if (spare != nullptr) return std::move(spare);
    return std::make_unique<WideTree>();
  }
  void give_back(std::unique_ptr<WideTree> tree) {
    const std::lock_guard lock(mutex);
    if (spare == nullptr || spare->allocated_bytes() < tree->allocated_bytes()) std::swap(spare, tree);
  }

  InputSummary summarize(const SphereSet& spheres, const Chunks& chunks, int threads) const;
  void split(const SphereSet& spheres, const InputSummary& summary, SplitContext& context, BinaryNode& root,
             int threads);
  void sort_into_cells(const SphereSet& spheres, const CellGrid& grid, SplitContext& context, int threads,
                       std::vector<std::int64_t>& begins);
  std::vector<SplitRange> split_cells(const CellGrid& grid, const std::vector<std::int64_t>& begins,
                                      std::int64_t most_spheres, BinaryNode& root);
  std::vector<EqualSphere> build_all(const SphereSet& spheres, const WideParameters& parameters, int threads,
                                     std::int64_t most_ids, WideTree& tree, WatchedWork& work);
  void build_part(const SphereSet& spheres, const std::vector<std::int64_t>& ids, const WideParameters& parameters,
                  int threads, WideTree& tree, WatchedWork& work);
  std::vector<EqualSphere> build_without_others(const SphereSet& spheres, const WideParameters& parameters, int threads,
                                                WideTree& tree, WatchedWork& work);
  void build(const SphereSet& spheres, const WideParameters& parameters, int threads, WideTree& tree,
             WatchedWork& work);
};

InputSummary WideBuilder::State::summarize(const SphereSet& spheres, const Chunks& chunks, int threads) const {
  std::vector<InputSummary> summaries(static_cast<std::size_t>(chunks.count));
  parallel_for(threads, chunks.count, [&](std::int64_t i) {
    summaries[static_cast<std::size_t>(i)] = wide::summarize(spheres, chunks.begin(i), chunks.end(i));
  });
  InputSummary all = summaries[0];
  for (std::size_t i = 1; i < summaries.size(); ++i) all.add(summaries[i]);
  return all;
}

// Puts the spheres into the scratch arrays cell by cell, in each cell by id. begins[c] is the first position of cell c.
void WideBuilder::State::sort_into_cells(const SphereSet& spheres, const CellGrid& grid, SplitContext& context,
                                         int threads, std::vector<std::int64_t>& begins) {
  const Chunks chunks(spheres.size());
  cells.resize(static_cast<std::size_t>(spheres.size()));
  cell_counts.assign(static_cast<std::size_t>(chunks.count * CellGrid::kCells), 0);
  const auto counts_of = [&](std::int64_t chunk) { return cell_counts.data() + chunk * CellGrid::kCells; };
  parallel_for(threads, chunks.count, [&](std::int64_t i) {
    wide::find_cells(spheres, chunks.begin(i), chunks.end(i), grid, cells.data() + chunks.begin(i), counts_of(i));
  });

  // Turn counts into the first position of each cell and chunk.
  begins.assign(CellGrid::kCells + 1, 0);
  std::uint32_t next = 0;
  for (int cell = 0; cell < CellGrid::kCells; ++cell) {
    begins[static_cast<std::size_t>(cell)] = next;
    for (std::int64_t i = 0; i < chunks.count; ++i) {
      const std::uint32_t here = counts_of(i)[cell];
      counts_of(i)[cell] = next;
      next += here;
    }
  }
  begins[CellGrid::kCells] = next;
  parallel_for(threads, chunks.count, [&](std::int64_t i) {
    wide::scatter_spheres(spheres, chunks.begin(i), chunks.end(i), cells.data() + chunks.begin(i), counts_of(i),
                          context);
  });
}

// Builds the splits at the top of the tree from cells: the bits of a cell's number are the splits. Returns the ranges
// below them, without their boxes.
std::vector<SplitRange> WideBuilder::State::split_cells(const CellGrid& grid, const std::vector<std::int64_t>& begins,
                                                        std::int64_t most_spheres, BinaryNode& root) {
  // Cells first to last - 1, and the next halving.
  struct CellRange {
    BinaryNode* node;
    int first, last, halving, depth;
  };
  const auto begin_of = [&](int cell) { return begins[static_cast<std::size_t>(cell)]; };
  SplitSource source(arena);
  std::vector<CellRange> waiting{{&root, 0, CellGrid::kCells, 0, 0}};
  std::vector<SplitRange> ranges;
  while (!waiting.empty()) {
    CellRange here = waiting.back();
    waiting.pop_back();
    const std::int64_t first = begin_of(here.first);
    const std::int64_t count = begin_of(here.last) - first;

    // Skip halves without spheres.
    int middle = 0;
    bool split = false;
    while (!split && here.halving < CellGrid::kBits && count > most_spheres) {
      middle = (here.first + here.last) / 2;
      const std::int64_t left = begin_of(middle) - first;
      split = left > 0 && left < count;
      if (left == 0) here.first = middle;
      if (left == count) here.last = middle;
      ++here.halving;
    }
    if (!split) {
      SplitRange range;
      range.node = here.node;
      range.first = first;
      range.count = count;
      range.depth = here.depth;
      ranges.push_back(range);
      continue;
    }
    BinaryNode& node = *here.node;
    node.count = static_cast<std::uint32_t>(count);
    node.axis = static_cast<std::uint32_t>(grid.axis[here.halving - 1]);
    node.split = source.next();
    waiting.push_back({&node.split->side[0], here.first, middle, here.halving, here.depth + 1});
    waiting.push_back({&node.split->side[1], middle, here.last, here.halving, here.depth + 1});
  }
  return ranges;
}

void WideBuilder::State::split(const SphereSet& spheres, const InputSummary& summary, SplitContext& context,
                               BinaryNode& root, int threads) {
  const std::int64_t count = spheres.size();
  if (count <= std::max(kGridSpheres, context.full_leaf)) {
    // Take the spheres in their order.
    const Chunks chunks(count);
    parallel_for(threads, chunks.count,
                 [&](std::int64_t i) { wide::load_spheres(spheres, chunks.begin(i), chunks.end(i), context); });
    SplitRange range;
    range.node = &root;
    range.centres = summary.centres;
    range.count = count;
    parallel_tasks(threads, [&](TaskList& list) { wide::split_range(context, range, list); });
  } else {
    // Sort them into cells first.
    const CellGrid grid(summary.centres);
    std::vector<std::int64_t> begins;
    sort_into_cells(spheres, grid, context, threads, begins);
    context.work->stop_if_cancelled();
    const auto ranges = split_cells(grid, begins, std::max(kTaskSpheres, context.full_leaf), root);
    parallel_tasks(threads, [&](TaskList& list) {
      for (const SplitRange& range : ranges)
        list.add([&context, &list, range] {
          if (context.cancelled()) return;
          SplitRange bounded = range;
          bounded.centres = wide::bound_centres(context, range);
          wide::split_range(context, bounded, list);
        });
    });
  }
  if (context.out_of_memory) throw std::bad_alloc();
  context.work->stop_if_cancelled();
  wide::close_tops(root);
}

// Puts every sphere in a leaf. The ids need room for `most_ids` of them. Returns the equal spheres, in no order.
std::vector<EqualSphere> WideBuilder::State::build_all(const SphereSet& spheres, const WideParameters& parameters,
                                                       int threads, std::int64_t most_ids, WideTree& tree,
                                                       WatchedWork& work) {
  const std::int64_t count = spheres.size();
  tree.scale = spheres.scale();
  tree.origin = spheres.origin();
  tree.size = tree.placed = count;
  tree.piles.clear();
  tree.others_in_piles.clear();
  tree.aabb = {};
  tree.node_count = 0;
  tree.nodes = nullptr;
  tree.levels = 0;
  tree.largest_leaf = 0;
  tree.spheres = {};
  if (count == 0) return {};

  // Examine the spheres, and allocate their arrays.
  const InputSummary summary = summarize(spheres, Chunks(count), threads);
  work.stop_if_cancelled();
  const bool has_palette = !summary.palette.overflow && most_ids <= std::int64_t{WideSpheres::kIdMask};
  SplitContext context;
  context.work = &work;
  context.spheres = count;
  context.scratch = place_arrays(count, has_palette, sphere_memory);
  context.final = place_arrays(count, has_palette, tree.sphere_memory);
  context.largest_radius = summary.largest_radius;
  context.arena = &arena;
  CollapseParameters shape;
  if (parameters.max_prims > 0) context.full_leaf = parameters.max_prims;
  if (parameters.max_depth > 0)
    shape.most_levels = static_cast<int>(std::clamp<std::int64_t>(parameters.max_depth - 1, 1, kMostLevels));
  if (parameters.max_depth == 1) context.full_leaf = count;
  if (has_palette) std::copy(summary.palette.radius, summary.palette.radius + 32, context.palette);
  pad(context.scratch, count);
  pad(context.final, count);

  // Split in two, then collapse.
  arena.clear();
  BinaryNode root;
  split(spheres, summary, context, root, threads);
  collapse.run(root, shape, threads, work);

  // Keep the result, with spare room for a few more nodes in the next frame.
  const auto node_bytes = static_cast<std::size_t>(collapse.node_count()) * sizeof(WideNode);
  if (tree.node_memory.capacity() < node_bytes) tree.node_memory.reserve(node_bytes + node_bytes / 8);
  auto* const nodes = static_cast<WideNode*>(tree.node_memory.data());
  collapse.copy_to(nodes, threads);
  tree.aabb = root.box;
  tree.node_count = collapse.node_count();
  tree.nodes = nodes;
  tree.levels = collapse.levels();
  tree.largest_leaf = collapse.largest_leaf();
  WideSpheres& result = tree.spheres;
  result.x = context.final.x;
  result.y = context.final.y;
  result.z = context.final.z;
  result.r = context.final.r;
  result.word = context.final.word;
  result.has_palette = has_palette;
  result.palette_size = !has_palette ? 0 : summary.palette.has_zero ? 32 : summary.palette.size;
  std::copy(context.palette, context.palette + 32, result.palette.begin());
  return std::move(context.equal);
}

// Builds the tree of some spheres, ascending, under the ids of the whole set.
void WideBuilder::State::build_part(const SphereSet& spheres, const std::vector<std::int64_t>& ids,
                                    const WideParameters& parameters, int threads, WideTree& tree, WatchedWork& work) {
  build_all(spheres.part(ids), parameters, threads, spheres.size(), tree, work);
  const SphereArrays arrays = place_arrays(tree.placed, tree.spheres.has_palette, tree.sphere_memory);
  const std::uint32_t mask = tree.spheres.id_mask();
  for (std::int64_t slot = 0; slot < tree.placed; ++slot) {
    std::uint32_t& word = arrays.word[slot];
    word = (word & ~mask) | static_cast<std::uint32_t>(ids[word & mask]);
  }
  tree.size = spheres.size();
}

// Spheres that no plane separates lie in one leaf, and a ray would test all of them. So if more than a leaf's spheres
// are equal, the tree is built again with only the first of them. Returns all equal spheres, sorted.
std::vector<EqualSphere> WideBuilder::State::build_without_others(const SphereSet& spheres,
                                                                  const WideParameters& parameters, int threads,
                                                                  WideTree& tree, WatchedWork& work) {
  std::vector<EqualSphere> equal_in_set = build_all(spheres, parameters, threads, spheres.size(), tree, work);
  sort_equal(equal_in_set);
  find_piles(equal_in_set, tree.piles, tree.others_in_piles);
  if (tree.piles.empty()) return equal_in_set;
  std::vector<Pile> piles = std::move(tree.piles);
  std::vector<std::uint32_t> others = std::move(tree.others_in_piles);

  std::vector<std::uint32_t> left_out = others;
  std::sort(left_out.begin(), left_out.end());
  std::vector<std::int64_t> kept;
  kept.reserve(static_cast<std::size_t>(spheres.size()) - left_out.size());
  auto next = left_out.begin();
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    if (next != left_out.end() && *next == id)
      ++next;
    else
      kept.push_back(id);
  }
  // The new nodes are fewer, so the memory of the old ones is released first.
  collapse = Collapse();
  tree.node_memory = AlignedBuffer();
  build_part(spheres, kept, parameters, threads, tree, work);

  // Restore the tree's facts about all spheres.
  tree.piles = std::move(piles);
  tree.others_in_piles = std::move(others);
  return equal_in_set;
}

void WideBuilder::State::build(const SphereSet& spheres, const WideParameters& parameters, int threads, WideTree& tree,
                               WatchedWork& work) {
  tree.outer = nullptr;
  const std::vector<EqualSphere> equal_in_set = build_without_others(spheres, parameters, threads, tree, work);
  place_repeated(equal_in_set, tree);
  EnclosedSpheres enclosed = find_enclosed(tree);
  if (enclosed.cores.empty()) return;
  const auto outer = std::make_shared<OuterTree>();
  build_part(spheres, enclosed.others, parameters, threads, outer->tree, work);
  // A ray may exit an equal of an outer sphere.
  place_repeated(equal_in_set, outer->tree);
  build_all(spheres.part(enclosed.enclosing), {}, threads, spheres.size(), outer->around_cores, work);
  outer->cores = std::move(enclosed.cores);
  tree.outer = outer;
}

WideBuilder::WideBuilder() : state_(std::make_shared<State>()) {}
WideBuilder::~WideBuilder() = default;

std::int64_t WideBuilder::scratch_bytes() const {
  const State& state = *state_;
  return static_cast<std::int64_t>(state.sphere_memory.capacity() + state.cells.capacity() * sizeof(std::uint16_t) +
                                   state.cell_counts.capacity() * sizeof(std::uint32_t)) +
         state.arena.allocated_bytes() + state.collapse.allocated_bytes();
}

Result<std::shared_ptr<const WideTree>> WideBuilder::build(const SphereSet& spheres, const WideParameters& parameters,
                                                           int threads) {
  ensure_target();
  const std::int64_t count = spheres.size();
  if (Status status = check_wide_count(count); !status) return status.error();
  const std::string what = "the tree of " + grouped(count) + " spheres";
  WatchedWork work;
  try {
    std::unique_ptr<WideTree> tree = state_->take_spare();
    const std::int64_t kept = scratch_bytes() + tree->allocated_bytes();
    const double needed = static_cast<double>(predict_wide_memory(count, parameters).peak_bytes);
    if (Status status = check_memory(std::max(0.0, needed - static_cast<double>(kept)), what,
                                     std::min(needed, static_cast<double>(kept)));
        !status) {
      state_->give_back(std::move(tree));
      return status.error();
    }
    state_->build(spheres, parameters, threads, *tree, work);
    work.report(1);

    // Its memory returns to the builder when the last holder releases it.
    const auto recycle = [keep = std::weak_ptr<State>(state_)](const WideTree* done) {
      std::unique_ptr<WideTree> owned(const_cast<WideTree*>(done));
      if (const auto state = keep.lock()) state->give_back(std::move(owned));
    };
    return std::shared_ptr<const WideTree>(tree.release(), recycle);
  } catch (const std::bad_alloc&) {
    return no_memory_for(what);
  } catch (const Cancelled&) {
    return cancelled_error();
  }
}

}  // namespace bihive
