// bvh-lbvh: a BVH whose splits are the bits of Morton codes [Lauterbach2009]: the fastest to build.

#include <algorithm>

#include "bihive/compare/box_tree.h"
#include "bihive/compare/morton.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

constexpr std::uint32_t kLbvhLeaf = 4;  // spheres

// The first entry of a range whose code has the highest differing bit set; the middle if all codes are equal.
std::uint32_t split_of(const std::vector<MortonSphere>& list, std::uint32_t begin, std::uint32_t end) {
  const std::uint64_t first = list[begin].code, different = first ^ list[end - 1].code;
  if (different == 0) return begin + (end - begin) / 2;
  const std::uint64_t bit = std::uint64_t{1} << (63 - __builtin_clzll(different));
  const auto middle = std::partition_point(list.begin() + begin, list.begin() + end,
                                           [bit](const MortonSphere& one) { return (one.code & bit) == 0; });
  return static_cast<std::uint32_t>(middle - list.begin());
}

BoxTree build(const SphereSet& spheres, std::uint32_t max_prims) {
  const std::vector<MortonSphere> list = along_the_z_curve(spheres);
  BoxTree tree;
  for (const MortonSphere& one : list) tree.sphere_ids.push_back(one.id);

  // At most 63 levels by bits, and 32 by halves.
  struct Range {
    std::uint32_t node, begin, end;
  };
  std::vector<Range> pending;
  if (!list.empty()) {
    tree.nodes.emplace_back();
    pending.push_back({0, 0, static_cast<std::uint32_t>(list.size())});
  }
  while (!pending.empty()) {
    const Range range = pending.back();
    pending.pop_back();
    if (range.end - range.begin <= max_prims) {
      tree.nodes[range.node].first = range.begin;
      tree.nodes[range.node].count = range.end - range.begin;
      continue;
    }
    const std::uint32_t middle = split_of(list, range.begin, range.end);
    const auto left = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[range.node].first = left;
    tree.nodes.resize(tree.nodes.size() + 2);
    pending.push_back({left, range.begin, middle});
    pending.push_back({left + 1, middle, range.end});
  }
  tree.nodes.shrink_to_fit();
  fit_boxes(tree, spheres);
  return tree;
}

}  // namespace

Result<StructurePointer> build_bvh_lbvh(const SphereSet& spheres, const StructureParameters& parameters, int) {
  const auto max_prims = parameters.max_prims > 0 ? static_cast<std::uint32_t>(parameters.max_prims) : kLbvhLeaf;
  return build_or_error(spheres, "bvh-lbvh", [&]() -> StructurePointer {
    return std::make_unique<BoxTreeStructure>(spheres, build(spheres, max_prims));
  });
}

}  // namespace bihive::workbench
