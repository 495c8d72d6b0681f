#include "bihive/compare/query_sets.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/near_name.h"
#include "bihive/math/rng.h"
#include "bihive/render/shading.h"
#include "bihive/render/surface.h"
#include "bihive/scene/framing.h"

namespace bihive::workbench {
namespace {

constexpr int kBlock = 8;
constexpr std::uint64_t kSeed = 7;

double between(SplitMix64& random, double lo, double hi) {
  return lo + (hi - lo) * random.next_double();
}

Vec3d position_in(SplitMix64& random, const SphereSet::Bounds& bounds) {
  Vec3d position;
  for (int axis = 0; axis < 3; ++axis) position[axis] = between(random, bounds.lo[axis], bounds.hi[axis]);
  return position;
}

// Uniform on the unit sphere.
Vec3d any_direction(SplitMix64& random) {
  Vec3d direction;
  double squared = 0;
  do {
    for (int axis = 0; axis < 3; ++axis) direction[axis] = between(random, -1, 1);
    squared = dot(direction, direction);
  } while (squared > 1 || squared < 1e-3);
  return direction / std::sqrt(squared);
}

RayBatch primary_rays(const Scene& scene, std::int64_t count) {
  const int blocks = side_of_primary_px(count) / kBlock;
  const PixelRays pixels(local_camera(scene), blocks * kBlock, blocks * kBlock);
  RayBatch rays;
  for (int block = 0; block < blocks * blocks; ++block)
    for (int i = 0; i < kBlock * kBlock; ++i)
      rays.push_back(pixels.at(block % blocks * kBlock + i % kBlock + 0.5, block / blocks * kBlock + i / kBlock + 0.5));
  return rays;
}

RayBatch random_rays(const SphereSet& spheres, std::int64_t count) {
  SplitMix64 random(kSeed);
  const SphereSet::Bounds bounds = spheres.bounds();
  RayBatch rays;
  for (std::int64_t i = 0; i < count; ++i) {
    Ray ray;
    ray.origin = to_float(spheres.to_local(position_in(random, bounds)));
    ray.direction = to_float(any_direction(random));
    rays.push_back(ray);
  }
  return rays;
}

std::vector<double> random_points(const SphereSet& spheres, std::int64_t count) {
  SplitMix64 random(kSeed + 1);
  const SphereSet::Bounds bounds = spheres.bounds();
  std::vector<double> points;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3d point = position_in(random, bounds);
    points.insert(points.end(), {point.x, point.y, point.z});
  }
  return points;
}

// The surfaces that primary rays meet.
std::vector<Surface> surfaces_of(const Scene& scene, const RayBatch& primary, const Structure& spheres) {
  HitBatch hits;
  hits.resize(primary.size());
  spheres.closest_hits(primary.span(), RayOrder::blocks, hits.span());
  std::vector<Surface> surfaces;
  for (std::int64_t i = 0; i < primary.size(); ++i)
    if (hits.at(i).found())
      surfaces.push_back(surface_at(scene, primary.span().at(i), {hits.at(i).t, hits.at(i).sphere_id}, nullptr));
  return surfaces;
}

RayBatch shadow_rays(const Scene& scene, const std::vector<Surface>& surfaces) {
  const Vec3d light = scene.lights.empty() ? scene.camera.eye : scene.lights.front().position;
  RayBatch rays;
  for (const Surface& surface : surfaces) {
    const Vec3d to_light = scene.spheres.to_local(light) - to_double(surface.origin);
    if (!(dot(surface.normal, to_light) > 0)) continue;
    Ray ray = ray_from(surface, to_light, surface.from_inside);
    ray.t_max = 1;
    rays.push_back(ray);
  }
  return rays;
}

RayBatch mirrored_rays(const std::vector<Surface>& surfaces) {
  RayBatch rays;
  for (const Surface& surface : surfaces) rays.push_back(reflected_ray(surface));
  return rays;
}

// By the cosine to the normal: the normal plus a point of the unit sphere.
RayBatch ambient_rays(const std::vector<Surface>& surfaces) {
  SplitMix64 random(kSeed + 2);
  RayBatch rays;
  for (const Surface& surface : surfaces) {
    const Vec3d sum = surface.normal + any_direction(random);
    const Vec3d direction = dot(sum, sum) > 1e-6 ? normalized(sum) : surface.normal;
    rays.push_back(ray_from(surface, direction, surface.from_inside));
  }
  return rays;
}

}  // namespace

