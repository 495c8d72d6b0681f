// Several rays traverse the wide tree in turn, each by itself: while one waits for memory, the others continue. For
// rays that have too little in common for a list.

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
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// A ray of the stream.
struct StreamRay {
  RayWalk walk;
  std::uint32_t number;  ///< of the ray in its stream
};

/// kStreamRays rays, in reused memory.
HWY_INLINE StreamRay* stream_rays(AlignedBuffer& memory) {
  if (HWY_UNLIKELY(memory.capacity() < kStreamRays * sizeof(StreamRay))) {
    memory.reserve(kStreamRays * sizeof(StreamRay));
    std::uninitialized_default_construct_n(static_cast<StreamRay*>(memory.data()), kStreamRays);
  }
  return static_cast<StreamRay*>(memory.data());
}

/// Traverses `count` rays from a node on. start(i, ray) prepares ray i, finish(i, ray) takes its result, and
/// undecided(i, slot) gets what only binary64 can decide.
template <bool kAnyHit, class Start, class Finish, class Undecided>
HWY_INLINE void walk_stream(const WideTree& tree, std::int64_t node, std::uint32_t count, StreamRay* rays,
                            const Start& start, const Finish& finish, const Undecided& undecided) {
  const auto begin = [&](StreamRay& ray, std::uint32_t number) HWY_ATTR {
    start(number, ray.walk.ray);
    ray.number = number;
    ray.walk.begin(node);
  };
  const auto step = [&](StreamRay& ray) HWY_ATTR {
    return ray.walk.step<kAnyHit>(tree, [&](std::uint32_t slot) HWY_ATTR {
      undecided(ray.number, slot);
      return false;
    });
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
      finish(ray.number, ray.walk.ray);
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
