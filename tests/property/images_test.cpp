// A set with images gives the bits of a set that holds the copies: every engine, every form of a query, every target.
// ctest: share 3
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/render/query/build_engine.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "support/block_rays.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/query_rays.h"
#include "support/scenes.h"
#include "support/wide_under_test.h"
#include "support/world.h"

namespace bihive {
namespace {

using test::World;

struct Replicated {
  World world;
  std::array<Vec3d, 3> vectors;
  std::array<std::int32_t, 3> counts;
};

// The copies, by the rule that docs/pictures.md states. It is written here a second time.
World copied(const Replicated& replicated) {
  World copies;
  copies.name = replicated.world.name;
  const auto& [a, b, c] = replicated.vectors;
  for (int i = 0; i < replicated.counts[0]; ++i)
    for (int j = 0; j < replicated.counts[1]; ++j)
      for (int k = 0; k < replicated.counts[2]; ++k)
        for (std::size_t s = 0; s < replicated.world.size(); ++s)
          copies.add(double(replicated.world.x[s]) + ((i * a.x + j * b.x) + k * c.x),
                     double(replicated.world.y[s]) + ((i * a.y + j * b.y) + k * c.y),
                     double(replicated.world.z[s]) + ((i * a.z + j * b.z) + k * c.z), double(replicated.world.r[s]));
  return copies;
}

SphereSet with_images(const Replicated& replicated) {
  SphereSet set = test::sphere_set(replicated.world);
  const Status status = set.replicate(replicated.vectors, replicated.counts);
  EXPECT_TRUE(status.ok()) << replicated.world.name;
  return set;
}

std::vector<Replicated> hostile() {
  const World cloud = test::random_world("cloud", 41, 60, 1, 0.02, 0.3);
  const World touching = test::touching_world(2);
  const auto named = [](World world, const std::string& name) {
    world.name = name;
    return world;
  };
  std::vector<Replicated> sets;
  const auto add = [&](const World& world, const std::string& name, Vec3d a, Vec3d b, Vec3d c, int i, int j, int k) {
    sets.push_back({named(world, name), {a, b, c}, {i, j, k}});
  };
  add(cloud, "a cell", {2.5, 0, 0}, {0, 2.5, 0}, {0, 0, 2.5}, 3, 2, 3);
  add(cloud, "one copy", {2.5, 0, 0}, {0, 2.5, 0}, {0, 0, 2.5}, 1, 1, 1);
  add(cloud, "thirds", {1.0 / 3, 0.1, 0}, {0, 1.7, 0}, {0, 0.3, 2.1}, 4, 2, 2);
  add(cloud, "negative determinant", {0, 2.1, 0}, {2.2, 0, 0}, {0, 0, 2.3}, 2, 2, 3);
  add(cloud, "very skewed", {2.5, 0, 0}, {2.4999, 0.01, 0}, {-40, 3, 0.001}, 2, 3, 3);
  add(cloud, "tiny cell", {1e-9, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-3}, 2, 2, 2);
  add(cloud, "all in one place", {1e-30, 0, 0}, {0, 1, 0}, {0, 0, 1}, 3, 1, 1);
  add(cloud, "a vector of 1e20", {1e20, 0, 0}, {0, 2, 0}, {0, 0, 2}, 2, 2, 1);
  add(cloud, "far apart", {1e5, 0, 0}, {0, -3e4, 0}, {0, 0, 2}, 3, 2, 2);
  add(cloud, "flat cell", {2, 0, 0}, {1, 0, 0}, {0, 0, 1}, 2, 3, 1);
  add(cloud, "many", {2.1, 0, 0}, {0, 2.1, 0}, {0, 0, 2.1}, 9, 9, 9);
  add(touching, "equal spheres across borders", {2, 0, 0}, {0, 2, 0}, {0, 0, 4}, 3, 3, 2);
  add(test::pile("pile", 30, 0.5, 0.25, 0.125, 0.2), "a pile", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, 2, 2);
  add(test::random_world("far", 28, 60, 12, 1, 1, 1e5, -1e5, 1e5), "far from 0", {25, 0, 0}, {3, 24, 0}, {0, 0, 30}, 2,
      2, 2);
  add(test::random_world("points", 21, 60, 1, 0.0, 0.0), "points", {2.5, 0, 0}, {0, 2.5, 0}, {0, 0, 2.5}, 2, 2, 2);
  for (const double factor : {1e-20, 1e20})
    add(cloud.scaled(factor, "scaled"), "scaled by " + std::to_string(factor), {2.5 * factor, 0, 0},
        {0, 2.5 * factor, 0}, {0, 0, 2.5 * factor}, 2, 2, 2);
  return sets;
}

std::vector<Ray> rays_for(const World& copies, const Tracer& truth, std::int64_t count) {
  test::QueryRays rays(copies, 4711, [&](const Ray& ray) { return truth.closest_hit(ray); });
  std::vector<Ray> list;
  for (std::int64_t i = 0; i < count; ++i) list.push_back(rays.next());
  return list;
}

struct ExpectedHits {
  std::vector<Hit> hits;
  std::vector<std::vector<Crossing>> all;
};

void check_engine(const Tracer& tracer, const RayBatch& rays, const ExpectedHits& expected) {
  const std::int64_t count = rays.size();
  HitBatch hits;
  hits.resize(count);
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(count), 2);
  for (const RayOrder order : {RayOrder::any, RayOrder::blocks}) {
    tracer.closest_hits(rays.span(), order, hits.span());
    tracer.occluded(rays.span(), order, hidden.data());
    for (std::int64_t i = 0; i < count; ++i) {
      const Hit& truth = expected.hits[static_cast<std::size_t>(i)];
      ASSERT_TRUE(test::same_bits(hits.at(i), truth))
          << "ray " << i << ": " << test::text_of(hits.at(i)) << ", not " << test::text_of(truth);
      ASSERT_EQ(hidden[static_cast<std::size_t>(i)], truth.found() ? 1 : 0) << "ray " << i;
    }
  }
  for (std::int64_t i = 0; i < count; i += 3) {
    const Hit& truth = expected.hits[static_cast<std::size_t>(i)];
    const Hit hit = tracer.closest_hit(rays.span().at(i));
    ASSERT_TRUE(test::same_bits(hit, truth))
        << "single ray " << i << ": " << test::text_of(hit) << ", not " << test::text_of(truth);
    ASSERT_EQ(tracer.occluded(rays.span().at(i)), truth.found()) << "single ray " << i;
  }
}

void check_all_hits(const RayEngine& engine, std::int64_t stored, const RayBatch& rays, const ExpectedHits& expected) {
  std::vector<RayHit> found;
  engine.all_hits(rays.span(), RayOrder::blocks, found);
  std::size_t next = 0;
  for (std::size_t i = 0; i < expected.all.size(); ++i)
    for (const Crossing& crossing : expected.all[i]) {
      ASSERT_LT(next, found.size()) << "ray " << i;
      ASSERT_EQ(found[next].ray, static_cast<std::int64_t>(i));
      ASSERT_EQ(found[next].t, crossing.t) << "ray " << i;
      ASSERT_EQ(found[next].sphere_id, crossing.id) << "ray " << i;
      ++next;
    }
  ASSERT_EQ(next, found.size());
  for (std::size_t i = 0; i < expected.all.size(); i += 7) {
    engine.all_hits(rays.span().part(static_cast<std::int64_t>(i), 1), RayOrder::any, found);
    ASSERT_EQ(found.size(), expected.all[i].size()) << "single ray " << i;
    for (std::size_t k = 0; k < found.size(); ++k)
      ASSERT_EQ(found[k].sphere_id, expected.all[i][k].id) << "single ray " << i;
  }

  // How many, as the sums of depths of 1.
  const auto count = static_cast<std::size_t>(rays.size());
  const std::vector<OpticalDepth> ones(static_cast<std::size_t>(stored), 1);
  std::vector<OpticalDepth> sums(count, 7);
  engine.optical_depths(rays.span(), RayOrder::blocks, {ones.data()}, {{sums.data()}});
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(sums[i], expected.all[i].size()) << "ray " << i;
}

ExpectedHits truth_of(const SphereSet& spheres, const RayBatch& rays) {
  ExpectedHits expected;
  for (std::int64_t i = 0; i < rays.size(); ++i) {
    const Ray ray = rays.span().at(i);
    expected.hits.push_back(closest_hit(spheres, ray));
    expected.all.emplace_back();
    if (!is_valid(ray)) continue;
    const ScaledRay scaled(ray, spheres);
    for (std::int64_t id = 0; id < spheres.size(); ++id) {
      const double t = sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id));
      if (t < std::numeric_limits<double>::infinity()) expected.all.back().push_back({t, id});
    }
    std::sort(expected.all.back().begin(), expected.all.back().end(),
              [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t < b.t : a.id < b.id; });
  }
  return expected;
}

