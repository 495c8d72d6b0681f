// Every public query takes spans of rays without each of their optional arrays, and answers as for each ray alone.

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "bihive/render/tracer.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_builder.h"
#include "support/world.h"

namespace bihive {
namespace {

// Rows of spheres in a cell, and rays along them that start on a sphere, inside of it.
constexpr std::int64_t kRays = 130;

SphereSet rows() {
  test::World world;
  for (int i = 0; i < 300; ++i) world.add(3 * (i % 10), 3 * (i / 10 % 10), 3 * (i / 100), 1);
  SphereSet set = test::sphere_set(world);
  set.cell() = Cell{{}, {Vec3d{30, 0, 0}, Vec3d{0, 30, 0}, Vec3d{0, 0, 9}}};
  return set;
}

RayBatch rays_of_rows() {
  RayBatch rays;
  for (std::int64_t i = 0; i < kRays; ++i) {
    Ray ray;
    ray.origin = {static_cast<float>(3 * (i % 10)), static_cast<float>(3 * (i / 10 % 10)) + 0.5F, 0};
    ray.direction = {i % 2 == 0 ? 1.0F : -1.0F, 0.01F * static_cast<float>(i % 7), 0};
    ray.t_min = i % 3 == 0 ? 4 : 0.25;
    ray.t_max = i % 5 == 0 ? 2 : 12;
    ray.leaves = i % 100;
    ray.inside = i % 4 == 0;
    rays.push_back(ray);
  }
  return rays;
}

// The span without the arrays whose bit is not set.
RaySpan with(const RayBatch& rays, unsigned fields) {
  RaySpan span = rays.span();
  if ((fields & 1) == 0) span.t_min = nullptr;
  if ((fields & 2) == 0) span.t_max = nullptr;
  if ((fields & 4) == 0) span.leaves = nullptr;
  if ((fields & 8) == 0) span.inside = nullptr;
  return span;
}

struct Answers {
  HitBatch hits;
  std::vector<std::uint8_t> hidden = std::vector<std::uint8_t>(kRays);

  Answers() { hits.resize(kRays); }
};

void expect_those_of(const Tracer& tracer, const RaySpan& span, Answers& found) {
  for (std::int64_t i = 0; i < span.count; ++i) {
    const Ray ray = span.at(i);
    const Hit hit = tracer.closest_hit(ray);
    ASSERT_EQ(found.hits.at(i).sphere_id, hit.sphere_id) << "ray " << i;
    ASSERT_EQ(found.hits.at(i).t, hit.t) << "ray " << i;
    ASSERT_EQ(found.hidden[static_cast<std::size_t>(i)] != 0, tracer.occluded(ray)) << "ray " << i;
  }
}

TEST(OptionalRays, of_the_wide_tree) {
  const SphereSet set = rows();
  WideBuilder builder;
  const std::shared_ptr<const WideTree> tree = builder.build(set).value();
  const Tracer reference = Tracer::build(set, Engine::brute).value();
  const RayBatch rays = rays_of_rows();
  for (unsigned fields = 0; fields < 16; ++fields) {
    const RaySpan span = with(rays, fields);
    for (const RayOrder order : {RayOrder::blocks, RayOrder::any}) {
      Answers found;
      closest_hits(*tree, span, order, found.hits.span());
      occluded(*tree, span, order, found.hidden.data());
      expect_those_of(reference, span, found);
    }
    std::vector<RayHit> all;
    all_hits(*tree, span, all);
    std::vector<std::int64_t> first(kRays, kNothing);
    for (std::size_t k = all.size(); k-- > 0;) first[static_cast<std::size_t>(all[k].ray)] = all[k].sphere_id;
    for (std::int64_t i = 0; i < kRays; ++i)
      ASSERT_EQ(first[static_cast<std::size_t>(i)], reference.closest_hit(span.at(i)).sphere_id);
  }
}

TEST(OptionalRays, of_every_engine) {
  const SphereSet set = rows();
  const RayBatch rays = rays_of_rows();
  for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute, Engine::wide_brute}) {
    const Tracer tracer = Tracer::build(set, engine).value();
    for (unsigned fields = 0; fields < 16; ++fields) {
      const RaySpan span = with(rays, fields);
      for (const RayOrder order : {RayOrder::blocks, RayOrder::any}) {
        Answers found;
        tracer.closest_hits(span, order, found.hits.span());
        tracer.occluded(span, order, found.hidden.data());
        expect_those_of(tracer, span, found);
      }
    }
  }
}

// Rays that meet images: those of a copy of the batch with all arrays filled in.
TEST(OptionalRays, of_periodic_images) {
  const SphereSet set = rows();
  WideBuilder builder;
  const std::shared_ptr<const WideTree> tree = builder.build(set).value();
  const std::optional<PeriodicImages> images = PeriodicImages::of(set).value();
  ASSERT_TRUE(images);
  const RayBatch rays = rays_of_rows();
  for (unsigned fields = 0; fields < 16; ++fields) {
    const RaySpan span = with(rays, fields);
    RayBatch filled;
    for (std::int64_t i = 0; i < kRays; ++i) filled.push_back(span.at(i));
    const RaySpan whole = filled.span();
    Answers found, expected;
    EXPECT_EQ(images->closest_hits(*tree, span, found.hits.span()),
              images->closest_hits(*tree, whole, expected.hits.span()));
    EXPECT_EQ(images->occluded(*tree, span, found.hidden.data()),
              images->occluded(*tree, whole, expected.hidden.data()));
    EXPECT_EQ(found.hits.t, expected.hits.t);
    EXPECT_EQ(found.hits.sphere_id, expected.hits.sphere_id);
    EXPECT_EQ(found.hidden, expected.hidden);
    if ((fields & 2) == 0) continue;  // every hit of a ray without an end is none
    std::vector<RayHit> all, of_whole;
    EXPECT_EQ(images->all_hits(*tree, span, all), kNothing);
    EXPECT_EQ(images->all_hits(*tree, whole, of_whole), kNothing);
    EXPECT_EQ(all.size(), of_whole.size());
  }
}

}  // namespace
}  // namespace bihive
