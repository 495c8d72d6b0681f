// The rays that callers of bihive.h pass, in chunks for threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

#include "bihive.h"
#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/ray_batch.h"
#include "c_errors.h"

namespace bihive::c {

/// Rays per chunk. At most: each chunk is copied.
constexpr std::int64_t kMostRaysPerPart = 1 << 17;
/// At least, if the caller leaves the number of threads open: fewer rays are traced faster than threads are woken.
constexpr std::int64_t kFewestRaysOfAll = 4096;
/// At least, if the caller states a number of threads: a block of a beam.
constexpr std::int64_t kFewestRays = 64;

/// Rays are shared among threads in chunks of `size`; the last may be smaller.
struct Parts {
  std::int64_t size = 1, count = 0;

  static Parts of(std::int64_t rays, int threads) {
    const std::int64_t fewest = threads > 0 ? kFewestRays : kFewestRaysOfAll;
    const std::int64_t workers = std::clamp<std::int64_t>(rays / fewest, 1, threads > 0 ? threads : hardware_threads());
    // As many chunks for each thread, in whole blocks of 64 neighbours.
    const std::int64_t of_each = (rays + workers * kMostRaysPerPart - 1) / (workers * kMostRaysPerPart);
    const std::int64_t parts = std::max<std::int64_t>(1, workers * of_each);
    const std::int64_t size = std::max<std::int64_t>(1, ((rays + parts - 1) / parts + 63) / 64) * 64;
    return {size, (rays + size - 1) / size};
  }
};

/// Whether the rays can be read.
inline bool are_ready(const bihive_rays* rays) {
  return rays != nullptr && rays->count >= 0 &&
         (rays->count == 0 ||
          ((rays->origins != nullptr || rays->origins64 != nullptr) && rays->directions != nullptr));
}

/// Rays first to first + count - 1 as the engine takes them: local (geometry/sphere_set.h).
class Columns {
 public:
  Columns(const bihive_rays& rays, Vec3d from, std::int64_t first, std::int64_t count) {
    span_.count = count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<float>& origin = columns_[axis];
      std::vector<float>& direction = columns_[3 + axis];
      origin.resize(static_cast<std::size_t>(count));
      direction.resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < origin.size(); ++i) {
        const std::size_t at = 3 * (static_cast<std::size_t>(first) + i) + axis;
        const double world = rays.origins64 != nullptr ? rays.origins64[at] : double(rays.origins[at]);
        origin[i] = static_cast<float>(world - from[static_cast<int>(axis)]);
        direction[i] = rays.directions[at];
      }
      span_.origin[axis] = origin.data();
      span_.direction[axis] = direction.data();
    }
    if (rays.t_min != nullptr) span_.t_min = rays.t_min + first;
    if (rays.t_max != nullptr) span_.t_max = rays.t_max + first;
    if (rays.leaves != nullptr) span_.leaves = rays.leaves + first;
    if (rays.inside != nullptr) span_.inside = rays.inside + first;
  }
  const RaySpan& span() const { return span_; }

 private:
  std::vector<float> columns_[6];
  RaySpan span_;
};

/// Calls answer(rays, first, chunk) for all chunks of the rays, on threads, as a section of the thread's WatchedWork.
/// `origin`: SphereSet::origin() of the spheres, in world units.
template <class Answer>
int for_chunks(Vec3d origin, const bihive_rays& rays, int threads, const Answer& answer) {
  const Parts parts = Parts::of(rays.count, threads);
  try {
    watched_for(threads, parts.count, [&](std::int64_t part) {
      const std::int64_t first = part * parts.size;
      answer(Columns(rays, origin, first, std::min(parts.size, rays.count - first)).span(), first, part);
    });
  } catch (const std::bad_alloc&) {
    return failed("not enough memory for this many rays; trace fewer at a time");
  }
  return kDone;
}

}  // namespace bihive::c
