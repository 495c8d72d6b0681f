// Trees, rays and points of bihive.h.
#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive.h"
#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/base/watch.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/surface_of_hit.h"
#include "bihive/wide/wide_builder.h"
#include "c_errors.h"
#include "c_progress.h"
#include "c_ray_chunks.h"
#include "c_spheres.h"
#include "c_tree.h"

namespace bihive::c {
namespace {

bool ready(const bihive_tree* tree, const bihive_rays* rays) {
  return tree != nullptr && are_ready(rays);
}

template <class Answer>
int for_parts(const bihive_tree& tree, const bihive_rays& rays, int threads, const Answer& answer) {
  return for_chunks(tree.tree->origin, rays, threads, answer);
}

int check_point_arguments(const bihive_tree* tree, const double* xyz, std::int64_t count, int distance_to,
                          int threads) {
  if (tree == nullptr) return failed("the tree is NULL");
  if (count < 0) return failed("the number of points is negative");
  if (count > 0 && xyz == nullptr) return failed("the points are NULL");
  if (distance_to != BIHIVE_SURFACE && distance_to != BIHIVE_CENTRE)
    return failed("distance_to is neither BIHIVE_SURFACE nor BIHIVE_CENTRE");
  if (threads < 0) return failed("the number of threads is negative; 0 takes all");
  return kDone;
}

PointOptions options_of(const bihive_tree& tree, int distance_to, const std::uint8_t* mask, const std::int64_t* exclude,
                        int threads) {
  return {distance_to == BIHIVE_CENTRE ? DistanceTo::centre : DistanceTo::surface, mask, threads,
          tree.images ? &*tree.images : nullptr, exclude};
}

// The same where rays may see images. in_images(images, rays, first, chunk) returns a ray of the chunk without an end,
// or kNothing.
template <class Answer, class InImages>
int for_rays(const bihive_tree& tree, const bihive_rays& rays, int threads, const Answer& answer,
             const InImages& in_images) {
  if (!tree.images) return for_parts(tree, rays, threads, answer);
  if (const Status status = tree.images->check_rays(); !status) return failed(status.error());
  FirstWithoutEnd without_end;
  const int done = for_parts(tree, rays, threads, [&](const RaySpan& part, std::int64_t first, std::int64_t number) {
    if (!without_end.is_before(first)) without_end.take(first, in_images(*tree.images, part, first, number));
  });
  if (done != kDone) return done;
  const Status status = without_end.status();
  return status ? kDone : failed(status.error());
}

int check_spheres(const double* xyz, const double* radii, std::int64_t count, int threads) {
  if (count < 0) return failed("the number of spheres is negative");
  if (count > 0 && (xyz == nullptr || radii == nullptr)) return failed("the spheres are NULL");
  if (threads < 0) return failed("the number of threads is negative; 0 takes all");
  return kDone;
}

// Nine numbers.
Result<Cell> cell_of(const double* vectors) {
  Cell cell;
  for (std::size_t i = 0; i < 9; ++i) cell.vectors[i / 3][static_cast<int>(i % 3)] = vectors[i];
  for (const Vec3d& vector : cell.vectors)
    if (!is_finite(vector)) return Error{"the vectors of the cell must be finite", "", 0, 0, ""};
  return cell;
}

// Fills the tree, which stays as it is after a failure.
int fill(bihive_tree& tree, WideBuilder& builder, const double* xyz, const double* radii, std::int64_t count,
         const std::optional<Cell>& cell, int threads, Work* work) {
  std::string warning;
  auto spheres = spheres_of(xyz, radii, count, &warning);
  if (!spheres) return failed(spheres.error());
  spheres->cell() = cell;
  const double share_of_tree = cell ? 0.9 : 1;
  std::shared_ptr<const WideTree> built;
  {
    const Section section(work, 0, share_of_tree);
    Result<std::shared_ptr<const WideTree>> result = builder.build(*spheres, {}, threads);
    if (!result) return failed(result.error());
    built = std::move(*result);
  }
  std::optional<PeriodicImages> images;
  if (cell) {
    const Section section(work, share_of_tree, 1);
    auto result = PeriodicImages::of(*spheres, threads);
    if (!result) return failed(result.error());
    images = std::move(*result);
  }
  tree.tree = std::move(built);
  tree.spheres = std::move(*spheres);
  tree.warning = std::move(warning);
  tree.images = std::move(images);
  return kDone;
}

// `vectors` holds the 9 numbers of the periodic cell; null without a cell.
int make_tree(const double* xyz, const double* radii, std::int64_t count, const double* vectors, int threads,
              bihive_tree** tree) {
  if (tree == nullptr) return failed("there is no place for the tree");
  *tree = nullptr;
  return guarded_long([&](Work* work) {
    if (check_spheres(xyz, radii, count, threads) != kDone) return kFailed;
    std::optional<Cell> cell;
    if (vectors != nullptr) {
      const Result<Cell> given = cell_of(vectors);
      if (!given) return failed(given.error());
      cell = *given;
    }
    auto made = std::make_unique<bihive_tree>();
    WideBuilder builder;
    if (const int state = fill(*made, builder, xyz, radii, count, cell, threads, work); state != kDone) return state;
    *tree = made.release();
    return kDone;
  });
}

}  // namespace
}  // namespace bihive::c

