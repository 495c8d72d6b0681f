// The rays and points that structures are compared by: made from a scene and a seed, the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/compare/structure.h"
#include "bihive/scene/scene.h"
#include "bihive/wide/ray_batch.h"

namespace bihive::workbench {

/// primary: the camera's, through the pixels of a square picture, in blocks of 8 x 8. random: from anywhere in the
/// spheres' box, in any direction. shadow: from the primary hits that face the first light to it (any hit). mirror:
/// mirrored at the primary hits. ao: from the primary hits, one direction each, more often near the normal (any hit).
/// points: anywhere in the spheres' box; asked is the nearest sphere.
enum class QueryKind { primary, random, shadow, mirror, ao, points };

struct QueryKindRow {
  QueryKind kind;
  const char* name;
  bool any_hit;
};
constexpr std::array<QueryKindRow, 6> kQueryKinds{{{QueryKind::primary, "primary", false},
                                                   {QueryKind::random, "random", false},
                                                   {QueryKind::shadow, "shadow", true},
                                                   {QueryKind::mirror, "mirror", false},
                                                   {QueryKind::ao, "ao", true},
                                                   {QueryKind::points, "points", false}}};
/// Error: there is none of this name; the message lists all.
Result<QueryKind> query_kind_named(const std::string& name);
/// One for each name. Error: an unknown one, or one that stands twice.
Result<std::vector<QueryKind>> query_kinds_named(const std::vector<std::string>& names);
const QueryKindRow& row_of(QueryKind kind);

/// Rays, or points: world units, x, y, z one after the other.
struct QuerySet {
  QueryKind kind = QueryKind::primary;
  RayOrder order = RayOrder::any;
  RayBatch rays;
  std::vector<double> points;

  std::int64_t size() const {
    return kind == QueryKind::points ? static_cast<std::int64_t>(points.size()) / 3 : rays.size();
  }
};

/// Gives a scene without a camera one in front of all spheres, and one without lights a light behind the camera: what
/// make_query_sets() needs. The camera that `has_camera` speaks of passes check_camera().
void complete_for_queries(Scene& scene, bool has_camera, bool has_lights);

/// Pixels along each side of the square picture whose rays are the primary ones.
int side_of_primary_px(std::int64_t count);
/// Its ray through the centre of a pixel, (0, 0) at the top left. The scene has a camera that passes check_camera().
Ray primary_ray(const Scene& scene, int side_px, int x, int y);

/// One set for each kind. `count`: of primary, random and points; primary rays are rounded to whole blocks. Those that
/// start at hits are as many as there are such hits: maybe none. The scene has a camera that passes check_camera(),
/// and at least one sphere; clips, sticks and plane do not count. Without lights shadow rays go to the eye. `spheres`
/// finds the primary hits.
std::vector<QuerySet> make_query_sets(const Scene& scene, const std::vector<QueryKind>& kinds, std::int64_t count,
                                      const Structure& spheres);

/// The query of a set of `size` that is number i of an evenly spaced sample of `count`; sizes below 2^31.
inline std::int64_t position_in_sample(std::int64_t i, std::int64_t count, std::int64_t size) {
  return i * size / count;
}
/// `count` of its queries, evenly spaced; all of them if it has no more.
QuerySet sample_of(const QuerySet& set, std::int64_t count);
/// The queries of these numbers, in this order.
QuerySet subset_of(const QuerySet& set, const std::vector<std::int64_t>& numbers);

}  // namespace bihive::workbench
