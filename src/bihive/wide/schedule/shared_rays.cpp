// Any number of rays, shared among threads in chunks, as watched work.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/schedule/tuning.h"

namespace bihive {
namespace wide {
namespace {

// The size of a chunk, a whole number of blocks.
std::int64_t rays_per_chunk(std::int64_t rays, std::int64_t most, const RayOptions& options) {
  const std::int64_t workers = options.threads > 0 ? options.threads : hardware_threads();
  const std::int64_t fewest = options.threads > 0 ? kFewestOfThread : kFewestOfOpenThread;
  // Scattered rays are sorted within a chunk, so there is one for each thread; others are balanced by several.
  const std::int64_t wanted = options.order == RayOrder::any ? workers : workers * kChunksPerThread;
  const std::int64_t size = std::clamp((rays + wanted - 1) / wanted, std::min(fewest, most), most);
  return (size + kRaysOfBlock - 1) / kRaysOfBlock * kRaysOfBlock;
}

// Calls answer(rays, first, number) for each chunk of the rays on threads: `first` is its first ray. in_images() does
// the same for periodic sets, and returns the first ray of the chunk without an end, or kNothing.
template <class Answer, class InImages>
Status share(const RaySpan& rays, std::int64_t most, const RayOptions& options, const Answer& answer,
             const InImages& in_images) {
  if (options.images != nullptr)
    if (Status status = options.images->check_rays(); !status) return status;
  const std::int64_t size = rays_per_chunk(rays.count, most, options);
  FirstWithoutEnd without_end;
  WatchedWork work;
  try {
    watched_for(options.threads, (rays.count + size - 1) / size, [&](std::int64_t number) {
      const std::int64_t first = number * size;
      const RaySpan chunk = rays.part(first, std::min(size, rays.count - first));
      if (options.images == nullptr)
        answer(chunk, first, number);
      else if (!without_end.is_before(first))
        without_end.take(first, in_images(*options.images, chunk, first, number));
    });
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for this many rays", "", 0, 0, "trace fewer at a time"};
  }
  return without_end.status();
}

const std::int64_t* excluded(const RayOptions& options, std::int64_t first) {
  return options.exclude != nullptr ? options.exclude + first : nullptr;
}

}  // namespace
}  // namespace wide

Status closest_hits(const WideTree& tree, const RaySpan& rays, const HitSpan& hits, const RayOptions& options) {
  return wide::share(
      rays, wide::kMostRaysOfChunk, options,
      [&](const RaySpan& chunk, std::int64_t first, std::int64_t) {
        closest_hits(tree, chunk, options.order, hits.part(first));
      },
      [&](const PeriodicImages& images, const RaySpan& chunk, std::int64_t first, std::int64_t) {
        return images.closest_hits(tree, chunk, hits.part(first), wide::excluded(options, first));
      });
}

Status occluded(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden, const RayOptions& options) {
  return wide::share(
      rays, wide::kMostRaysOfChunk, options,
      [&](const RaySpan& chunk, std::int64_t first, std::int64_t) {
        occluded(tree, chunk, options.order, hidden + first);
      },
      [&](const PeriodicImages& images, const RaySpan& chunk, std::int64_t first, std::int64_t) {
        return images.occluded(tree, chunk, hidden + first, wide::excluded(options, first));
      });
}

Status all_hits(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& hits, const RayOptions& options) {
  hits.clear();
  std::vector<std::vector<RayHit>> of_chunks;
  try {
    of_chunks.resize(static_cast<std::size_t>(rays.count / wide::kRaysOfBlock + 1));
    const auto number_from = [](std::vector<RayHit>& found, std::int64_t first) {
      for (RayHit& hit : found) hit.ray += first;
    };
    Status status = wide::share(
        rays, wide::kMostRaysOfHits, options,
        [&](const RaySpan& chunk, std::int64_t first, std::int64_t number) {
          std::vector<RayHit>& found = of_chunks[static_cast<std::size_t>(number)];
          all_hits(tree, chunk, found);
          number_from(found, first);
        },
        [&](const PeriodicImages& images, const RaySpan& chunk, std::int64_t first, std::int64_t number) {
          std::vector<RayHit>& found = of_chunks[static_cast<std::size_t>(number)];
          const std::int64_t without_end = images.all_hits(tree, chunk, found, wide::excluded(options, first));
          number_from(found, first);
          return without_end;
        });
    if (!status) return status;
    std::size_t total = 0;
    for (const std::vector<RayHit>& found : of_chunks) total += found.size();
    hits.reserve(total);
    for (std::vector<RayHit>& found : of_chunks) {
      hits.insert(hits.end(), found.begin(), found.end());
      found = {};
    }
  } catch (const std::bad_alloc&) {
    hits.clear();
    return Error{"not enough memory for the hits of this many rays", "", 0, 0, "trace fewer at a time"};
  }
  return Done{};
}

}  // namespace bihive
