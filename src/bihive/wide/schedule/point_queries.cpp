// Checks the points, sorts them, hands chunks of them to threads, and stores the answers in the caller's order.
#include "bihive/wide/point_queries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <string>
#include <utility>

#include "bihive/base/watch.h"
#include "bihive/geometry/ray.h"
#include "bihive/wide/schedule/check_reach.h"
#include "bihive/wide/schedule/point_order.h"
#include "bihive/wide/schedule/resize_in_steps.h"
#include "bihive/wide/schedule/tuning.h"
#include "bihive/wide/trace/points.h"

namespace bihive {
namespace wide {
namespace {

// A limit that reaches more images of one sphere is most likely in a wrong unit, and the lists would fill the memory.
constexpr double kMostImages = 1e6;

constexpr double kInfiniteDistance = std::numeric_limits<double>::infinity();

Error no_memory_for_points(std::int64_t points) {
  return {"not enough memory for the answers of " + std::to_string(points) + " points", "", 0, 0,
          "ask for fewer points at a time"};
}

Error bad_point(std::int64_t i, const std::string& what, double value) {
  char number[40];
  std::snprintf(number, sizeof number, "%.9g", value);
  return {"point " + std::to_string(i) + ": " + what + " but is " + number, "", 0, 0, ""};
}

Status check_points(const PointSpan& points) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (std::int64_t i = 0; i < points.count; ++i) {
    if (i % kPointsAtATime == 0) stop_if_cancelled();
    const Vec3d at = points.at(i);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      if (!std::isfinite(at[axis])) return bad_point(i, name + " must be finite", at[axis]);
      if (!(std::abs(at[axis]) <= kLargest))
        return bad_point(i, name + " must fit single precision (3.4e38)", at[axis]);
    }
  }
  return Done{};
}

// Points of a chunk between two looks whether the call is cancelled.
constexpr std::int64_t kPointsBetweenLooks = 32;

// The share of a batch that is done when its points are answered.
constexpr double kShareOfAnswers = 0.9;

// Calls answer(i) for each point, in an order that serves the cache: chunk by chunk on threads. begin(chunks) is called
// before the chunks of a batch, end(first, order, done) after them, whose own share of the work starts there. Throws
// std::bad_alloc, and Cancelled.
template <class Begin, class Answer, class End>
void for_each_point(const WideTree& tree, const PointSpan& points, int threads, const Begin& begin,
                    const Answer& answer, const End& end) {
  PointOrder sorter;
  std::vector<std::uint32_t> order;
  for (std::int64_t first = 0; first < points.count; first += kPointsAtATime) {
    PointSpan part = points;
    part.count = std::min(kPointsAtATime, points.count - first);
    for (const double*& axis : part.axis) axis += first * points.stride;
    sorter.find(tree, part, order);
    const std::int64_t chunks = (part.count + kPointsPerChunk - 1) / kPointsPerChunk;
    begin(chunks);
    const auto share = [&](double of_batch) {
      return (double(first) + of_batch * double(part.count)) / double(points.count);
    };
    watched_for(
        threads, chunks,
        [&](std::int64_t chunk) {
          const std::int64_t last = std::min(part.count, (chunk + 1) * kPointsPerChunk);
          for (std::int64_t k = chunk * kPointsPerChunk; k < last; ++k) {
            if (k % kPointsBetweenLooks == 0) stop_chunk_if_cancelled();
            answer(chunk, first + order[static_cast<std::size_t>(k)]);
          }
        },
        share(0), share(kShareOfAnswers));
    end(first, order, share(kShareOfAnswers));
    stop_if_cancelled(first + part.count == points.count ? 1 : share(1));
  }
}

// Calls find(), which may throw Cancelled and std::bad_alloc, as watched work.
template <class Answers, class Find>
Result<Answers> watched(std::int64_t points, const Find& find) {
  WatchedWork work;
  try {
    return find();
  } catch (const Cancelled&) {
    return cancelled_error();
  } catch (const std::bad_alloc&) {
    return no_memory_for_points(points);
  }
}

// limit(i) is that of point i, in world units.
template <class Limit>
Status check_limits(const WideTree& tree, const PointSpan& points, const Limit& limit, const PointOptions& options) {
  if (Status status = check_points(points); !status) return status;
  for (std::int64_t i = 0; i < points.count; ++i)
    if (std::isnan(limit(i))) return bad_point(i, "the limit must be a number", limit(i));
  if (options.images == nullptr) return Done{};
  double largest = 0;
  for (std::int64_t i = 0; i < points.count; ++i) largest = std::max(largest, limit(i));
  return check_reach(*options.images, largest * tree.scale);
}

// Resizes lists batch by batch, without a copy of them for each.
template <class T>
void grow(std::vector<T>& values, std::size_t size, T value) {
  if (size > values.capacity()) values.reserve(std::max(size, 2 * values.capacity()));
  resize_in_steps(values, size, value);
}

bool is_before_by_id(const NearSphere& a, const NearSphere& b) {
  return a.id != b.id ? a.id < b.id : a.distance < b.distance;
}

// Appends what is near point i, all in stored units, in any order.
void find_near(const WideTree& tree, const PointSpan& points, std::int64_t i, double limit, const PointOptions& options,
               std::vector<NearSphere>& found) {
  const PointQuestion question{tree.stored(points.at(i)), limit, options.to, options.mask};
  const auto first = static_cast<std::ptrdiff_t>(found.size());
  if (options.images != nullptr)
    options.images->find_within(tree, question, found);
  else
    find_within(tree, question, found);
  if (options.exclude == nullptr || options.exclude[i] < 0) return;
  // Of several images the nearest is left out.
  auto own = found.end();
  for (auto one = found.begin() + first; one != found.end(); ++one)
    if (one->id == options.exclude[i] && (own == found.end() || one->distance < own->distance)) own = one;
  if (own != found.end()) found.erase(own);
}

// Leaves out the nearest image of a sphere among `count` answers in order. Returns how many are left, at most `most`.
std::int64_t leave_out(NearSphere* nearest, std::int64_t count, std::int64_t sphere, std::int64_t most) {
  NearSphere* const end = nearest + count;
  NearSphere* const own = std::find_if(nearest, end, [&](const NearSphere& one) { return one.id == sphere; });
  if (own != end) {
    std::copy(own + 1, end, own);
    --count;
  }
  return std::min(count, most);
}

// limit(i) is that of point i, in world units.
template <class Limit>
Result<SphereLists> find_lists(const WideTree& tree, const PointSpan& points, const Limit& limit,
                               const PointOptions& options) {
  return watched<SphereLists>(points.count, [&]() -> Result<SphereLists> {
    if (Status status = check_limits(tree, points, limit, options); !status) return status.error();
    SphereLists lists;
    lists.begin.assign(static_cast<std::size_t>(points.count) + 1, 0);
    const double unit = 1 / tree.scale;
    std::vector<std::vector<NearSphere>> found;
    const auto count_of = [&](std::int64_t i) -> std::int64_t& { return lists.begin[static_cast<std::size_t>(i) + 1]; };
    for_each_point(
        tree, points, options.threads,
        [&](std::int64_t chunks) {
          found.clear();
          found.resize(static_cast<std::size_t>(chunks));
        },
        [&](std::int64_t chunk, std::int64_t i) {
          std::vector<NearSphere>& here = found[static_cast<std::size_t>(chunk)];
          const std::size_t known = here.size();
          find_near(tree, points, i, limit(i) * tree.scale, options, here);
          std::sort(here.begin() + static_cast<std::ptrdiff_t>(known), here.end(), is_before_by_id);
          count_of(i) = static_cast<std::int64_t>(here.size() - known);
        },
        [&](std::int64_t first, const std::vector<std::uint32_t>& order, double done) {
          // Turn the counts of this batch into offsets, then copy.
          const auto part = static_cast<std::int64_t>(order.size());
          for (std::int64_t i = first; i < first + part; ++i) count_of(i) += lists.begin[static_cast<std::size_t>(i)];
          const auto total = static_cast<std::size_t>(lists.begin[static_cast<std::size_t>(first + part)]);
          grow(lists.sphere_id, total, kNothing);
          grow(lists.distance, total, 0.0);
          const auto copy = [&](std::int64_t chunk) {
            const std::vector<NearSphere>& here = found[static_cast<std::size_t>(chunk)];
            std::size_t next = 0;
            const std::int64_t last = std::min(part, (chunk + 1) * kPointsPerChunk);
            for (std::int64_t k = chunk * kPointsPerChunk; k < last; ++k) {
              const auto i = static_cast<std::size_t>(first + order[static_cast<std::size_t>(k)]);
              for (auto to = static_cast<std::size_t>(lists.begin[i]);
                   to < static_cast<std::size_t>(lists.begin[i + 1]); ++to, ++next) {
                lists.sphere_id[to] = here[next].id;
                lists.distance[to] = here[next].distance * unit;
              }
            }
          };
          watched_for(options.threads, static_cast<std::int64_t>(found.size()), copy, done, done);
        });
    return lists;
  });
}

}  // namespace

