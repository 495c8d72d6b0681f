// Builds wide trees, frame after frame, in memory that it keeps.
#pragma once

#include <cstdint>
#include <memory>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// 0: the engine chooses.
struct WideParameters {
  std::int64_t max_prims = 0;  ///< no leaf is larger unless max_depth or coincidence forces it
  std::int64_t max_depth = 0;  ///< maximum levels, leaves counted as one: 1 is a single leaf
};

/// A tree depends on the spheres and the parameters only, not on the number of threads, the instruction set, or what
/// was built before.
///
/// A tree that build() returned is never written to again while anybody holds it; building into a tree that is being
/// traced cannot happen. When the last holder releases it, its memory goes back to the builder, and the next build
/// reuses it: whoever drops the old tree before building the next needs one allocation for all frames, whoever keeps it
/// needs two. Holders may outlive the builder.
class WideBuilder {
 public:
  WideBuilder();
  ~WideBuilder();
  WideBuilder(const WideBuilder&) = delete;
  WideBuilder& operator=(const WideBuilder&) = delete;

  /// Errors: more than 2^32 - 1 spheres, or not enough memory: less than predicted, or an allocation that fails. One
  /// call at a time per builder. `threads` 0: all.
  Result<std::shared_ptr<const WideTree>> build(const SphereSet& spheres, const WideParameters& parameters = {},
                                                int threads = 0);

  /// Bytes of working memory that the builder keeps between builds, without any tree.
  std::int64_t scratch_bytes() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// Bytes of a tree of that many spheres, and of its construction.
struct WideMemoryPrediction {
  /// WideTree::used_bytes(), as a range: full leaves and a palette, to the most scattered scenes of many radii. Spheres
  /// that coincide in centre and radius add 10 bytes each (WideTree::repeated), and an outer tree (WideTree::outer)
  /// what a tree of its spheres takes; clusters in which distances fall exponentially can need more.
  std::int64_t low_bytes = 0, high_bytes = 0;
  /// Tree and working memory while building. From 100,000 spheres on, sets of a usual kind took 0.8 to 1 of it.
  std::int64_t peak_bytes = 0;
  /// The same at most, hostile sets included.
  std::int64_t most_bytes = 0;
};
WideMemoryPrediction predict_wide_memory(std::int64_t spheres, const WideParameters& parameters = {});

}  // namespace bihive
