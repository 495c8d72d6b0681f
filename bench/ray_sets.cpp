#include "ray_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "bihive/base/parallel.h"
#include "bihive/math/rng.h"
#include "bihive/render/shading.h"
#include "bihive/render/surface.h"
#include "bihive/scene/ambient_occlusion.h"

namespace bihive::bench {
namespace {

constexpr std::int64_t kChunk = 16384;
constexpr std::uint64_t kSeed = 7;
constexpr int kBlock = 8;

// Rays, each with the position of its pixel on the Z-curve.
struct PixelRaySet {
  RayBatch rays;
  std::vector<std::uint32_t> place;
};

// Every second bit of the code: 0 gives x, 1 gives y.
std::uint32_t every_second_bit(std::uint32_t code, int first) {
  std::uint32_t value = 0;
  for (int bit = 0; bit < 16; ++bit) value |= (code >> (2 * bit + first) & 1) << bit;
  return value;
}

std::uint32_t z_code(std::uint32_t x, std::uint32_t y) {
  std::uint32_t code = 0;
  for (int bit = 0; bit < 16; ++bit) code |= (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1);
  return code;
}

PixelRaySet primary_rays(const Scene& scene, int side) {
  const PixelRays pixels(local_camera(scene), side, side);
  const auto blocks = static_cast<std::uint32_t>(side / kBlock);
  std::uint32_t codes = 1;
  while (codes < blocks) codes *= 2;
  PixelRaySet set;
  for (std::uint32_t code = 0; code < codes * codes; ++code) {
    const std::uint32_t bx = every_second_bit(code, 0), by = every_second_bit(code, 1);
    if (bx >= blocks || by >= blocks) continue;
    for (std::uint32_t i = 0; i < kBlock * kBlock; ++i) {
      const std::uint32_t x = bx * kBlock + i % kBlock, y = by * kBlock + i / kBlock;
      set.rays.push_back(pixels.at(x + 0.5, y + 0.5));
      set.place.push_back(z_code(x, y));
    }
  }
  // Removes the arrays that hold only defaults.
  set.rays.t_min.clear();
  set.rays.t_max.clear();
  set.rays.leaves.clear();
  set.rays.inside.clear();
  return set;
}

RayBatch random_rays(const BenchScene& bench, std::int64_t count) {
  SplitMix64 random(kSeed);
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * random.next_double(); };
  RayBatch rays;
  rays.resize(count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    Vec3d direction;
    double squared = 0;
    do {
      for (int axis = 0; axis < 3; ++axis) direction[axis] = between(-1, 1);
      squared = dot(direction, direction);
    } while (squared > 1 || squared < 1e-3);
    direction = direction / std::sqrt(squared);
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis][i] = static_cast<float>(between(bench.random_lo[axis], bench.random_hi[axis]));
      rays.direction[axis][i] = static_cast<float>(direction[axis]);
    }
  }
  return rays;
}