using namespace bihive;     // NOLINT(google-build-using-namespace): the functions below are C's
using namespace bihive::c;  // NOLINT(google-build-using-namespace)

const char* bihive_version(void) {
  static const std::string text(version());
  return text.c_str();
}

const char* bihive_error_text(void) {
  return last_error();
}

int bihive_tree_new(const double* xyz, const double* radii, int64_t count, int threads, bihive_tree** tree) {
  return make_tree(xyz, radii, count, nullptr, threads, tree);
}

int bihive_tree_new_in_cell(const double* xyz, const double* radii, int64_t count, const double* vectors, int threads,
                            bihive_tree** tree) {
  if (vectors == nullptr) return failed("the vectors of the cell are NULL");
  return make_tree(xyz, radii, count, vectors, threads, tree);
}

int bihive_tree_update(bihive_tree* tree, const double* xyz, const double* radii, int64_t count, const double* vectors,
                       int threads) {
  return guarded_long([&](Work* work) {
    if (tree == nullptr) return failed("the tree is NULL");
    const std::int64_t size = tree->spheres.size();
    std::vector<double> same_radii;
    if (radii == nullptr && count == size) {
      same_radii.resize(static_cast<std::size_t>(size));
      for (std::int64_t id = 0; id < size; ++id) same_radii[static_cast<std::size_t>(id)] = tree->spheres.radius(id);
      radii = same_radii.data();
    }
    if (count != size)
      return failed(Error{"the tree has " + std::to_string(size) + " spheres, and these are " + std::to_string(count),
                          "", 0, 0, "make another tree"});
    if (check_spheres(xyz, radii, count, threads) != kDone) return kFailed;
    std::optional<Cell> cell = tree->spheres.cell();
    if (vectors != nullptr) {
      if (!cell) return failed("the tree has no cell: make it with bihive_tree_new_in_cell()");
      const Result<Cell> given = cell_of(vectors);
      if (!given) return failed(given.error());
      cell = *given;
    }
    if (tree->builder == nullptr) tree->builder = std::make_unique<WideBuilder>();
    return fill(*tree, *tree->builder, xyz, radii, count, cell, threads, work);
  });
}

void bihive_tree_free(bihive_tree* tree) {
  delete tree;
}

const char* bihive_tree_warning(const bihive_tree* tree) {
  return tree == nullptr ? "" : tree->warning.c_str();
}

int64_t bihive_tree_size(const bihive_tree* tree) {
  return tree == nullptr ? 0 : tree->tree->size;
}

int bihive_closest(const bihive_tree* tree, const bihive_rays* rays, int threads, double* t, int64_t* spheres) {
  return guarded_query([&] {
    if (!ready(tree, rays) || threads < 0) return failed("tree or rays are NULL, or a number is negative");
    if (rays->count > 0 && (t == nullptr || spheres == nullptr)) return failed("there is no place for the hits");
    const HitSpan hits{t, spheres};
    return for_rays(
        *tree, *rays, threads,
        [&](const RaySpan& part, std::int64_t first, std::int64_t) {
          closest_hits(*tree->tree, part, RayOrder::any, hits.part(first));
        },
        [&](const PeriodicImages& images, const RaySpan& part, std::int64_t first, std::int64_t) {
          return images.closest_hits(*tree->tree, part, hits.part(first));
        });
  });
}

