#include "bihive/kernels/wide_builder.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <mutex>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

#include "bihive/kernels/binary_tree.h"
#include "bihive/kernels/wide_collapse.h"

namespace bihive {
namespace {

// Splits on a way from the root at most, before ranges are halved by count: a guard against hostile sets.
constexpr int kDeepestMidpoint = 48;

// Padding after the last sphere: outside of everything, and never hit.
constexpr float kFarAway = 0x1p30F;

class Splitter {
 public:
  Splitter(const SphereSet& spheres, std::int64_t full_leaf) : spheres_(spheres), full_leaf_(full_leaf) {}

  void split_all(std::vector<std::uint32_t>& ids, std::vector<BinaryNode>& nodes) {
    nodes.resize(1);
    split(ids, nodes, 0, 0, static_cast<std::uint32_t>(ids.size()), 0);
  }

 private:
  float coordinate(std::uint32_t id, int axis) const {
    return (axis == 0 ? spheres_.x() : axis == 1 ? spheres_.y() : spheres_.z())[id];
  }

  void split(std::vector<std::uint32_t>& ids, std::vector<BinaryNode>& nodes, std::uint32_t at, std::uint32_t first,
             std::uint32_t count, int depth) {
    nodes[at].first = first;
    nodes[at].count = count;
    Aabb box, centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vec3f c{coordinate(ids[i], 0), coordinate(ids[i], 1), coordinate(ids[i], 2)};
      box.add(spheres_.stored_box(ids[i]));
      centres.add({c, c});
    }
    nodes[at].box = box;
    if (count <= full_leaf_) return;

    // Part the spheres at the middle of the longest side of their centres' box.
    const Vec3f side = centres.hi - centres.lo;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    std::uint32_t middle = first + count / 2;
    if (side[axis] > 0) {
      float plane = 0.5F * (centres.lo[axis] + centres.hi[axis]);
      if (depth >= kDeepestMidpoint) {
        std::nth_element(ids.begin() + first, ids.begin() + middle, ids.begin() + first + count,
                         [&](std::uint32_t a, std::uint32_t b) {
                           return std::pair(coordinate(a, axis), a) < std::pair(coordinate(b, axis), b);
                         });
        plane = coordinate(ids[middle], axis);
      }
      // Spheres on the plane go right, or left if nothing else is there.
      const bool some_below = centres.lo[axis] < plane;
      middle = static_cast<std::uint32_t>(std::stable_partition(ids.begin() + first, ids.begin() + first + count,
                                                                [&](std::uint32_t id) {
                                                                  const float c = coordinate(id, axis);
                                                                  return some_below ? c < plane : c <= plane;
                                                                }) -
                                          ids.begin());
    }
    const auto child = static_cast<std::uint32_t>(nodes.size());
    nodes.resize(nodes.size() + 2);
    nodes[at].child = child;
    nodes[at].axis = static_cast<std::uint32_t>(axis);
    split(ids, nodes, child, first, middle - first, depth + 1);
    split(ids, nodes, child + 1, middle, first + count - middle, depth + 1);
  }

  const SphereSet& spheres_;
  std::int64_t full_leaf_;
};

// The distinct radii, at most `most`; empty if there are more.
std::vector<float> distinct_radii(const SphereSet& spheres, std::size_t most) {
  std::vector<float> radii;
  for (const float r : spheres.r()) {
    if (r == 0 || std::find(radii.begin(), radii.end(), r) != radii.end()) continue;
    if (radii.size() == most) return {};
    radii.push_back(r);
  }
  if (radii.empty()) radii.push_back(0);
  return radii;
}

// Takes room for the spheres in one block, and points the arrays into it.
void place_spheres(std::int64_t count, WideTree& tree) {
  const auto padded = static_cast<std::size_t>(count + kWidth);
  const std::size_t an_array = (padded * sizeof(float) + 63) / 64 * 64;
  const int arrays = tree.spheres.has_palette ? 4 : 5;
  tree.sphere_memory.reserve(an_array * static_cast<std::size_t>(arrays));
  auto* const bytes = static_cast<std::byte*>(tree.sphere_memory.data());
  tree.spheres.x = reinterpret_cast<float*>(bytes);
  tree.spheres.y = reinterpret_cast<float*>(bytes + an_array);
  tree.spheres.z = reinterpret_cast<float*>(bytes + 2 * an_array);
  tree.spheres.word = reinterpret_cast<std::uint32_t*>(bytes + 3 * an_array);
  tree.spheres.r = tree.spheres.has_palette ? nullptr : reinterpret_cast<float*>(bytes + 4 * an_array);
}

void fill_spheres(const SphereSet& set, const std::vector<std::uint32_t>& ids, const std::vector<float>& radii,
                  WideTree& tree) {
  WideSpheres& spheres = tree.spheres;
  spheres.has_palette = !radii.empty() && set.size() <= std::int64_t{WideSpheres::kIdMask};
  spheres.palette_size = 0;
  spheres.palette.fill(0);
  if (spheres.has_palette) {
    spheres.palette_size = static_cast<int>(radii.size());
    std::copy(radii.begin(), radii.end(), spheres.palette.begin());
  }
  place_spheres(set.size(), tree);
  auto* const x = const_cast<float*>(spheres.x);
  auto* const y = const_cast<float*>(spheres.y);
  auto* const z = const_cast<float*>(spheres.z);
  auto* const r = const_cast<float*>(spheres.r);
  auto* const word = const_cast<std::uint32_t*>(spheres.word);
  for (std::size_t i = 0; i < ids.size() + kWidth; ++i) {
    const bool padding = i >= ids.size();
    const std::uint32_t id = padding ? 0 : ids[i];
    x[i] = padding ? kFarAway : set.x()[id];
    y[i] = padding ? kFarAway : set.y()[id];
    z[i] = padding ? kFarAway : set.z()[id];
    const float radius = padding ? 0 : set.r()[id];
    if (!spheres.has_palette) {
      r[i] = radius;
      word[i] = padding ? ~std::uint32_t{0} : id;
      continue;
    }
    std::uint32_t radius_class = 31;
    if (radius > 0)
      radius_class = static_cast<std::uint32_t>(std::find(radii.begin(), radii.end(), radius) - radii.begin());
    word[i] = radius_class << WideSpheres::kIdBits | (padding ? WideSpheres::kIdMask : id);
  }
}

// Spheres that have an equal.
std::vector<RepeatedSphere> find_repeated(const SphereSet& set, std::vector<std::uint32_t>& ids) {
  const auto key = [&](std::uint32_t id) { return std::tuple(set.x()[id], set.y()[id], set.z()[id], set.r()[id]); };
  std::sort(ids.begin(), ids.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<RepeatedSphere> repeated;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool as_before = i > 0 && key(ids[i - 1]) == key(ids[i]);
    const bool as_after = i + 1 < ids.size() && key(ids[i + 1]) == key(ids[i]);
    const std::uint32_t id = ids[i];
    if (as_before || as_after) repeated.push_back({id, set.x()[id], set.y()[id], set.z()[id], set.r()[id]});
  }
  std::sort(repeated.begin(), repeated.end(),
            [](const RepeatedSphere& a, const RepeatedSphere& b) { return a.id < b.id; });
  return repeated;
}

}  // namespace

