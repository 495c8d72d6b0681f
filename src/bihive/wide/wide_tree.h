// The wide tree: a bounding interval hierarchy collapsed sixteen wide, with its spheres in leaf order.
//
// Everything that tracing needs is in here; the sphere set is not touched again. Everything is in the stored units of
// the set (geometry/sphere_set.h): no bound lies beyond [-1, 1].
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/aligned_buffer.h"
#include "bihive/math/aabb.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Children of a node, spheres of a full leaf, and the padding after the last sphere.
constexpr int kWidth = 16;

/// Wide levels at most. Past 48 splits the builder halves by count; nodes that would come after the last level
/// become leaves.
constexpr int kMostLevels = 64;

/// Up to sixteen children, which own neighbouring ranges of spheres: child i those from begin[i] to before begin[i +
/// 1], counted from first_sphere. Inner children are neighbours too: the one at slot i is nodes[first_node + number of
/// inner children before slot i].
struct alignas(64) WideNode {
  float lo[3][kWidth];  ///< boxes of the children, axis by axis; +inf in slots without a child
  float hi[3][kWidth];  ///< -inf in slots without a child
  std::uint32_t begin[kWidth + 1];
  std::uint16_t leaf_mask;    ///< bit i: child i is a leaf
  std::uint16_t child_count;  ///< 1 to 16: slots 0 to child_count - 1
  /// The children from near to far, four bits a slot, for rays whose octant is 0 to 3. Octant: bit k is set where the
  /// direction is negative along axis k. Octant 7 - o reads entry o backwards, from child_count - 1 down to 0.
  std::uint64_t order[4];
  std::int64_t first_node;
  std::int64_t first_sphere;
  std::int64_t unused;

  bool is_leaf(int slot) const { return (leaf_mask >> slot & 1) != 0; }
  std::int64_t child_node(int slot) const {
    const unsigned inner_before = ~unsigned{leaf_mask} & ((1u << slot) - 1);
    return first_node + __builtin_popcount(inner_before);
  }
  std::int64_t sphere_begin(int slot) const { return first_sphere + begin[slot]; }
  std::int64_t sphere_count(int slot) const { return std::int64_t{begin[slot + 1]} - begin[slot]; }
};
static_assert(sizeof(WideNode) == 512);

/// Spheres in leaf order, structure of arrays, each array padded by kWidth entries that are never hit (radius 0, far
/// away). Two layouts: with a palette (at most 31 distinct radii above 0, fewer than 2^27 spheres) `word` is radius
/// class << 27 | id and `r` is null: 16 bytes per sphere; otherwise `word` is the id and `r` holds the radius: 20
/// bytes. Class 31 is radius 0; without such radii palette_size is their number, else 32. The padding is of class 31
/// always.
struct WideSpheres {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* r = nullptr;
  const std::uint32_t* word = nullptr;
  bool has_palette = false;
  int palette_size = 0;
  alignas(64) std::array<float, 32> palette{};  ///< unused entries are 0

  static constexpr int kIdBits = 27;
  static constexpr std::uint32_t kIdMask = (1u << kIdBits) - 1;

  std::uint32_t id_mask() const { return has_palette ? kIdMask : ~std::uint32_t{0}; }
  std::int64_t id(std::int64_t slot) const { return word[slot] & id_mask(); }
  Vec3d centre(std::int64_t slot) const { return {double(x[slot]), double(y[slot]), double(z[slot])}; }
  double radius(std::int64_t slot) const { return double(has_palette ? palette[word[slot] >> kIdBits] : r[slot]); }
};

/// A sphere that has an equal: another of the same centre and radius.
struct RepeatedSphere {
  std::uint32_t id;
  std::uint32_t slot;  ///< of the first of its equals in the leaves, the same for all of them
};

/// More than kWidth equal spheres (duplicates), of which the tree holds the one with the lowest id. A ray that meets it
/// meets all.
struct Pile {
  std::uint32_t id;                        ///< the lowest
  std::size_t first_other, end_of_others;  ///< the others, in WideTree::others_in_piles
};

struct OuterTree;

/// Immutable while anybody traces it: made by WideBuilder (wide/wide_builder.h) and handed out as
/// std::shared_ptr<const WideTree>. An empty set has no nodes. Otherwise nodes[0] is the root, even of a single sphere.
struct WideTree {
  Aabb aabb;                ///< of all spheres
  double scale = 1;         ///< stored = (world - origin) * scale, a power of two
  Vec3d origin;             ///< SphereSet::origin()
  std::int64_t size = 0;    ///< spheres
  std::int64_t placed = 0;  ///< of them, those in leaves: all except `others_in_piles`
  std::int64_t node_count = 0;
  const WideNode* nodes = nullptr;
  WideSpheres spheres;
  int levels = 0;  ///< of wide nodes from the root to the deepest, leaves not counted; 0 if empty
  std::int64_t largest_leaf = 0;
  /// For an image: its spheres are those of the tree moved by `shift` (stored units), each centre rounded once to
  /// binary32. Nodes and spheres are still the tree's own.
  bool is_image = false;
  Vec3d shift;
  const WideTree* image_of = nullptr;    ///< whose `piles` are those of the image
  std::vector<RepeatedSphere> repeated;  ///< ascending ids; empty unless spheres in the leaves have equals
  std::vector<std::uint32_t>
      repeated_filter;  ///< sixteen bits for each, which tell most other ids apart (tree/left_sphere.h)

  std::vector<Pile> piles;  ///< duplicates, by ascending ids; closest and any hit ignore them
  std::vector<std::uint32_t> others_in_piles;

  /// Where many spheres lie wholly inside others, as shells around one centre do: all others. Closest and any hit ask
  /// it first, and this tree, which has all spheres, for few rays. Null: there are no such spheres, or few.
  std::shared_ptr<const OuterTree> outer;

  AlignedBuffer node_memory, sphere_memory;  ///< memory of the arrays above

  Vec3d stored(Vec3d world) const { return (world - origin) * scale; }

  /// The centre that a ray meets, in stored units.
  Vec3d centre(std::int64_t slot) const {
    const Vec3d own = spheres.centre(slot);
    return is_image ? to_double(to_float(own + shift)) : own;
  }

  /// The tree's spheres moved by a vector in stored units, so that every one stays within [-1, 1]. Nothing is copied:
  /// the tree must outlive the image. Spheres of an image must not coincide if rays leave them.
  WideTree image(Vec3d by) const;

  /// Bytes in use: nodes, spheres with their padding, repeated spheres, duplicates, the outer tree, and this structure.
  /// All that tracing touches.
  std::int64_t used_bytes() const;
  /// Bytes held, with the reserve for a rebuild.
  std::int64_t allocated_bytes() const;
};

/// A ball inside a sphere, around its centre, that holds enclosed spheres.
struct Core {
  Vec3d centre;
  double radius;
};

/// The spheres that no other encloses. A ray that comes to a core before its hit may meet one of those that are left
/// out.
struct OuterTree {
  WideTree tree;            ///< under the ids of the whole set; `repeated` has those with an equal in its leaves
  std::vector<Core> cores;  ///< together they hold every sphere that is left out
  WideTree around_cores;    ///< the enclosing spheres: sphere i has core i

  std::int64_t used_bytes() const;
  std::int64_t allocated_bytes() const;
};

}  // namespace bihive