// The spacing in a row equals that of rows. They start in front of the box by its depth.
PixelRaySet comb_rays(const BenchScene& bench, int side) {
  const Vec3d size = bench.random_hi - bench.random_lo;
  PixelRaySet set;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Ray ray;
      ray.origin = to_float(bench.random_lo + Vec3d{(x + 0.5) / side * size.x, (y + 0.5) / side * size.y, 2 * size.z});
      ray.direction = {0, 0, -1};
      set.rays.push_back(ray);
      set.place.push_back(z_code(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
    }
  set.rays.t_min.clear();
  set.rays.t_max.clear();
  set.rays.leaves.clear();
  set.rays.inside.clear();
  return set;
}

// The hits of rays, and the rays that start there: the mirrored ones, and those to the light if the surface faces it.
struct Next {
  PixelRaySet mirrored, shadow;
};

Next next_rays(const Scene& scene, const WideTree& tree, const PixelRaySet& from) {
  const std::int64_t count = from.rays.size();
  const RaySpan span = from.rays.span();
  HitBatch hits;
  hits.resize(count);
  parallel_for(0, (count + kChunk - 1) / kChunk, [&](std::int64_t chunk) {
    const std::int64_t first = chunk * kChunk;
    closest_hits(tree, span.part(first, std::min(kChunk, count - first)), RayOrder::any, hits.span().part(first));
  });

  Next next;
  for (std::int64_t i = 0; i < count; ++i) {
    const Hit hit = hits.at(i);
    if (!hit.found()) continue;
    const Surface surface = surface_at(scene, span.at(i), {hit.t, hit.sphere_id});
    const std::uint32_t place = from.place[static_cast<std::size_t>(i)];
    next.mirrored.rays.push_back(reflected_ray(surface));
    next.mirrored.place.push_back(place);
    const Vec3d to_light = scene.spheres.to_local(scene.lights[0].position) - to_double(surface.origin);
    if (!(dot(surface.normal, to_light) > 0)) continue;
    Ray shadow = ray_from(surface, to_light, surface.from_inside);
    shadow.t_max = 1;
    next.shadow.rays.push_back(shadow);
    next.shadow.place.push_back(place);
  }
  // As in the renderer: a segment starts at 0, mirrored rays have no end.
  next.mirrored.rays.t_min.clear();
  next.mirrored.rays.t_max.clear();
  next.shadow.rays.t_min.clear();
  return next;
}

// The renderer uses 64 directions. Every eighth of them is measured here, which are as varied.
constexpr int kAmbientDirections = 64, kAmbientStep = 8;

// A direction around the normal, by cosine: the normal plus a point on the unit sphere.
Vec3d direction_by_cosine(Vec3d normal, SplitMix64& random) {
  Vec3d place;
  double squared = 0;
  do {
    for (int axis = 0; axis < 3; ++axis) place[axis] = 2 * random.next_double() - 1;
    squared = dot(place, place);
  } while (squared > 1 || squared < 1e-6);
  const Vec3d sum = normal + place / std::sqrt(squared);
  return dot(sum, sum) > 1e-6 ? normalized(sum) : normal;
}

// Rays of ambient occlusion from the hits of primary rays: hit after hit along one direction after the other, shared by
// all or chosen by each hit. Half of the directions lie behind a surface, so a hit traces half as many.
PixelRaySet ambient_rays(const Scene& scene, const WideTree& tree, const PixelRaySet& primary,
                         std::optional<double> distance, bool shared) {
  const std::int64_t count = primary.rays.size();
  HitBatch hits;
  hits.resize(count);
  closest_hits(tree, primary.rays.span(), RayOrder::blocks, hits.span());
  std::vector<Surface> surfaces;
  std::vector<std::uint32_t> places;
  for (std::int64_t i = 0; i < count; ++i) {
    if (!hits.at(i).found()) continue;
    surfaces.push_back(surface_at(scene, primary.rays.span().at(i), {hits.at(i).t, hits.at(i).sphere_id}));
    places.push_back(primary.place[static_cast<std::size_t>(i)]);
  }

  const DirectionSets sets(kAmbientDirections, 1);
  SplitMix64 random(kSeed);
  PixelRaySet set;
  std::uint32_t passed = 0;
  for (int k = 0; k < kAmbientDirections; k += kAmbientStep * (shared ? 1 : 2), passed += primary.place.size())
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& surface = surfaces[i];
      const Vec3d direction = shared ? to_double(sets.of_sample(0)[static_cast<std::size_t>(k)])
                                     : direction_by_cosine(surface.normal, random);
      if (!(dot(surface.normal, direction) > 0)) continue;
      Ray ray = ray_from(surface, direction, surface.from_inside);
      if (distance) ray.t_max = *distance;
      set.rays.push_back(ray);
      set.place.push_back(passed + places[i]);
    }
  set.rays.t_min.clear();
  if (!distance) set.rays.t_max.clear();
  return set;
}

std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& place) {
  std::vector<std::uint32_t> order(place.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
  return order;
}

}  // namespace

std::vector<RaySet> make_ray_sets(const BenchScene& bench, const WideTree& tree, const BenchOptions& options) {
  // Mirrored rays need the rays from which they are mirrored: make generation after generation, as far as needed.
  std::vector<RaySet> sets;
  const auto asked = [&](Kind kind) {
    return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
  };
  const auto add = [&](Kind kind, const PixelRaySet& set) {
    if (asked(kind)) sets.push_back({facts_of(kind), set.rays, sorted_by(set.place)});
  };
  const auto asked_from = [&](std::initializer_list<Kind> kinds) {
    return std::any_of(kinds.begin(), kinds.end(), asked);
  };
  using K = Kind;

  if (asked(K::random)) {
    RaySet set{facts_of(K::random), random_rays(bench, options.rays), {}};
    set.packet_order.resize(static_cast<std::size_t>(set.rays.size()));
    std::iota(set.packet_order.begin(), set.packet_order.end(), 0U);
    sets.push_back(std::move(set));
  }
  const PixelRaySet primary = primary_rays(bench.scene, picture_side_px(options.rays));
  add(K::primary, primary);
  if (asked_from({K::shadow, K::mirror1, K::mirror2, K::mirror3, K::mirror_shadow2, K::mirror_shadow3})) {
    const Next first = next_rays(bench.scene, tree, primary);
    add(K::shadow, first.shadow);
    add(K::mirror1, first.mirrored);
    if (asked_from({K::mirror2, K::mirror3, K::mirror_shadow2, K::mirror_shadow3})) {
      const Next second = next_rays(bench.scene, tree, first.mirrored);
      add(K::mirror2, second.mirrored);
      if (asked_from({K::mirror3, K::mirror_shadow2, K::mirror_shadow3})) {
        const Next third = next_rays(bench.scene, tree, second.mirrored);
        add(K::mirror3, third.mirrored);
        add(K::mirror_shadow2, third.shadow);
        if (asked(K::mirror_shadow3)) add(K::mirror_shadow3, next_rays(bench.scene, tree, third.mirrored).shadow);
      }
    }
  }
  for (const Kind kind : {K::ao, K::ao_random})
    if (asked(kind)) add(kind, ambient_rays(bench.scene, tree, primary, options.ao_distance, kind == K::ao));
  if (asked(K::comb)) add(K::comb, comb_rays(bench, picture_side_px(options.rays)));
  std::sort(sets.begin(), sets.end(), [](const RaySet& a, const RaySet& b) { return a.facts.kind < b.facts.kind; });
  return sets;
}

}  // namespace bihive::bench
