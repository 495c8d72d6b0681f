// Rays through the walls of cavities, against the volumes that measure_union() computes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/cavity_walls.h"
#include "bihive/measure/union_measures.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/cavities.h"
#include "support/effort.h"

namespace bihive {
namespace {

struct Spheres {
  std::vector<double> x, y, z, r;

  void add(Vec3d centre, double radius) {
    x.push_back(centre.x);
    y.push_back(centre.y);
    z.push_back(centre.z);
    r.push_back(radius);
  }
  // Spirals over a sphere: neighbours overlap, so that the shell is closed.
  void add_shell(Vec3d centre, double radius, int count, double thickness, SplitMix64& rng) {
    for (int i = 0; i < count; ++i) {
      const double z_of = 1 - (2 * i + 1.0) / count, turn = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
      const double across = std::sqrt(1 - z_of * z_of);
      add(centre + Vec3d{across * std::cos(turn), across * std::sin(turn), z_of} * radius,
          thickness * (1 + 0.2 * rng.next_double()));
    }
  }
  Scene scene() const {
    Scene made;
    made.spheres = SphereSet::from_world(x, y, z, r).value();
    return made;
  }
};

// Two hollows in one body, with a ball that touches nothing in one of them, and a shell with holes.
Spheres hollow_body(std::uint64_t seed) {
  SplitMix64 rng(seed);
  Spheres spheres;
  spheres.add_shell({0, 0, 0}, 1, 60, 0.42, rng);
  spheres.add_shell({1.7, 0.2, 0.1}, 0.8, 50, 0.35, rng);
  spheres.add({0.1, 0, 0}, 0.2);
  spheres.add_shell({-2.5, 0, 0}, 1, 24, 0.35, rng);
  return spheres;
}

double cavity_volume(const SphereSet& spheres, std::size_t& count) {
  MeasureOptions options;
  options.cavities = true;
  const UnionMeasures measures = measure_union(spheres, options).value();
  EXPECT_EQ(measures.undecided_spheres, 0);
  double sum = 0;
  for (const Cavity& cavity : measures.cavities) sum += cavity.volume;
  count = measures.cavities.size();
  return sum;
}

// Both ends of a ray's gaps in cavities, one after the other: as shadows and mirrors go on from surface to surface.
double length_in_cavities(const Tracer& tracer, Ray ray) {
  double length = 0;
  while (true) {
    const Hit out = tracer.closest_hit(ray);
    if (!out.found()) return length;
    ray.t_min = out.t;
    ray.leaves = out.sphere_id;
    ray.inside = false;
    const Hit in = tracer.closest_hit(ray);
    EXPECT_TRUE(in.found());
    if (!in.found()) return length;
    EXPECT_GE(in.t, out.t);
    length += in.t - out.t;
    ray.t_min = in.t;
    ray.leaves = in.sphere_id;
    ray.inside = true;
  }
}

// Rays along z on a grid with a random offset.
double volume_by_rays(const Scene& scene, const Tracer& tracer, int side, std::uint64_t seed) {
  SplitMix64 rng(seed);
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  const double dx = (bounds.hi.x - bounds.lo.x) / side, dy = (bounds.hi.y - bounds.lo.y) / side;
  const double from_x = rng.next_double(), from_y = rng.next_double();
  double sum = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      Ray ray;
      ray.origin = to_float(Vec3d{bounds.lo.x + (i + from_x) * dx, bounds.lo.y + (j + from_y) * dy, bounds.lo.z - 1});
      ray.direction = {0, 0, 1};
      sum += length_in_cavities(tracer, ray);
    }
  return sum * dx * dy;
}

TEST(CavityEngine, RaysCrossTheVolumeOfCavities) {
  const int side = static_cast<int>(400 / std::sqrt(test::ray_share()));
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Spheres spheres = hollow_body(seed);
    Scene scene = spheres.scene();
    std::size_t count = 0;
    const double volume = cavity_volume(scene.spheres, count);
    ASSERT_GE(count, 2U);
    const std::int64_t before = scene.spheres.size();
    const ShownCavities shown = show_cavities(scene, 0).value();
    EXPECT_EQ(shown.cavities, static_cast<int>(count));
    EXPECT_LT(scene.spheres.size(), before);
    const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
    EXPECT_TRUE(tracer.has_cavities());
    EXPECT_NEAR(volume_by_rays(scene, tracer, side, seed), volume, 2.0 / side * volume) << "seed " << seed;
  }
}

