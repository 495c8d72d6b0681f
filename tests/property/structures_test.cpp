// Every structure of `bihive compare` gives the bits of brute force: rays and points, hostile sets and rays. And its
// counts and expectations are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/compare/structure.h"
#include "bihive/render/query/brute_force.h"
#include "support/brute_force_points.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/query_rays.h"

namespace bihive {
namespace {

using test::World;
using workbench::Structure;
using workbench::StructurePointer;
using workbench::StructureRow;
using workbench::Work;

const std::int64_t kShare = test::ray_share();

std::vector<double> query_points(const World& world, std::uint64_t seed, std::int64_t count) {
  SplitMix64 rng(seed);
  double extent = 0;
  for (std::size_t i = 0; i < world.size(); ++i)
    for (const float c : {world.x[i], world.y[i], world.z[i]})
      extent = std::max(extent, double(std::abs(c)) + double(world.r[i]));
  std::vector<double> points;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t k = static_cast<std::size_t>(rng.next_below(world.size()));
    const Vec3d centre{double(world.x[k]), double(world.y[k]), double(world.z[k])};
    Vec3d point;
    // Anywhere, at a centre, near a surface, from afar.
    const std::uint64_t kind = rng.next_below(4);
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = kind == 0 ? extent * test::uniform(rng, -1, 1) : centre[axis];
      if (kind == 2) point[axis] += world.r[k] * test::uniform(rng, -1.1, 1.1);
      if (kind == 3) point[axis] += std::min(extent * test::log_uniform(rng, 1, 1e6), 1e38) * test::uniform(rng, -1, 1);
    }
    for (int axis = 0; axis < 3; ++axis) points.push_back(std::clamp(point[axis], -3.4e38, 3.4e38));
  }
  return points;
}

// Brute force and all structures of one set.
class Bench {
 public:
  explicit Bench(const World& world) : world_(world), set_(test::sphere_set(world)) {
    for (const StructureRow& row : workbench::structures()) {
      Result<StructurePointer> built = row.build(set_, {}, 2);
      EXPECT_TRUE(built.ok()) << row.name;
      names_.emplace_back(row.name);
      structures_.push_back(std::move(*built));
    }
  }

  std::int64_t check_rays(std::uint64_t seed, std::int64_t count) const {
    test::QueryRays rays(world_, seed, [&](const Ray& ray) { return closest_hit(set_, ray); });
    RayBatch batch;
    HitBatch expected;
    for (std::int64_t i = 0; i < count; ++i) {
      batch.push_back(rays.next());
      const Hit hit = closest_hit(set_, batch.span().at(i));
      expected.t.push_back(hit.t);
      expected.sphere_id.push_back(hit.sphere_id);
    }
    HitBatch hits;
    hits.resize(count);
    std::vector<std::uint8_t> is_occluded(static_cast<std::size_t>(count));
    for (std::size_t s = 0; s < structures_.size(); ++s) {
      SCOPED_TRACE(names_[s]);
      structures_[s]->closest_hits(batch.span(), RayOrder::any, hits.span());
      structures_[s]->occluded(batch.span(), RayOrder::any, is_occluded.data());
      for (std::int64_t i = 0; i < count; ++i) {
        EXPECT_EQ(hits.at(i).t, expected.at(i).t) << "ray " << i;
        EXPECT_EQ(hits.at(i).sphere_id, expected.at(i).sphere_id) << "ray " << i;
        EXPECT_EQ(is_occluded[static_cast<std::size_t>(i)] != 0, expected.at(i).found()) << "ray " << i;
        if (testing::Test::HasFailure()) return 0;
      }
    }
    return std::count_if(expected.sphere_id.begin(), expected.sphere_id.end(), [](auto id) { return id >= 0; });
  }