TEST(images, answer_as_copies_do) {
  std::int64_t found = 0, number = 0;
  for (const Replicated& replicated : hostile()) {
    if (!test::takes_set(number++)) continue;
    SCOPED_TRACE(replicated.world.name);
    const World copies = copied(replicated);
    const SphereSet copied_set = test::sphere_set(copies);
    const SphereSet set = with_images(replicated);
    ASSERT_EQ(set.total_size(), copied_set.size());
    ASSERT_EQ(set.scale_exponent(), copied_set.scale_exponent());
    ASSERT_EQ(set.bounds().lo, copied_set.bounds().lo);
    ASSERT_EQ(set.bounds().hi, copied_set.bounds().hi);
    for (std::int64_t id = 0; id < set.total_size(); ++id) {
      ASSERT_EQ(set.centre(id), copied_set.centre(id)) << id;
      ASSERT_EQ(set.radius(id), copied_set.radius(id)) << id;
    }

    // Hostile rays, then neighbouring ones.
    const Tracer truth = Tracer::build(copied_set, Engine::reference).value();
    const bool large = copied_set.size() > 5000;
    const std::int64_t count = std::max<std::int64_t>(64, (large ? 600 : 3000) / test::test_share());
    RayBatch rays = test::batch_of(rays_for(copies, truth, count));
    test::BlockRays blocks(copies, 99);
    for (int block = 0; block < (large ? 2 : 8); ++block) {
      blocks.add_camera(rays);
      blocks.add_shadow(rays);
    }
    const ExpectedHits expected = truth_of(copied_set, rays);
    for (const Hit& hit : expected.hits) found += hit.found() ? 1 : 0;

    check_engine(Tracer::build(set, Engine::brute).value(), rays, expected);
    check_engine(Tracer::build(set, Engine::reference).value(), rays, expected);
    for (const std::string& target : test::targets_under_test()) {
      SCOPED_TRACE(target);
      ASSERT_TRUE(use_target(target).ok());
      check_engine(Tracer::build(set, Engine::wide).value(), rays, expected);
      if (set.has_images()) check_all_hits(*build_engine(set, Engine::wide).value(), set.size(), rays, expected);
      ASSERT_TRUE(use_target("").ok());
      if (testing::Test::HasFatalFailure()) return;
    }
    if (set.has_images()) check_all_hits(*build_engine(set, Engine::reference).value(), set.size(), rays, expected);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(found, 1000 / test::test_share());
}

// Every second sphere, as transparent scenes divide a set.
TEST(images, of_a_part_answer_as_copies_of_it_do) {
  for (const Replicated& replicated : hostile()) {
    if (replicated.counts == std::array<std::int32_t, 3>{1, 1, 1}) continue;
    SCOPED_TRACE(replicated.world.name);
    const SphereSet set = with_images(replicated);
    const SphereSet copied_set = test::sphere_set(copied(replicated));
    if (copied_set.size() > 5000) continue;
    std::vector<std::int64_t> ids;
    for (std::int64_t id = 0; id < set.size(); id += 2) ids.push_back(id);
    const Tracer truth = Tracer::build(copied_set, Engine::reference).value();
    const RayBatch rays = test::batch_of(rays_for(copied(replicated), truth, 600 / test::ray_share()));
    ExpectedHits expected = truth_of(copied_set, rays);
    for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
      const auto tracer = build_engine(set, ids, nullptr, engine).value();
      HitBatch hits;
      hits.resize(rays.size());
      tracer->closest_hits(rays.span(), RayOrder::any, hits.span());
      for (std::int64_t i = 0; i < rays.size(); ++i) {
        Hit best;
        for (const Crossing& crossing : expected.all[static_cast<std::size_t>(i)])
          if (crossing.id % set.size() % 2 == 0) best.keep_nearer(crossing.t, crossing.id);
        ASSERT_TRUE(test::same_bits(hits.at(i), best))
            << "ray " << i << ": " << test::text_of(hits.at(i)) << ", not " << test::text_of(best);
      }
    }
  }
}