TEST(CavityEngine, WallsLieOnNoOtherSphereAndSpheresOutsideAreNone) {
  SplitMix64 rng(9);
  Spheres spheres = hollow_body(4);
  spheres.add({5, 5, 5}, 1);
  Scene scene = spheres.scene();
  const SphereSet all = scene.spheres;
  ASSERT_TRUE(show_cavities(scene, 0).ok());
  const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
  int hits = 0;
  for (int n = 0; n < 4000; ++n) {
    Ray ray;
    ray.origin = {static_cast<float>(8 * rng.next_double() - 4), static_cast<float>(4 * rng.next_double() - 2), -4};
    ray.direction = {static_cast<float>(rng.next_double() - 0.5), static_cast<float>(rng.next_double() - 0.5), 1};
    const Hit hit = tracer.closest_hit(ray);
    if (!hit.found()) continue;
    ++hits;
    const Vec3d point = to_double(ray.origin) + hit.t * to_double(ray.direction);
    const Vec3d centre = scene.spheres.centre(hit.sphere_id);
    const double radius = scene.spheres.radius(hit.sphere_id);
    EXPECT_NEAR(length(point - centre), radius, 1e-13);
    EXPECT_LT(length(point - Vec3d{0.8, 0, 0}), 2.5);  // not on the shell with holes, nor outside
    EXPECT_GT(dot(point - centre, to_double(ray.direction)), 0) << "an inner side";
    for (std::int64_t id = 0; id < all.size(); ++id)
      EXPECT_GT(length(point - all.centre(id)), all.radius(id) - 1e-13) << "in another sphere";
  }
  EXPECT_GT(hits, 100);
}

TEST(CavityEngine, EnginesGiveTheSameBits) {
  SplitMix64 rng(5);
  Scene scene = hollow_body(6).scene();
  ASSERT_TRUE(show_cavities(scene, 0.03).ok());
  RayBatch rays;
  for (int n = 0; n < 5000; ++n) {
    Ray ray;
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = static_cast<float>(6 * rng.next_double() - 3);
      ray.direction[axis] = static_cast<float>(rng.next_double() - 0.5);
    }
    ray.t_max = n % 3 == 0 ? 4 * rng.next_double() : ray.t_max;
    if (n % 2 == 0) {
      ray.leaves = static_cast<std::int64_t>(double(scene.spheres.size()) * rng.next_double());
      ray.inside = n % 4 == 0;
    }
    rays.push_back(ray);
  }
  std::vector<HitBatch> answers;
  for (const Engine engine : {Engine::automatic, Engine::reference, Engine::brute}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    HitBatch hits;
    hits.resize(rays.size());
    tracer.closest_hits(rays.span(), RayOrder::any, hits.span());
    std::vector<std::uint8_t> is_occluded(static_cast<std::size_t>(rays.size()));
    tracer.occluded(rays.span(), RayOrder::any, is_occluded.data());
    for (std::int64_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(is_occluded[static_cast<std::size_t>(i)] != 0, hits.at(i).found());
      const Hit one = tracer.closest_hit(rays.span().at(i));
      EXPECT_EQ(one.t, hits.at(i).t);
      EXPECT_EQ(one.sphere_id, hits.at(i).sphere_id);
    }
    answers.push_back(std::move(hits));
  }
  for (const HitBatch& other : answers) {
    EXPECT_EQ(other.t, answers[0].t);
    EXPECT_EQ(other.sphere_id, answers[0].sphere_id);
  }
}

}  // namespace
}  // namespace bihive