int bihive_occluded(const bihive_tree* tree, const bihive_rays* rays, int threads, uint8_t* hidden) {
  return guarded_query([&] {
    if (!ready(tree, rays) || threads < 0) return failed("tree or rays are NULL, or a number is negative");
    if (rays->count > 0 && hidden == nullptr) return failed("there is no place for the answers");
    return for_rays(
        *tree, *rays, threads,
        [&](const RaySpan& part, std::int64_t first, std::int64_t) {
          occluded(*tree->tree, part, RayOrder::any, hidden + first);
        },
        [&](const PeriodicImages& images, const RaySpan& part, std::int64_t first, std::int64_t) {
          return images.occluded(*tree->tree, part, hidden + first);
        });
  });
}

int bihive_nearest_others(const bihive_tree* tree, const double* xyz, int64_t count, int64_t most, double within,
                          int distance_to, const uint8_t* mask, const int64_t* exclude, int threads, double* distances,
                          int64_t* spheres) {
  return guarded_query([&] {
    if (check_point_arguments(tree, xyz, count, distance_to, threads) != kDone) return kFailed;
    if (count > 0 && (distances == nullptr || spheres == nullptr)) return failed("there is no place for the spheres");
    const auto nearest = nearest_spheres(*tree->tree, PointSpan::rows(xyz, count), most, within,
                                         options_of(*tree, distance_to, mask, exclude, threads));
    if (!nearest) return failed(nearest.error());
    std::copy(nearest->distance.begin(), nearest->distance.end(), distances);
    std::copy(nearest->sphere_id.begin(), nearest->sphere_id.end(), spheres);
    return kDone;
  });
}

int bihive_nearest(const bihive_tree* tree, const double* xyz, int64_t count, int64_t most, double within,
                   int distance_to, const uint8_t* mask, int threads, double* distances, int64_t* spheres) {
  return bihive_nearest_others(tree, xyz, count, most, within, distance_to, mask, nullptr, threads, distances, spheres);
}

const int64_t* bihive_lists_begin(const bihive_lists* lists) {
  return lists->begin.data();
}

const int64_t* bihive_lists_spheres(const bihive_lists* lists) {
  return lists->spheres.data();
}

const double* bihive_lists_distances(const bihive_lists* lists) {
  return lists->distances.data();
}

void bihive_lists_free(bihive_lists* lists) {
  delete lists;
}

int bihive_within_others(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                         int distance_to, const uint8_t* mask, const int64_t* exclude, int threads,
                         bihive_lists** lists) {
  if (lists == nullptr) return failed("there is no place for the lists");
  *lists = nullptr;
  return guarded_query([&] {
    if (check_point_arguments(tree, xyz, count, distance_to, threads) != kDone) return kFailed;
    const PointSpan points = PointSpan::rows(xyz, count);
    const PointOptions options = options_of(*tree, distance_to, mask, exclude, threads);
    auto found = limits != nullptr ? spheres_within(*tree->tree, points, limits, options)
                                   : spheres_within(*tree->tree, points, 0.0, options);
    if (!found) return failed(found.error());
    *lists = new bihive_lists{std::move(found->begin), std::move(found->sphere_id), std::move(found->distance)};
    return kDone;
  });
}

int bihive_count_others_within(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                               int distance_to, const uint8_t* mask, const int64_t* exclude, int threads,
                               int64_t* counts) {
  return guarded_query([&] {
    if (check_point_arguments(tree, xyz, count, distance_to, threads) != kDone) return kFailed;
    if (count > 0 && counts == nullptr) return failed("there is no place for the counts");
    const std::vector<double> zeros(limits == nullptr ? static_cast<std::size_t>(count) : 0);
    const auto found = count_within(*tree->tree, PointSpan::rows(xyz, count), limits != nullptr ? limits : zeros.data(),
                                    options_of(*tree, distance_to, mask, exclude, threads));
    if (!found) return failed(found.error());
    std::copy(found->begin(), found->end(), counts);
    return kDone;
  });
}

int bihive_within(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits, int distance_to,
                  const uint8_t* mask, int threads, bihive_lists** lists) {
  return bihive_within_others(tree, xyz, count, limits, distance_to, mask, nullptr, threads, lists);
}

int bihive_count_within(const bihive_tree* tree, const double* xyz, int64_t count, const double* limits,
                        int distance_to, const uint8_t* mask, int threads, int64_t* counts) {
  return bihive_count_others_within(tree, xyz, count, limits, distance_to, mask, nullptr, threads, counts);
}