TEST(images, refuse_what_cannot_be) {
  const World cloud = test::random_world("cloud", 41, 10, 1, 0.02, 0.3);
  const std::array<Vec3d, 3> cell{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  const auto message = [&](const std::array<Vec3d, 3>& vectors, const std::array<std::int32_t, 3>& counts) {
    SphereSet set = test::sphere_set(cloud);
    const Status status = set.replicate(vectors, counts);
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_EQ(message(cell, {2, 2, 2}), "");
  EXPECT_NE(message(cell, {2, 0, 2}).find("at least 1 copy along the cell's vector b"), std::string::npos);
  EXPECT_NE(message({cell[0], cell[1], Vec3d{}}, {1, 1, 2}).find("no extent along its vector c"), std::string::npos);
  EXPECT_EQ(message({cell[0], cell[1], Vec3d{}}, {2, 2, 1}), "");
  EXPECT_NE(message({Vec3d{3e38, 0, 0}, cell[1], cell[2]}, {4, 1, 1}).find("single precision"), std::string::npos);
  EXPECT_NE(message({Vec3d{std::nan(""), 0, 0}, cell[1], cell[2]}, {2, 1, 1}).find("finite"), std::string::npos);
  EXPECT_NE(message(cell, {1 << 20, 1 << 20, 1}).find("2^40"), std::string::npos);
}

}  // namespace
}  // namespace bihive