  void check_points(std::uint64_t seed, std::int64_t count) const {
    const std::vector<double> points = query_points(world_, seed, count);
    HitBatch found;
    found.resize(count);
    for (std::size_t s = 0; s < structures_.size(); ++s) {
      SCOPED_TRACE(names_[s]);
      structures_[s]->nearest_spheres(points.data(), count, found.span());
      for (std::int64_t i = 0; i < count; ++i) {
        const Vec3d point{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
        const auto expected =
            nearest_of_every_sphere(set_, point, 1, std::numeric_limits<double>::infinity(), DistanceTo::surface);
        EXPECT_EQ(found.at(i).t, expected[0].first) << "point " << i;
        EXPECT_EQ(found.at(i).sphere_id, expected[0].second) << "point " << i;
        if (testing::Test::HasFailure()) return;
      }
    }
  }

 private:
  const World& world_;
  SphereSet set_;
  std::vector<std::string> names_;
  std::vector<StructurePointer> structures_;
};

std::int64_t check_world(const World& world, std::uint64_t seed, std::int64_t rays) {
  SCOPED_TRACE(world.name);
  const Bench bench(world);
  if (world.size() == 0) return 0;
  const std::int64_t hits = bench.check_rays(seed, rays / kShare);
  bench.check_points(seed, rays / kShare / 8 + 1);
  return hits;
}

TEST(Structures, EqualBruteForceOnDegenerateSets) {
  std::int64_t hits = 0, number = 0;
  for (const World& world : test::degenerate_worlds())
    if (test::takes_set(number++) && !testing::Test::HasFailure()) hits += check_world(world, 3, 800);
  EXPECT_GT(hits, 5000 / test::test_share());
}

TEST(Structures, EqualBruteForceOnHostileSets) {
  std::int64_t hits = 0, number = 0;
  for (const World& world : test::hostile_worlds(1000, 600))
    if (test::takes_set(number++) && !testing::Test::HasFailure()) hits += check_world(world, 5, 1600);
  EXPECT_GT(hits, 5000 / test::test_share());
}

TEST(Structures, EqualBruteForceOnRandomSets) {
  std::int64_t hits = 0;
  for (std::uint64_t k = 1; k <= (kShare > 1 ? 6 : 30) && !testing::Test::HasFailure(); ++k) {
    SplitMix64 rng(k);
    const int count = static_cast<int>(test::log_uniform(rng, 1, 2000));
    const double half = test::log_uniform(rng, 1e-6, 1e6);
    const double r_lo = half * test::log_uniform(rng, 1e-5, 1), r_hi = r_lo * test::log_uniform(rng, 1.01, 1e4);
    const double away = rng.next_below(2) == 0 ? 0 : half * test::log_uniform(rng, 1, 1e4);
    hits += check_world(
        test::random_world("random " + std::to_string(k), k, count, half, r_lo, r_hi, away, -away, away * 0.3), k, 800);
  }
  EXPECT_GT(hits, 1000 / test::test_share());
}

TEST(Structures, AnswerWithoutSpheres) {
  const SphereSet none;
  Ray ray;
  ray.direction = {0, 0, 1};
  RayBatch rays;
  rays.push_back(ray);
  for (const StructureRow& row : workbench::structures()) {
    SCOPED_TRACE(row.name);
    const StructurePointer structure = std::move(*row.build(none, {}, 1));
    HitBatch hits;
    hits.resize(1);
    structure->closest_hits(rays.span(), RayOrder::any, hits.span());
    EXPECT_FALSE(hits.at(0).found());
    const double point[3] = {};
    structure->nearest_spheres(point, 1, hits.span());
    EXPECT_FALSE(hits.at(0).found());
    EXPECT_EQ(structure->facts().depth, 0);
    EXPECT_EQ(structure->work_of_ray(ray, false).sphere_tests, 0);
  }
}

TEST(Structures, CountTheirSteps) {
  const World world = test::random_world("small", 9, 1500, 10, 0.3, 0.6);
  const SphereSet set = test::sphere_set(world);
  for (const StructureRow& row : workbench::structures()) {
    SCOPED_TRACE(row.name);
    const StructurePointer structure = std::move(*row.build(set, {}, 1));
    const workbench::StructureFacts facts = structure->facts();
    const bool brute = std::string(row.name) == "brute";
    if (!brute) {
      EXPECT_GE(facts.references, set.size());
      EXPECT_GT(facts.bytes, set.size());
      EXPECT_GE(facts.nodes, facts.leaves);
      EXPECT_GE(facts.depth, 1);
    }
    // Levels add up; half-spaces of a k-d tree fill their node and do not overlap.
    EXPECT_EQ(facts.levels.empty(), brute || std::string(row.name) == "grid");
    if (!facts.levels.empty()) {
      EXPECT_EQ(std::ssize(facts.levels), facts.depth);
      EXPECT_EQ(facts.levels[0].nodes, 1);
      EXPECT_NEAR(facts.levels[0].expected_nodes, 1, 1e-12);
    }
    std::int64_t nodes = 0, leaves = 0;
    for (const workbench::LevelFacts& level : facts.levels) {
      nodes += level.nodes;
      leaves += level.leaves;
      if (level.nodes == level.leaves) {
        EXPECT_TRUE(std::isnan(level.children));
        continue;
      }
      EXPECT_GT(level.children, 0);
      EXPECT_GE(level.overlap, 0);
      if (std::string(row.name) != "kd-sah") continue;
      EXPECT_GE(level.children, 1);
      EXPECT_EQ(level.overlap, 0);
    }
    if (!facts.levels.empty()) {
      EXPECT_EQ(nodes, facts.nodes);
      EXPECT_EQ(leaves, facts.leaves);
    }
    test::QueryRays rays(world, 11, [&](const Ray& ray) { return closest_hit(set, ray); });
    for (int i = 0; i < 200; ++i) {
      const Ray ray = rays.next();
      const Work closest = structure->work_of_ray(ray, false), any = structure->work_of_ray(ray, true);
      if (!is_valid(ray)) {
        EXPECT_EQ(closest.cost() + any.cost(), 0);
        continue;
      }
      if (brute) {
        EXPECT_EQ(closest.sphere_tests, set.size());
        EXPECT_EQ(closest.nodes + closest.box_tests, 0);
      }
      if (closest_hit(set, ray).found()) {
        EXPECT_GE(closest.sphere_tests, 1);
        EXPECT_GE(any.sphere_tests, 1);
      }
      // The same way until it ends.
      EXPECT_LE(any.nodes, closest.nodes);
      EXPECT_LE(any.sphere_tests, closest.sphere_tests);
    }
  }
}

TEST(Structures, KeepTheirBitsWithAnyParameters) {
  using workbench::StructureParameters;
  const World world = test::random_world("clustered", 19, 1200, 1, 1e-3, 0.1);
  const SphereSet set = test::sphere_set(world);
  test::QueryRays rays(world, 23, [&](const Ray& ray) { return closest_hit(set, ray); });
  RayBatch batch;
  HitBatch hits;
  for (int i = 0; i < 400; ++i) batch.push_back(rays.next());
  hits.resize(batch.size());
  for (const StructureRow& row : workbench::structures()) {
    for (const StructureParameters& parameters : {StructureParameters{1, 0, 0}, StructureParameters{100, 0, 1},
                                                  StructureParameters{0, 1, 0}, StructureParameters{2, 4, 40}}) {
      SCOPED_TRACE(std::string(row.name) + " " + std::to_string(parameters.max_prims) + " " +
                   std::to_string(parameters.max_depth));
      const StructurePointer structure = std::move(*row.build(set, parameters, 1));
      structure->closest_hits(batch.span(), RayOrder::any, hits.span());
      for (std::int64_t i = 0; i < batch.size(); ++i) {
        const Hit expected = closest_hit(set, batch.span().at(i));
        ASSERT_EQ(hits.at(i).t, expected.t) << "ray " << i;
        ASSERT_EQ(hits.at(i).sphere_id, expected.sphere_id) << "ray " << i;
      }
      if (parameters.max_depth > 0 && (row.takes & workbench::kTakesMaxDepth) != 0) {
        // The wide tree has a root beside a single leaf, too.
        const std::int64_t least = std::string(row.name) == "wide" ? 2 : 1;
        EXPECT_LE(structure->facts().depth, std::max(parameters.max_depth, least));
      }
    }
    // A parameter that a row names has an effect.
    const auto nodes = [&](const StructureParameters& parameters) {
      return std::move(*row.build(set, parameters, 1))->facts().nodes;
    };
    SCOPED_TRACE(row.name);
    EXPECT_EQ((row.takes & workbench::kTakesMaxPrims) != 0, nodes({1, 0, 0}) > nodes({100, 0, 0}));
    EXPECT_EQ((row.takes & workbench::kTakesMaxDepth) != 0, nodes({0, 2, 0}) < nodes({}));
    EXPECT_EQ((row.takes & workbench::kTakesCandidates) != 0, nodes({0, 0, 1}) != nodes({0, 0, 50}));
  }
}

TEST(Structures, PathsHaveTheCountedSteps) {
  const World world = test::random_world("path", 29, 800, 10, 0.3, 0.9);
  const SphereSet set = test::sphere_set(world);
  test::QueryRays rays(world, 31, [&](const Ray& ray) { return closest_hit(set, ray); });
  for (int i = 0; i < 100; ++i) {
    const Ray ray = rays.next();
    if (!is_valid(ray)) continue;
    const Hit expected = closest_hit(set, ray);
    for (const StructureRow& row : workbench::structures()) {
      SCOPED_TRACE(row.name);
      const StructurePointer structure = std::move(*row.build(set, {}, 1));
      const workbench::RayPath path = structure->path_of_ray(ray, false);
      const Work work = structure->work_of_ray(ray, false);
      std::int64_t tests = 0, leaves = 0;
      for (const workbench::PathStep& step : path) {
        tests += std::ssize(step.sphere_ids);
        leaves += step.is_leaf ? 1 : 0;
      }
      EXPECT_EQ(tests, work.sphere_tests);
      // Brute force has no nodes, and a grid tests all spheres for a ray from very far away.
      if (work.nodes > 0) {
        EXPECT_EQ(std::ssize(path), work.nodes);
        EXPECT_EQ(leaves, work.leaves);
      }
      EXPECT_EQ(path.empty() ? kNothing : path.back().best.sphere_id, expected.sphere_id);
      EXPECT_EQ(path.empty() ? Hit{}.t : path.back().best.t, expected.t);
    }
  }
}

TEST(Structures, ExpectedStepsAreThoseOfRandomLines) {
  // Spheres too small to end many lines.
  const World world = test::random_world("dust", 13, 3000, 1, 1e-3, 1e-3);
  const SphereSet set = test::sphere_set(world);
  SplitMix64 rng(17);
  // Uniform lines through a ball around the set: a direction, and a position on the disk across it.
  const auto direction = [&] {
    Vec3d d;
    do d = {test::uniform(rng, -1, 1), test::uniform(rng, -1, 1), test::uniform(rng, -1, 1)};
    while (dot(d, d) > 1 || dot(d, d) < 0.01);
    return normalized(d);
  };
  std::vector<Ray> lines;
  while (std::ssize(lines) < 40000 / kShare) {
    const Vec3d along = direction(), across = normalized(cross(along, direction()));
    const Vec3d place = across * (1.8 * std::sqrt(rng.next_double()));
    Ray ray;
    ray.origin = to_float(place - along * 4);
    ray.direction = to_float(along);
    lines.push_back(ray);
  }
  for (const StructureRow& row : workbench::structures()) {
    SCOPED_TRACE(row.name);
    const StructurePointer structure = std::move(*row.build(set, {}, 1));
    const workbench::StructureFacts facts = structure->facts();
    double nodes = 0, spheres = 0, met = 0;
    for (const Ray& line : lines) {
      const Work work = structure->work_of_ray(line, false);
      if (work.cost() == 0) continue;
      ++met;
      nodes += static_cast<double>(work.nodes);
      spheres += static_cast<double>(work.sphere_tests);
    }
    const double within = kShare > 1 ? 0.15 : 0.05;
    EXPECT_GT(met, static_cast<double>(lines.size()) / 3);
    EXPECT_NEAR(nodes / met, facts.expected_nodes, within * facts.expected_nodes);
    // Where hardly any sphere is tested, their number is a random one.
    EXPECT_NEAR(spheres / met, facts.expected_spheres,
                within * facts.expected_spheres + 4 * std::sqrt(facts.expected_spheres / met));
  }
}

}  // namespace
}  // namespace bihive