Status check_reach(const PeriodicImages& images, double limit) {
  if (images.images_within(limit) <= kMostImages) return Done{};
  return Error{"the limit of the distance reaches more than a million images of the periodic cell", "", 0, 0,
               "ask for a smaller distance, or without images"};
}

}  // namespace wide

Result<NearestSpheres> nearest_spheres(const WideTree& tree, const PointSpan& points, std::int64_t per_point,
                                       double within, const PointOptions& options) {
  return wide::watched<NearestSpheres>(points.count, [&]() -> Result<NearestSpheres> {
    if (Status status = wide::check_points(points); !status) return status.error();
    if (per_point < 1)
      return Error{"the number of nearest spheres must be at least 1 but is " + std::to_string(per_point), "", 0, 0,
                   ""};
    if (std::isnan(within)) return Error{"the limit of the distance must be a number but is nan", "", 0, 0, ""};
    NearestSpheres nearest;
    nearest.per_point = per_point;
    if (points.count > 0 && per_point > static_cast<std::int64_t>(nearest.distance.max_size()) / points.count)
      return wide::no_memory_for_points(points.count);
    const auto entries = static_cast<std::size_t>(points.count * per_point);
    wide::resize_in_steps(nearest.distance, entries, wide::kInfiniteDistance);
    wide::resize_in_steps(nearest.sphere_id, entries, kNothing);
    const double unit = 1 / tree.scale;
    const bool periodic = options.images != nullptr;
    const std::int64_t most = periodic ? per_point : std::min(per_point, std::max<std::int64_t>(1, tree.size));
    std::vector<std::vector<wide::NearSphere>> rooms;
    wide::for_each_point(
        tree, points, options.threads, [&](std::int64_t chunks) { rooms.resize(static_cast<std::size_t>(chunks)); },
        [&](std::int64_t chunk, std::int64_t i) {
          std::vector<wide::NearSphere>& room = rooms[static_cast<std::size_t>(chunk)];
          const bool has_own = options.exclude != nullptr && options.exclude[i] >= 0;
          const std::int64_t wanted = most + (has_own ? 1 : 0);
          room.resize(static_cast<std::size_t>(wanted));
          const wide::PointQuestion question{tree.stored(points.at(i)), within * tree.scale, options.to, options.mask};
          std::int64_t count = periodic ? options.images->find_nearest(tree, question, wanted, room.data())
                                        : wide::find_nearest(tree, question, wanted, room.data());
          if (has_own) count = wide::leave_out(room.data(), count, options.exclude[i], most);
          for (std::int64_t k = 0; k < count; ++k) {
            const auto to = static_cast<std::size_t>(i * per_point + k);
            nearest.distance[to] = room[static_cast<std::size_t>(k)].distance * unit;
            nearest.sphere_id[to] = room[static_cast<std::size_t>(k)].id;
          }
        },
        [&](std::int64_t, const std::vector<std::uint32_t>&, double) { rooms.clear(); });
    return nearest;
  });
}

