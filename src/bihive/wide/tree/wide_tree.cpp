#include "bihive/wide/wide_tree.h"

namespace bihive {

std::int64_t WideTree::used_bytes() const {
  const std::int64_t a_sphere = spheres.has_palette ? 16 : 20;
  return static_cast<std::int64_t>(sizeof(WideTree) + repeated.size() * sizeof(RepeatedSphere)) +
         node_count * std::int64_t{sizeof(WideNode)} + (size > 0 ? (size + kWidth) * a_sphere : 0);
}

std::int64_t WideTree::allocated_bytes() const {
  return static_cast<std::int64_t>(sizeof(WideTree) + repeated.capacity() * sizeof(RepeatedSphere) +
                                   node_memory.capacity() + sphere_memory.capacity());
}

}  // namespace bihive
