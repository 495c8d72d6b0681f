#include "bihive/wide/build/split.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/build/split.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/simd/dispatch.h"
#include "bihive/wide/build/load-inl.h"
#include "bihive/wide/build/split-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

InputSummary summarize_on_target(const SphereSet& spheres, std::int64_t begin, std::int64_t end) {
  return summarize_spheres(spheres, begin, end);
}

void load_on_target(const SphereSet& spheres, std::int64_t begin, std::int64_t end, SplitContext& context) {
  load_all(spheres, begin, end, context);
}

void cells_on_target(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const CellGrid& grid,
                     std::uint16_t* cell, std::uint32_t* counts) {
  find_all_cells(spheres, begin, end, grid, cell, counts);
}

void scatter_on_target(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const std::uint16_t* cell,
                       std::uint32_t* next, SplitContext& context) {
  scatter_all(spheres, begin, end, cell, next, context);
}

Aabb bound_on_target(const SphereArrays& spheres, std::int64_t first, std::int64_t count) {
  return centre_box(spheres, first, count);
}

void split_on_target(SplitContext& context, const SplitRange& range, TaskList& list) {
  if (context.final.r != nullptr)
    Splitter<true>::run(context, range, list);
  else
    Splitter<false>::run(context, range, list);
}

void close_on_target(BinaryNode& node) {
  if (node.is_leaf() || node.count <= kTaskSpheres) return;
  close_on_target(node.split->side[0]);
  close_on_target(node.split->side[1]);
  close_node(node);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(summarize_on_target);
HWY_EXPORT(load_on_target);
HWY_EXPORT(cells_on_target);
HWY_EXPORT(scatter_on_target);
HWY_EXPORT(bound_on_target);
HWY_EXPORT(split_on_target);
HWY_EXPORT(close_on_target);

void InputSummary::add(const InputSummary& next) {
  centres.add(next.centres);
  largest_radius = std::max(largest_radius, next.largest_radius);
  palette.overflow = palette.overflow || next.palette.overflow;
  palette.has_zero = palette.has_zero || next.palette.has_zero;
  for (int k = 0; k < next.palette.size; ++k) palette.add(next.palette.radius[k]);
}

CellGrid::CellGrid(const Aabb& centres) {
  // Halve the longest side, nine times.
  Vec3f side = centres.hi - centres.lo;
  int bits[3] = {};
  for (int& longest : axis) {
    longest = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    side[longest] *= 0.5F;
    ++bits[longest];
  }
  for (int k = 0; k < 3; ++k) {
    const int cells = 1 << bits[k];
    const float extent = centres.hi[k] - centres.lo[k];
    lo[k] = centres.lo[k];
    scale[k] = extent > 0 ? static_cast<float>(cells) / extent : 0;
    if (!(scale[k] <= std::numeric_limits<float>::max())) scale[k] = 0;
    last[k] = cells - 1;
  }

  // Spread the bits of each coordinate over the cell's number.
  for (int k = 0; k < 3; ++k)
    for (int at = 0; at <= last[k]; ++at) {
      unsigned spread = 0;
      int bit = bits[k];
      for (int i = 0; i < kBits; ++i)
        if (axis[i] == k && (at >> --bit & 1) != 0) spread |= 1u << (kBits - 1 - i);
      place[k][at] = static_cast<std::uint16_t>(spread);
    }
}

namespace wide {

InputSummary summarize(const SphereSet& spheres, std::int64_t begin, std::int64_t end) {
  return HWY_DYNAMIC_DISPATCH(summarize_on_target)(spheres, begin, end);
}

void load_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end, SplitContext& context) {
  HWY_DYNAMIC_DISPATCH(load_on_target)(spheres, begin, end, context);
}

void find_cells(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const CellGrid& grid,
                std::uint16_t* cell, std::uint32_t* counts) {
  HWY_DYNAMIC_DISPATCH(cells_on_target)(spheres, begin, end, grid, cell, counts);
}

void scatter_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const std::uint16_t* cell,
                     std::uint32_t* next, SplitContext& context) {
  HWY_DYNAMIC_DISPATCH(scatter_on_target)(spheres, begin, end, cell, next, context);
}

Aabb bound_centres(const SplitContext& context, const SplitRange& range) {
  return HWY_DYNAMIC_DISPATCH(bound_on_target)(range.in_final ? context.final : context.scratch, range.first,
                                               range.count);
}

void split_range(SplitContext& context, const SplitRange& range, TaskList& list) {
  HWY_DYNAMIC_DISPATCH(split_on_target)(context, range, list);
}

void close_tops(BinaryNode& root) {
  HWY_DYNAMIC_DISPATCH(close_on_target)(root);
}

}  // namespace wide
}  // namespace bihive
#endif