Result<SphereLists> spheres_within(const WideTree& tree, const PointSpan& points, const double* limits,
                                   const PointOptions& options) {
  return wide::find_lists(
      tree, points, [limits](std::int64_t i) { return limits[i]; }, options);
}

Result<SphereLists> spheres_within(const WideTree& tree, const PointSpan& points, double limit,
                                   const PointOptions& options) {
  return wide::find_lists(
      tree, points, [limit](std::int64_t) { return limit; }, options);
}

Result<std::vector<std::int64_t>> count_within(const WideTree& tree, const PointSpan& points, const double* limits,
                                               const PointOptions& options) {
  const auto limit = [limits](std::int64_t i) { return limits[i]; };
  using Counts = std::vector<std::int64_t>;
  return wide::watched<Counts>(points.count, [&]() -> Result<Counts> {
    if (Status status = wide::check_limits(tree, points, limit, options); !status) return status.error();
    Counts counts(static_cast<std::size_t>(points.count));
    std::vector<std::vector<wide::NearSphere>> rooms;
    wide::for_each_point(
        tree, points, options.threads, [&](std::int64_t chunks) { rooms.resize(static_cast<std::size_t>(chunks)); },
        [&](std::int64_t chunk, std::int64_t i) {
          std::vector<wide::NearSphere>& room = rooms[static_cast<std::size_t>(chunk)];
          room.clear();
          wide::find_near(tree, points, i, limit(i) * tree.scale, options, room);
          counts[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(room.size());
        },
        [](std::int64_t, const std::vector<std::uint32_t>&, double) {});
    return counts;
  });
}

Result<SphereLists> spheres_containing(const WideTree& tree, const PointSpan& points, PointOptions options) {
  options.to = DistanceTo::surface;
  return spheres_within(tree, points, 0.0, options);
}

Result<SphereLists> spheres_overlapping(const WideTree& tree, const PointSpan& points, const double* radii,
                                        PointOptions options) {
  options.to = DistanceTo::surface;
  for (std::int64_t i = 0; i < points.count; ++i)
    if (!(radii[i] >= 0 && std::isfinite(radii[i])))
      return wide::bad_point(i, "the radius must be finite and not negative", radii[i]);
  return spheres_within(tree, points, radii, options);
}

}  // namespace bihive
