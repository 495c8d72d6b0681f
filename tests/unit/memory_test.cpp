#include "bihive/bih/memory.h"

#include <gtest/gtest.h>

#include <string>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/scene/generators.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

void expect_inside(const char* what, std::int64_t value, const MemoryPrediction::Range& range) {
  EXPECT_GE(value, range.low) << what;
  EXPECT_LE(value, range.high) << what;
}

void expect_predicted(const SphereSet& spheres, const BuildParameters& parameters) {
  const Tree tree = build_reference_tree(spheres, parameters);
  const TreeStatistics s = tree_statistics(tree);
  const MemoryPrediction prediction = predict_tree_memory(spheres.size(), parameters);
  expect_inside("nodes", s.inner_nodes + s.leaves, prediction.nodes);
  expect_inside("thesis bytes", compact_bytes(s.inner_nodes, s.leaves, s.spheres).total(), prediction.compact_bytes);
  expect_inside("allocated bytes", tree.allocated_bytes(), prediction.allocated_bytes);
}

TEST(Memory, OfTheScenariosIsPredicted) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed})
    for (const std::int64_t count : {64, 1000, 1024, 2048, 4096, 20000})
      for (const std::int64_t max_prims : {1, 2, 4, 8, 16})
        for (const float radius : {0.001f, 1.0f}) {
          SCOPED_TRACE("scenario " + std::to_string(static_cast<int>(scenario)) + ", " + std::to_string(count) +
                       " spheres of radius " + std::to_string(radius) + ", max_prims " + std::to_string(max_prims));
          const Result<SphereSet> spheres = scenario_spheres(scenario, {count, radius, 5});
          ASSERT_TRUE(spheres.ok());
          expect_predicted(*spheres, {max_prims, kUnlimited});
        }
}

TEST(Memory, OfRandomSetsIsPredicted) {
  for (const int count : {1, 2, 9, 100, 5000})
    for (const std::int64_t max_prims : {std::int64_t{1}, std::int64_t{3}, std::int64_t{8}, kUnlimited})
      for (const std::int64_t max_depth : {std::int64_t{1}, std::int64_t{5}, kUnlimited}) {
        SCOPED_TRACE(std::to_string(count) + " spheres, max_prims " + std::to_string(max_prims) + ", max_depth " +
                     std::to_string(max_depth));
        expect_predicted(test::sphere_set(test::random_world("random", 6, count, 10, 0.1, 0.3)),
                         {max_prims, max_depth});
      }
}

TEST(Memory, OfNothingIsPredicted) {
  expect_predicted(test::sphere_set({}), {8, kUnlimited});
}

TEST(Memory, IsPredictedForMoreSpheresThanFitThisMachine) {
  const MemoryPrediction prediction = predict_tree_memory(std::int64_t{100'000'000'000}, {8, kUnlimited});
  EXPECT_GT(prediction.allocated_bytes.low, std::int64_t{1'000'000'000'000});
  EXPECT_GT(prediction.allocated_bytes.high, prediction.allocated_bytes.low);
}

}  // namespace
}  // namespace bihive
