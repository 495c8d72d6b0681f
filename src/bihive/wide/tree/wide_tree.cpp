#include "bihive/wide/wide_tree.h"

namespace bihive {

std::int64_t WideTree::used_bytes() const {
  const std::int64_t a_sphere = spheres.has_palette ? 16 : 20;
  return static_cast<std::int64_t>(sizeof(WideTree) + repeated.size() * sizeof(RepeatedSphere) +
                                   repeated_filter.size() * sizeof(std::uint32_t) + piles.size() * sizeof(Pile) +
                                   others_in_piles.size() * sizeof(std::uint32_t)) +
         (outer != nullptr ? outer->used_bytes() : 0) + node_count * std::int64_t{sizeof(WideNode)} +
         (placed > 0 ? (placed + kWidth) * a_sphere : 0);
}

WideTree WideTree::image(Vec3d by) const {
  WideTree made;
  made.aabb = aabb;
  made.scale = scale;
  made.origin = origin;
  made.size = size;
  made.placed = placed;
  made.node_count = node_count;
  made.nodes = nodes;
  made.spheres = spheres;
  made.levels = levels;
  made.largest_leaf = largest_leaf;
  made.is_image = true;
  made.shift = by;
  made.image_of = this;
  return made;
}

std::int64_t WideTree::allocated_bytes() const {
  return static_cast<std::int64_t>(
             sizeof(WideTree) + repeated.capacity() * sizeof(RepeatedSphere) +
             repeated_filter.capacity() * sizeof(std::uint32_t) + piles.capacity() * sizeof(Pile) +
             others_in_piles.capacity() * sizeof(std::uint32_t) + node_memory.capacity() + sphere_memory.capacity()) +
         (outer != nullptr ? outer->allocated_bytes() : 0);
}

std::int64_t OuterTree::used_bytes() const {
  return tree.used_bytes() + around_cores.used_bytes() + static_cast<std::int64_t>(cores.size() * sizeof(Core));
}

std::int64_t OuterTree::allocated_bytes() const {
  return tree.allocated_bytes() + around_cores.allocated_bytes() +
         static_cast<std::int64_t>(cores.capacity() * sizeof(Core));
}

}  // namespace bihive