const QueryKindRow& row_of(QueryKind kind) {
  return kQueryKinds[static_cast<std::size_t>(kind)];
}

Result<QueryKind> query_kind_named(const std::string& name) {
  std::string all;
  std::vector<std::string> names;
  for (const QueryKindRow& row : kQueryKinds) {
    if (name == row.name) return row.kind;
    names.emplace_back(row.name);
    all += (all.empty() ? "" : ", ") + std::string(row.name);
  }
  const std::string near = near_name(name, names);
  return Error{"there are no rays \"" + name + "\"; there are " + all, "", 0, 0,
               near.empty() ? "" : "did you mean " + near + "?"};
}

Result<std::vector<QueryKind>> query_kinds_named(const std::vector<std::string>& names) {
  std::vector<QueryKind> kinds;
  for (const std::string& name : names) {
    const Result<QueryKind> kind = query_kind_named(name);
    if (!kind) return kind.error();
    if (std::find(kinds.begin(), kinds.end(), *kind) != kinds.end())
      return Error{"the rays " + name + " stand twice", "", 0, 0, ""};
    kinds.push_back(*kind);
  }
  return kinds;
}

void complete_for_queries(Scene& scene, bool has_camera, bool has_lights) {
  if (!has_camera) {
    constexpr int kSide = 256;  // of any square picture
    scene.camera = frame_spheres(scene.spheres, ViewFrom::front, scene.camera.fov_deg, kSide, kSide);
  }
  if (!has_lights || scene.lights.empty()) scene.lights = {light_behind(scene.camera)};
}

int side_of_primary_px(std::int64_t count) {
  return kBlock * static_cast<int>(std::max(1L, std::lround(std::sqrt(static_cast<double>(count)) / kBlock)));
}

Ray primary_ray(const Scene& scene, int side_px, int x, int y) {
  return PixelRays(local_camera(scene), side_px, side_px).at(x + 0.5, y + 0.5);
}

std::vector<QuerySet> make_query_sets(const Scene& scene, const std::vector<QueryKind>& kinds, std::int64_t count,
                                      const Structure& spheres) {
  const RayBatch primary = primary_rays(scene, count);
  const bool from_hits = std::any_of(kinds.begin(), kinds.end(), [](QueryKind kind) {
    return kind == QueryKind::shadow || kind == QueryKind::mirror || kind == QueryKind::ao;
  });
  const std::vector<Surface> surfaces = from_hits ? surfaces_of(scene, primary, spheres) : std::vector<Surface>();
  std::vector<QuerySet> sets;
  for (const QueryKind kind : kinds) {
    QuerySet set;
    set.kind = kind;
    switch (kind) {
      case QueryKind::primary:
        set.rays = primary;
        set.order = RayOrder::blocks;
        break;
      case QueryKind::random:
        set.rays = random_rays(scene.spheres, count);
        break;
      case QueryKind::shadow:
        set.rays = shadow_rays(scene, surfaces);
        break;
      case QueryKind::mirror:
        set.rays = mirrored_rays(surfaces);
        break;
      case QueryKind::ao:
        set.rays = ambient_rays(surfaces);
        break;
      case QueryKind::points:
        set.points = random_points(scene.spheres, count);
        break;
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

QuerySet sample_of(const QuerySet& set, std::int64_t count) {
  const std::int64_t size = set.size();
  if (count >= size) return set;
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < count; ++i) numbers.push_back(position_in_sample(i, count, size));
  return subset_of(set, numbers);
}

QuerySet subset_of(const QuerySet& set, const std::vector<std::int64_t>& numbers) {
  QuerySet subset;
  subset.kind = set.kind;
  const RaySpan rays = set.rays.span();
  for (const std::int64_t k : numbers) {
    if (set.kind != QueryKind::points)
      subset.rays.push_back(rays.at(k));
    else
      subset.points.insert(subset.points.end(), set.points.begin() + 3 * k, set.points.begin() + 3 * k + 3);
  }
  return subset;
}

}  // namespace bihive::workbench
