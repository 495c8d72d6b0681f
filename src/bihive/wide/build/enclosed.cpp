#include "bihive/wide/build/enclosed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bihive/wide/build/tuning.h"

namespace bihive {
namespace {

// The state of a sphere, by slot.
enum class Kind : std::uint8_t { plain, encloses, enclosed };

class Finder {
 public:
  explicit Finder(const WideTree& tree) : tree_(tree), kinds_(static_cast<std::size_t>(tree.placed), Kind::plain) {}

  // Looks for a sphere that encloses many of slots `first` to first + count - 1, whose box has sides up to `side`.
  void search(std::int64_t first, std::int64_t count, double side) {
    std::int64_t largest = -1;
    double radius = 0;
    for (std::int64_t i = first; i < first + count; ++i)
      if (kind(i) == Kind::plain && tree_.spheres.radius(i) > radius) {
        largest = i;
        radius = tree_.spheres.radius(i);
      }
    if (largest < 0 || side > kSidesOfCover * 2 * radius) return;

    // Mark the enclosed spheres, or none if too few would be crossed.
    marked_.clear();
    Core core{tree_.spheres.centre(largest), 0};
    double crossed = 0;
    for (std::int64_t i = first; i < first + count; ++i) {
      if (kind(i) != Kind::plain) continue;
      const double r = tree_.spheres.radius(i);
      const Vec3d apart = tree_.spheres.centre(i) - core.centre;
      // The factor exceeds all rounding of this sum.
      const double reach = (std::sqrt(dot(apart, apart)) + r) * (1 + 0x1p-48);
      if (reach > radius - kDepthOfEnclosed) continue;
      marked_.push_back(i);
      core.radius = std::max(core.radius, reach);
      crossed += r / radius * (r / radius);
    }
    if (crossed < kFewestCrossed) return;
    for (const std::int64_t i : marked_) kind(i) = Kind::enclosed;
    kind(largest) = Kind::encloses;
    found_.cores.push_back(core);
    found_.enclosing.push_back(tree_.spheres.id(largest));
  }

  EnclosedSpheres result() {
    if (found_.cores.empty()) return {};
    for (std::int64_t i = 0; i < tree_.placed; ++i)
      if (kind(i) != Kind::enclosed) found_.others.push_back(tree_.spheres.id(i));
    std::sort(found_.others.begin(), found_.others.end());
    return std::move(found_);
  }

 private:
  Kind& kind(std::int64_t slot) { return kinds_[static_cast<std::size_t>(slot)]; }

  const WideTree& tree_;
  std::vector<Kind> kinds_;
  std::vector<std::int64_t> marked_;
  EnclosedSpheres found_;
};

double largest_radius(const WideTree& tree) {
  const WideSpheres& spheres = tree.spheres;
  if (spheres.has_palette) return double(*std::max_element(spheres.palette.begin(), spheres.palette.end()));
  return double(*std::max_element(spheres.r, spheres.r + tree.placed));
}

}  // namespace

EnclosedSpheres find_enclosed(const WideTree& tree) {
  if (tree.placed <= kFewestCrossed || tree.spheres.palette_size == 1) return {};
  const auto largest_side = static_cast<float>(kSidesOfCover * 2 * largest_radius(tree));
  const Vec3f whole = tree.aabb.hi - tree.aabb.lo;
  Finder finder(tree);
  const float side_of_all = std::max({whole.x, whole.y, whole.z});
  if (side_of_all <= largest_side) finder.search(0, tree.placed, double(side_of_all));

  // A node comes after the one above it, so spheres that enclose most are found first.
  for (std::int64_t at = 0; at < tree.node_count; ++at) {
    const WideNode& node = tree.nodes[at];
    if (node.begin[kWidth] <= kFewestCrossed) continue;
    float sides[kWidth];
    for (int slot = 0; slot < kWidth; ++slot)
      sides[slot] = std::max({node.hi[0][slot] - node.lo[0][slot], node.hi[1][slot] - node.lo[1][slot],
                              node.hi[2][slot] - node.lo[2][slot]});
    for (int slot = 0; slot < node.child_count; ++slot)
      if (sides[slot] <= largest_side && node.sphere_count(slot) > kFewestCrossed)
        finder.search(node.sphere_begin(slot), node.sphere_count(slot), double(sides[slot]));
  }
  return finder.result();
}

}  // namespace bihive
