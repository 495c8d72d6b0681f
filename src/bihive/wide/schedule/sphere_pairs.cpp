// Every pair of near spheres: leaf by leaf where the tree allows it, else sphere by sphere, on threads.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/schedule/check_reach.h"
#include "bihive/wide/schedule/resize_in_steps.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/trace/points.h"

namespace bihive {
namespace wide {
namespace {

// The pairs of some first spheres, one sphere after the other: with the larger ids, in order.
struct FoundPairs {
  std::vector<std::int64_t> first, counts;
  std::vector<NearSphere> second;

  void clear() {
    first.clear();
    counts.clear();
    second.clear();
  }
};

// Stored units.
struct PairSearch {
  const WideTree& tree;
  const SphereSet& spheres;
  const PointOptions& options;
  double reach;

  bool counts(std::int64_t id) const { return options.mask == nullptr || options.mask[id] != 0; }

  // Of one sphere, by its own walk through the tree.
  void find_of_sphere(std::int64_t id, FoundPairs& pairs) const {
    std::vector<NearSphere>& near = pairs.second;
    const std::size_t known = near.size();
    if (counts(id)) {
      const double limit = options.to == DistanceTo::surface ? reach + spheres.stored_radius(id) : reach;
      const PointQuestion question{spheres.stored_centre(id), limit, options.to, options.mask};
      if (options.images != nullptr)
        options.images->find_within(tree, question, near);
      else
        find_within(tree, question, near);
    }
    // Each pair is found from both ends; the smaller id keeps it.
    const auto begin = near.begin() + static_cast<std::ptrdiff_t>(known);
    near.erase(std::remove_if(begin, near.end(), [id](const NearSphere& one) { return one.id < id; }), near.end());
    std::sort(begin, near.end(), [](const NearSphere& a, const NearSphere& b) {
      return a.id != b.id ? a.id < b.id : a.distance < b.distance;
    });
    // The sphere itself is in front, then its images, each of them next to the opposite one.
    const auto end_of_own = std::find_if(begin, near.end(), [id](const NearSphere& one) { return one.id != id; });
    auto to = begin;
    for (auto from = begin; from < end_of_own; ++from)
      if ((from - begin) % 2 == 1) *to++ = *from;
    near.erase(to, end_of_own);
    pairs.first.push_back(id);
    pairs.counts.push_back(static_cast<std::int64_t>(near.size() - known));
  }

  // Of the leaves of one node, each at a time.
  void find_of_node(std::int64_t number, FoundPairs& pairs) const {
    const WideNode& node = tree.nodes[number];
    for (int slot = 0; slot < node.child_count; ++slot) {
      const std::int64_t first = node.sphere_begin(slot), count = node.sphere_count(slot);
      if (!node.is_leaf(slot) || count == 0) continue;
      stop_chunk_if_cancelled();
      const std::size_t known = pairs.counts.size();
      for (std::int64_t k = first; k < first + count; ++k) pairs.first.push_back(tree.spheres.id(k));
      pairs.counts.resize(known + static_cast<std::size_t>(count));
      find_pairs_of_leaf(tree, first, count, reach, options.to, options.mask, pairs.second,
                         pairs.counts.data() + known);
    }
  }
};

Error no_memory() {
  return {"not enough memory for the pairs", "", 0, 0, "ask for a smaller distance"};
}

constexpr std::int64_t kNodesPerChunk = 16;
// A thread keeps the memory of up to this number of pairs, half a megabyte.
constexpr std::size_t kMostKeptPairs = 1 << 15;
constexpr std::int64_t kSpheresBetweenLooks = 32;
// The share of the work that is done when all pairs are found, before they are copied.
constexpr double kShareOfSearch = 0.8;

}  // namespace
}  // namespace wide

Result<SpherePairs> sphere_pairs(const WideTree& tree, const SphereSet& spheres, double reach,
                                 const PointOptions& options) {
  if (std::isnan(reach)) return Error{"the limit of the distance must be a number but is nan", "", 0, 0, ""};
  const wide::PairSearch search{tree, spheres, options, reach * tree.scale};
  if (options.images != nullptr) {
    const double largest = spheres.empty() ? 0 : double(*std::max_element(spheres.r().begin(), spheres.r().end()));
    if (Status status = wide::check_reach(*options.images, search.reach + largest); !status) return status.error();
  }
  WatchedWork work;
  try {
    // Find them in chunks.
    const bool by_leaves = options.images == nullptr && tree.piles.empty() && !tree.is_image;
    const std::int64_t items = by_leaves ? tree.node_count : spheres.size();
    const std::int64_t per_chunk = by_leaves ? wide::kNodesPerChunk : wide::kPointsPerChunk;
    // Small memory is kept for the next call: to get it anew from the system takes as long as to find a thousand pairs.
    thread_local std::vector<wide::FoundPairs> kept;
    std::vector<wide::FoundPairs> found = std::exchange(kept, {});
    found.resize(static_cast<std::size_t>((items + per_chunk - 1) / per_chunk));
    const auto each_chunk = [&](double begin, double end, const auto& use) {
      watched_for(
          options.threads, static_cast<std::int64_t>(found.size()),
          [&](std::int64_t chunk) { use(chunk, found[static_cast<std::size_t>(chunk)]); }, begin, end);
    };
    each_chunk(0, wide::kShareOfSearch, [&](std::int64_t chunk, wide::FoundPairs& pairs) {
      for (std::int64_t item = chunk * per_chunk; item < std::min(items, (chunk + 1) * per_chunk); ++item) {
        if (by_leaves) {
          search.find_of_node(item, pairs);
        } else {
          if (item % wide::kSpheresBetweenLooks == 0) stop_chunk_if_cancelled();
          search.find_of_sphere(item, pairs);
        }
      }
    });

    // Copy them in the order of their first spheres.
    std::vector<std::int64_t> begin(static_cast<std::size_t>(spheres.size()) + 1, 0);
    for (const wide::FoundPairs& pairs : found)
      for (std::size_t k = 0; k < pairs.first.size(); ++k)
        begin[static_cast<std::size_t>(pairs.first[k]) + 1] = pairs.counts[k];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    SpherePairs made;
    const auto total = static_cast<std::size_t>(begin.back());
    wide::resize_in_steps(made.first, total, kNothing);
    wide::resize_in_steps(made.second, total, kNothing);
    wide::resize_in_steps(made.distance, total, 0.0);
    const double unit = 1 / tree.scale;
    each_chunk(wide::kShareOfSearch, 1, [&](std::int64_t, wide::FoundPairs& pairs) {
      auto from = pairs.second.begin();
      for (std::size_t k = 0; k < pairs.first.size(); ++k) {
        const std::int64_t id = pairs.first[k];
        const double radius = options.to == DistanceTo::surface ? spheres.stored_radius(id) : 0;
        auto to = static_cast<std::size_t>(begin[static_cast<std::size_t>(id)]);
        for (std::int64_t count = pairs.counts[k]; count > 0; --count, ++from, ++to) {
          made.first[to] = id;
          made.second[to] = from->id;
          made.distance[to] = (from->distance - radius) * unit;
        }
      }
      if (total > wide::kMostKeptPairs) pairs = {};
      pairs.clear();
    });
    if (total <= wide::kMostKeptPairs) kept = std::move(found);
    return made;
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return wide::no_memory();
  }
}

}  // namespace bihive
