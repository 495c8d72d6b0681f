// Every engine, and every form of a query, gives the same bits.
#include "bihive/render/tracer.h"

#include <gtest/gtest.h>

#include "bihive/math/rng.h"
#include "bihive/scene/generators.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {
namespace {

constexpr std::int64_t kRays = 5000;

// Rays between points of a cube around the scene; some leave a sphere, some end early, some are invalid.
RayBatch mixed_rays(std::int64_t spheres) {
  SplitMix64 rng(11);
  const auto coordinate = [&] { return static_cast<float>(80 * rng.next_double() - 40); };
  RayBatch rays;
  for (std::int64_t i = 0; i < kRays; ++i) {
    Ray ray;
    ray.origin = {coordinate(), coordinate(), coordinate()};
    ray.direction = Vec3f{coordinate(), coordinate(), coordinate()} - ray.origin;
    if (i % 7 == 0) ray.leaves = static_cast<std::int64_t>(rng.next() % static_cast<std::uint64_t>(spheres));
    ray.inside = i % 2 == 0;
    if (i % 5 == 0) ray.t_max = rng.next_double();
    if (i % 11 == 0) ray.t_min = 0.25 * rng.next_double();
    if (i % 101 == 0) ray.direction = {0, 0, 0};
    rays.push_back(ray);
  }
  return rays;
}

class EveryEngine : public ::testing::TestWithParam<Engine> {};

TEST_P(EveryEngine, answers_as_brute_force_does) {
  const Scene scene = scenario_scene(Scenario::mixed, {700, 2, 5}).value();
  const Tracer brute = Tracer::build(scene.spheres, Engine::brute).value();
  const Tracer tracer = Tracer::build(scene.spheres, GetParam()).value();
  const RayBatch rays = mixed_rays(scene.spheres.size());
  std::int64_t found = 0;
  for (const RayOrder order : {RayOrder::any, RayOrder::blocks}) {
    HitBatch hits;
    hits.resize(kRays);
    std::vector<std::uint8_t> hidden(kRays, 2);
    tracer.closest_hits(rays.span(), order, hits.span());
    tracer.occluded(rays.span(), order, hidden.data());
    for (std::int64_t i = 0; i < kRays; ++i) {
      const Ray ray = rays.span().at(i);
      const Hit expected = brute.closest_hit(ray);
      ASSERT_EQ(hits.at(i).t, expected.t) << i;
      ASSERT_EQ(hits.at(i).sphere_id, expected.sphere_id) << i;
      ASSERT_EQ(tracer.closest_hit(ray).sphere_id, expected.sphere_id) << i;
      ASSERT_EQ(hidden[static_cast<std::size_t>(i)], expected.found() ? 1 : 0) << i;
      ASSERT_EQ(tracer.occluded(ray), expected.found()) << i;
      found += expected.found();
    }
  }
  EXPECT_GT(found, kRays / 2);
}

TEST_P(EveryEngine, sees_a_tile_as_its_pixels) {
  const Scene scene = scenario_scene(Scenario::grid, {512, 1, 1}).value();
  const Tracer tracer = Tracer::build(scene.spheres, GetParam()).value();
  const PixelRays pixels(scene.camera, 83, 61);
  for (const Tile tile : {Tile{0, 0, 83, 61}, Tile{30, 20, 51, 39}, Tile{7, 60, 8, 61}}) {
    const int width = tile.x1 - tile.x0;
    HitBatch hits;
    hits.resize(std::int64_t{width} * (tile.y1 - tile.y0));
    tracer.closest_hits(pixels, tile, hits.span());
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Hit expected = tracer.closest_hit(pixels.at(x + 0.5, y + 0.5));
        const Hit hit = hits.at(std::int64_t{y - tile.y0} * width + (x - tile.x0));
        ASSERT_EQ(hit.t, expected.t) << x << ", " << y;
        ASSERT_EQ(hit.sphere_id, expected.sphere_id) << x << ", " << y;
      }
  }
}

TEST_P(EveryEngine, answers_with_no_spheres_at_all) {
  const SphereSet none;
  const Tracer tracer = Tracer::build(none, GetParam()).value();
  Ray ray;
  ray.direction = {0, 0, 1};
  EXPECT_FALSE(tracer.closest_hit(ray).found());
  EXPECT_FALSE(tracer.occluded(ray));
}

INSTANTIATE_TEST_SUITE_P(all, EveryEngine,
                         ::testing::Values(Engine::automatic, Engine::wide, Engine::reference, Engine::wide_brute));

TEST(Tracer, says_what_it_is) {
  const Scene scene = four_spheres_scene();
  const Tracer automatic = Tracer::build(scene.spheres, Engine::automatic).value();
  EXPECT_EQ(automatic.engine(), Engine::wide);
  EXPECT_EQ(automatic.tree(), nullptr);
  ASSERT_NE(automatic.wide_tree(), nullptr);
  EXPECT_EQ(automatic.wide_tree()->size, 4);

  const Tracer reference = Tracer::build(scene.spheres, Engine::reference, {1, std::nullopt}).value();
  EXPECT_EQ(reference.engine(), Engine::reference);
  ASSERT_NE(reference.tree(), nullptr);
  EXPECT_EQ(reference.tree()->parameters.max_prims, 1);
  EXPECT_EQ(reference.tree()->parameters.max_depth, kUnlimited);
  EXPECT_EQ(Tracer::build(scene.spheres, Engine::reference)->tree()->parameters.max_prims, 8);

  const Tracer brute = Tracer::build(scene.spheres, Engine::brute).value();
  EXPECT_EQ(brute.engine(), Engine::brute);
  EXPECT_EQ(brute.tree(), nullptr);
  EXPECT_EQ(brute.wide_tree(), nullptr);
}

TEST(Tracer, parameters_bound_the_wide_tree) {
  const Scene scene = scenario_scene(Scenario::grid, {512, 1, 1}).value();
  const auto tree_of = [&](const TreeParameters& parameters) {
    const Tracer tracer = Tracer::build(scene.spheres, Engine::wide, parameters).value();
    return std::pair(tracer.wide_tree()->levels, tracer.wide_tree()->largest_leaf);
  };
  EXPECT_LE(tree_of({3, std::nullopt}).second, 3);
  EXPECT_EQ(tree_of({kUnlimited, kUnlimited}).second, 512);
  EXPECT_EQ(tree_of({std::nullopt, 1}).second, 512);
  EXPECT_EQ(tree_of({}), tree_of({std::nullopt, kUnlimited}));
}

TEST(Tracer, takes_a_tree_that_is_built_for_each_frame) {
  const Scene scene = scenario_scene(Scenario::grid, {512, 1, 1}).value();
  const Tracer expected = Tracer::build(scene.spheres, Engine::wide).value();
  Ray ray;
  ray.origin = {0, 0, 100};
  ray.direction = {0.01F, 0, -1};
  WideBuilder builder;
  for (int frame = 0; frame < 3; ++frame) {
    const Tracer tracer(scene.spheres, builder.build(scene.spheres).value());
    EXPECT_EQ(tracer.closest_hit(ray).sphere_id, expected.closest_hit(ray).sphere_id);
    EXPECT_EQ(tracer.engine(), Engine::wide);
  }
}

}  // namespace
}  // namespace bihive