int bihive_pairs(const bihive_tree* tree, double reach, int distance_to, const uint8_t* mask, int threads,
                 bihive_lists** lists) {
  if (lists == nullptr) return failed("there is no place for the lists");
  *lists = nullptr;
  return guarded_query([&] {
    if (check_point_arguments(tree, nullptr, 0, distance_to, threads) != kDone) return kFailed;
    auto pairs =
        sphere_pairs(*tree->tree, tree->spheres, reach, options_of(*tree, distance_to, mask, nullptr, threads));
    if (!pairs) return failed(pairs.error());
    auto made = std::make_unique<bihive_lists>();
    made->begin.assign(static_cast<std::size_t>(tree->spheres.size()) + 1, 0);
    for (const std::int64_t first : pairs->first) ++made->begin[static_cast<std::size_t>(first) + 1];
    for (std::size_t i = 1; i < made->begin.size(); ++i) made->begin[i] += made->begin[i - 1];
    made->spheres = std::move(pairs->second);
    made->distances = std::move(pairs->distance);
    *lists = made.release();
    return kDone;
  });
}

int bihive_surfaces(const bihive_tree* tree, const bihive_rays* rays, const double* t, const int64_t* spheres,
                    int threads, double* positions, double* normals, double* exits) {
  return guarded_query([&] {
    if (!ready(tree, rays) || threads < 0) return failed("tree or rays are NULL, or a number is negative");
    if (rays->count > 0 && (t == nullptr || spheres == nullptr)) return failed("the hits are NULL");
    const PeriodicImages* const images = tree->images ? &*tree->images : nullptr;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::atomic<bool> are_others{false};
    const auto put = [](Vec3d vector, double* to) {
      for (int axis = 0; axis < 3; ++axis) to[axis] = vector[axis];
    };
    const int done = for_parts(*tree, *rays, threads, [&](const RaySpan& part, std::int64_t first, std::int64_t) {
      for (std::int64_t i = 0; i < part.count; ++i) {
        const std::int64_t at = first + i;
        std::optional<HitSurface> surface;
        if (spheres[at] >= 0) {
          surface = surface_of_hit(tree->spheres, images, part.at(i), t[at], spheres[at]);
          if (!surface) are_others = true;
        }
        if (positions != nullptr) put(surface ? surface->position : Vec3d{nan, nan, nan}, positions + 3 * at);
        if (normals != nullptr) put(surface ? surface->normal : Vec3d{nan, nan, nan}, normals + 3 * at);
        if (exits != nullptr) exits[at] = surface ? surface->t_exit : nan;
      }
    });
    if (done != kDone) return done;
    return are_others ? failed("a hit is not that of its ray: hand in the rays that bihive_closest had") : kDone;
  });
}

int bihive_all_hits(const bihive_tree* tree, const bihive_rays* rays, int threads, bihive_lists** lists) {
  if (lists == nullptr) return failed("there is no place for the lists");
  *lists = nullptr;
  return guarded_query([&] {
    if (!ready(tree, rays) || threads < 0) return failed("tree or rays are NULL, or a number is negative");
    const Parts parts = Parts::of(rays->count, threads);
    std::vector<std::vector<RayHit>> of_part(static_cast<std::size_t>(parts.count));
    const int done = for_rays(
        *tree, *rays, threads,
        [&](const RaySpan& part, std::int64_t, std::int64_t number) {
          all_hits(*tree->tree, part, of_part[static_cast<std::size_t>(number)]);
        },
        [&](const PeriodicImages& images, const RaySpan& part, std::int64_t, std::int64_t number) {
          return images.all_hits(*tree->tree, part, of_part[static_cast<std::size_t>(number)]);
        });
    if (done != kDone) return done;
    // The hits of each chunk are in order: count them for each ray, and concatenate them.
    auto made = std::make_unique<bihive_lists>();
    made->begin.assign(static_cast<std::size_t>(rays->count) + 1, 0);
    std::int64_t first = 0;
    for (std::vector<RayHit>& hits : of_part) {
      stop_if_cancelled();
      for (const RayHit& hit : hits) {
        ++made->begin[static_cast<std::size_t>(first + hit.ray) + 1];
        made->spheres.push_back(hit.sphere_id);
        made->distances.push_back(hit.t);
      }
      std::vector<RayHit>().swap(hits);
      first += parts.size;
    }
    for (std::size_t i = 1; i < made->begin.size(); ++i) made->begin[i] += made->begin[i - 1];
    *lists = made.release();
    return kDone;
  });
}
