#include <algorithm>
#include <cstdint>

#include "bihive/wide/build/binary_tree.h"
#include "bihive/wide/build/split.h"
#include "bihive/wide/build/tuning.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {
namespace {

// Nodes per full leaf on the most scattered sets measured (packed sets need 1 / 15), and where leaves are so small that
// nodes are most of the tree.
double scattered_nodes(std::int64_t full_leaf) {
  return full_leaf < 4 ? 0.35 : 0.16;
}

// If distances fall exponentially, leaves can be as small as one or two spheres, and nodes mostly empty.
constexpr double kSmallestLeaf = 1.5;
double emptiest_node(std::int64_t full_leaf) {
  return full_leaf < 4 ? 3 : 6;
}

// A typical set: nodes and splits per full leaf; bytes per sphere, between those of both layouts.
constexpr double kUsualNodes = 0.075, kUsualSplits = 1.1, kUsualSphere = 18;

constexpr std::int64_t kCellCountBytes = kMostChunks * CellGrid::kCells * 4;
constexpr std::int64_t kHugePage = std::int64_t{1} << 21;
constexpr std::size_t kFirstSplits = 4 * NodeArena::kPortionSplits;  // in the first chunk

}  // namespace

WideMemoryPrediction predict_wide_memory(std::int64_t spheres, const WideParameters& parameters) {
  constexpr auto kTree = static_cast<std::int64_t>(sizeof(WideTree));
  if (spheres <= 0) return {kTree, kTree, kTree, kTree};
  constexpr auto kNode = static_cast<std::int64_t>(sizeof(WideNode));
  std::int64_t full_leaf = parameters.max_prims > 0 ? parameters.max_prims : kWidth;
  if (parameters.max_depth == 1) full_leaf = spheres;
  const std::int64_t leaves = (spheres + full_leaf - 1) / full_leaf;
  const std::int64_t padded = spheres + kWidth;

  // The number of levels bounds the nodes too: leaves of the last level are larger.
  double most_nodes = double(leaves) * scattered_nodes(full_leaf) + 2;
  const double peak_leaves = double(spheres) / std::min(kSmallestLeaf, double(full_leaf));
  double peak_nodes = peak_leaves / emptiest_node(full_leaf) + 2;
  std::int64_t low_nodes = std::max<std::int64_t>(1, (leaves - 1 + kWidth - 2) / (kWidth - 1));
  if (parameters.max_depth > 0) {
    double on_level = 1, in_all = 0;
    for (std::int64_t level = 1; level < std::max<std::int64_t>(2, parameters.max_depth) && in_all < 1e10; ++level) {
      in_all += on_level;
      on_level *= kWidth;
    }
    most_nodes = std::min(most_nodes, in_all);
    peak_nodes = std::min(peak_nodes, in_all);
    low_nodes = 1;
  }

  WideMemoryPrediction prediction;
  prediction.low_bytes = kTree + 16 * padded + low_nodes * kNode;
  prediction.high_bytes = kTree + 20 * padded + static_cast<std::int64_t>(most_nodes) * kNode;

  // During the build: the spheres twice, their cells, every sphere repeated, splits and nodes in doubling memory, an
  // outer tree of nearly all spheres with the sets and lists that it is made of, and huge-page alignment.
  constexpr double kSpheresTwice = 2 * 20 + 2, kRepeated = 2 * sizeof(EqualSphere) + 2 * sizeof(RepeatedSphere) + 2,
                   kOuter = 20 + 16 + 2 * 8 + 1;
  const double nodes = peak_nodes * double(kNode);
  prediction.most_bytes = static_cast<std::int64_t>((kSpheresTwice + kRepeated + kOuter) * double(padded) +
                                                    2 * peak_leaves * double(sizeof(BinarySplit)) + 4 * nodes) +
                          (std::int64_t{16} << 20);

  // Leaves are usually nearly full. Their splits, and nodes: in subtrees, then together.
  const double cells = spheres > kGridSpheres ? 2.0 * double(padded) + double(kCellCountBytes) : 0;
  const double usual_nodes = std::min(double(leaves) * kUsualNodes + 2, most_nodes);
  const double rounded = 16.0 * double(padded) < double(kHugePage) ? 0 : double(kHugePage);
  prediction.peak_bytes =
      kTree + static_cast<std::int64_t>(2 * kUsualSphere * double(padded) + cells +
                                        std::max(double(leaves) * kUsualSplits, double(kFirstSplits)) *
                                            double(sizeof(BinarySplit)) +
                                        3 * usual_nodes * double(kNode) + rounded);
  prediction.peak_bytes = std::min(prediction.peak_bytes, prediction.most_bytes);
  return prediction;
}

}  // namespace bihive