// What outlives a build: a tree that nobody holds any more, whose memory the next one takes.
struct WideBuilder::State {
  std::mutex mutex;
  std::unique_ptr<WideTree> spare;

  std::unique_ptr<WideTree> take_spare() {
    const std::lock_guard lock(mutex);
    if (spare != nullptr) return std::move(spare);
    return std::make_unique<WideTree>();
  }

  void give_back(std::unique_ptr<WideTree> tree) {
    const std::lock_guard lock(mutex);
    if (spare == nullptr || spare->allocated_bytes() < tree->allocated_bytes()) std::swap(spare, tree);
  }
};

WideBuilder::WideBuilder() : state_(std::make_shared<State>()) {}
WideBuilder::~WideBuilder() = default;

std::int64_t WideBuilder::scratch_bytes() const {
  return 0;
}

Result<std::shared_ptr<const WideTree>> WideBuilder::build(const SphereSet& spheres, const WideParameters& parameters,
                                                           int /*threads*/) {
  const std::int64_t count = spheres.size();
  if (count > std::int64_t{std::numeric_limits<std::uint32_t>::max()})
    return Error{"a wide tree holds at most 4294967295 spheres, and there are " + std::to_string(count), "", 0, 0, ""};
  try {
    std::unique_ptr<WideTree> tree = state_->take_spare();
    tree->scale = spheres.scale();
    tree->size = count;
    tree->aabb = {};
    tree->node_count = 0;
    tree->nodes = nullptr;
    tree->levels = 0;
    tree->largest_leaf = 0;
    tree->repeated.clear();
    tree->spheres = {};
    if (count > 0) {
      // Split in two, then collapse.
      const std::int64_t full_leaf = parameters.max_prims > 0 ? parameters.max_prims : kWidth;
      const int most_levels = parameters.max_depth > 0
                                  ? static_cast<int>(std::clamp<std::int64_t>(parameters.max_depth - 1, 1, kMostLevels))
                                  : kMostLevels;
      std::vector<std::uint32_t> ids(static_cast<std::size_t>(count));
      std::iota(ids.begin(), ids.end(), 0u);
      std::vector<BinaryNode> binary;
      Splitter(spheres, parameters.max_depth == 1 ? count : full_leaf).split_all(ids, binary);
      tree->aabb = binary[0].box;
      std::vector<WideNode> wide;
      const WideShape shape = collapse(binary, most_levels, full_leaf, wide);
      tree->levels = shape.levels;
      tree->largest_leaf = shape.largest_leaf;

      // Keep the result.
      tree->node_count = static_cast<std::int64_t>(wide.size());
      tree->node_memory.reserve(wide.size() * sizeof(WideNode));
      std::memcpy(tree->node_memory.data(), wide.data(), wide.size() * sizeof(WideNode));
      tree->nodes = static_cast<const WideNode*>(tree->node_memory.data());
      fill_spheres(spheres, ids, distinct_radii(spheres, 31), *tree);
      tree->repeated = find_repeated(spheres, ids);
    }
    // Its memory comes back when the last holder lets go.
    const auto recycle = [keep = std::weak_ptr<State>(state_)](const WideTree* done) {
      std::unique_ptr<WideTree> owned(const_cast<WideTree*>(done));
      if (const auto state = keep.lock()) state->give_back(std::move(owned));
    };
    return std::shared_ptr<const WideTree>(tree.release(), recycle);
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for the tree of " + std::to_string(count) + " spheres", "", 0, 0,
                 "it takes about 40 bytes a sphere while it is made"};
  }
}

}  // namespace bihive
