// Several rays on their way through the wide tree at once, each by itself: while one waits for memory, the others go
// on. For rays that have too little in common for a list.

#if defined(BIHIVE_WIDE_TRACE_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_STREAM_INL_H_
#undef BIHIVE_WIDE_TRACE_STREAM_INL_H_
#else
#define BIHIVE_WIDE_TRACE_STREAM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "bihive/base/aligned_buffer.h"
#include "bihive/wide/trace/ray_walk-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// Rays on their way at a time.
constexpr std::uint32_t kStreamRays = 16;

/// One of them, and what it meets next, which memory has been asked for.
struct StreamRay {
  SingleRay ray;
  WaitingChildren waiting;
  std::uint32_t number;  ///< of the ray in its stream
  int octant;
  std::int64_t next;           ///< a node, or the slot of the first of some spheres
  std::uint32_t next_spheres;  ///< 0: a node

  /// Where it goes from here. False: nowhere.
  HWY_INLINE bool fetch_next(const WideTree& tree) {
    if (waiting.empty()) return false;
    const std::uint32_t child = waiting.pop();
    const WideNode& node = tree.nodes[child / kWidth];
    const auto slot = static_cast<int>(child % kWidth);
    if (node.is_leaf(slot)) {
      next = node.sphere_begin(slot);
      next_spheres = static_cast<std::uint32_t>(node.sphere_count(slot));
      const auto fetch = [&](const auto* from) HWY_ATTR {
        __builtin_prefetch(from + next);
        __builtin_prefetch(from + next + next_spheres - 1);
      };
      fetch(tree.spheres.x);
      fetch(tree.spheres.y);
      fetch(tree.spheres.z);
      fetch(tree.spheres.word);
      if (tree.spheres.r != nullptr) fetch(tree.spheres.r);
    } else {
      next = node.child_node(slot);
      next_spheres = 0;
      const char* const bytes = reinterpret_cast<const char*>(tree.nodes + next);
      for (std::size_t line = 0; line < sizeof(WideNode); line += 64) __builtin_prefetch(bytes + line);
    }
    return true;
  }
};

/// kStreamRays of them, in memory that is kept.
HWY_INLINE StreamRay* stream_rays(AlignedBuffer& memory) {
  if (HWY_UNLIKELY(memory.capacity() < kStreamRays * sizeof(StreamRay))) {
    memory.reserve(kStreamRays * sizeof(StreamRay));
    std::uninitialized_default_construct_n(static_cast<StreamRay*>(memory.data()), kStreamRays);
  }
  return static_cast<StreamRay*>(memory.data());
}

/// Walks `count` rays from a node on. start(i, ray) makes ray i ready, finish(i, ray) takes what it has found, and
/// rival(i, slot) gets what only binary64 can decide.
template <bool kAnyHit, class Start, class Finish, class Rival>
HWY_INLINE void walk_stream(const WideTree& tree, std::int64_t from, std::uint32_t count, StreamRay* rays,
                            const Start& start, const Finish& finish, const Rival& rival) {
  const auto begin = [&](StreamRay& ray, std::uint32_t number) HWY_ATTR {
    start(number, ray.ray);
    ray.number = number;
    ray.octant = octant_of(ray.ray.local);
    ray.waiting.clear();
    ray.next = from;
    ray.next_spheres = 0;
  };
  const auto step = [&](StreamRay& ray) HWY_ATTR {
    if (ray.next_spheres == 0) {
      ray.waiting.push_entered<kAnyHit>(tree.nodes[ray.next], static_cast<std::uint32_t>(ray.next), ray.ray,
                                        ray.octant);
    } else {
      const float before = ray.ray.s_best;
      const auto to_rivals = [&](std::uint32_t slot) HWY_ATTR {
        rival(ray.number, slot);
        return false;
      };
      if (test_leaf_single<kAnyHit>(tree, ray.next, ray.next_spheres, ray.ray, to_rivals)) return false;
      if (ray.ray.s_best != before) ray.waiting.drop_beyond(ray.ray.s_best);
    }
    return ray.fetch_next(tree);
  };

  StreamRay* active[kStreamRays];
  std::uint32_t running = std::min(count, kStreamRays);
  for (std::uint32_t k = 0; k < running; ++k) begin(*(active[k] = rays + k), k);
  std::uint32_t begun = running;
  while (running > 0) {
    for (std::uint32_t k = 0; k < running;) {
      StreamRay& ray = *active[k];
      if (HWY_LIKELY(step(ray))) {
        ++k;
        continue;
      }
      finish(ray.number, ray.ray);
      if (begun < count)
        begin(ray, begun++);
      else
        active[k] = active[--running];
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_STREAM_INL_H_
