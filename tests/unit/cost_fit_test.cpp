// Costs of steps fitted to times, groups of queries by work, and the values of a sweep.
#include "bihive/compare/cost_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bihive/compare/sweep.h"
#include "bihive/math/rng.h"

namespace bihive::workbench {
namespace {

// Groups whose times are exactly those of the costs, times a relative error.
std::vector<TimedWork> groups_with_costs(const CostFit& costs, std::size_t count, double error) {
  SplitMix64 rng(5);
  std::vector<TimedWork> groups;
  for (std::size_t i = 0; i < count; ++i) {
    TimedWork one{5 + 40 * rng.next_double(), 1 + 9 * rng.next_double(), 2 + 30 * rng.next_double()};
    one.ns = costs.ns_of(one) * (1 + (i % 2 == 0 ? error : -error));
    groups.push_back(one);
  }
  return groups;
}

TEST(CostFit, FindsTheCosts) {
  CostFit costs;
  costs.fixed_ns = 30, costs.inner_ns = 4, costs.leaf_ns = 7, costs.test_ns = 11;
  const CostFit exact = fit_costs(groups_with_costs(costs, 24, 0));
  EXPECT_EQ(exact.groups, 24);
  EXPECT_NEAR(exact.fixed_ns, 30, 1e-6);
  EXPECT_NEAR(exact.inner_ns, 4, 1e-7);
  EXPECT_NEAR(exact.leaf_ns, 7, 1e-6);
  EXPECT_NEAR(exact.test_ns, 11, 1e-7);
  EXPECT_LT(exact.rms, 1e-9);
  EXPECT_GT(exact.explained, 1 - 1e-9);

  const CostFit rough = fit_costs(groups_with_costs(costs, 24, 0.1));
  EXPECT_GT(rough.rms, 0.05);
  EXPECT_LT(rough.rms, 0.11);
  EXPECT_LT(rough.explained, exact.explained);
}

TEST(CostFit, HasNoNegativeCost) {
  // Times that fall with the leaves.
  std::vector<TimedWork> groups = groups_with_costs({100, 5, 0, 5}, 24, 0);
  for (TimedWork& one : groups) one.ns -= 6 * one.leaves;
  const CostFit fit = fit_costs(groups);
  ASSERT_TRUE(fit.found());
  EXPECT_EQ(fit.leaf_ns, 0);
  EXPECT_GE(std::min({fit.fixed_ns, fit.inner_ns, fit.test_ns}), 0);
}

TEST(CostFit, NeedsEightGroups) {
  EXPECT_FALSE(fit_costs(groups_with_costs({1, 1, 1, 1}, 7, 0)).found());
  EXPECT_TRUE(fit_costs(groups_with_costs({1, 1, 1, 1}, 8, 0)).found());
  // Steps that never occur cost nothing.
  std::vector<TimedWork> groups;
  for (int i = 1; i <= 9; ++i) groups.push_back({0, 0, double(i), 3.0 * i});
  const CostFit fit = fit_costs(groups);
  EXPECT_NEAR(fit.test_ns, 3, 1e-9);
  EXPECT_EQ(fit.inner_ns + fit.leaf_ns, 0);
}

TEST(CostFit, GroupsQueriesByTheirWork) {
  std::vector<Work> works(100);
  for (std::size_t i = 0; i < works.size(); ++i) works[i].nodes = static_cast<std::int64_t>(i * 37 % 100);
  const auto groups = groups_by_work(works, 4);
  ASSERT_EQ(groups.size(), 4u);
  std::vector<std::int64_t> all;
  std::int64_t most_before = -1;
  for (const auto& group : groups) {
    EXPECT_EQ(group.size(), 25u);
    EXPECT_TRUE(std::is_sorted(group.begin(), group.end()));
    std::int64_t least = 100, most = -1;
    for (const std::int64_t i : group) {
      least = std::min(least, works[static_cast<std::size_t>(i)].nodes);
      most = std::max(most, works[static_cast<std::size_t>(i)].nodes);
    }
    EXPECT_GT(least, most_before);
    most_before = most;
    all.insert(all.end(), group.begin(), group.end());
  }
  std::sort(all.begin(), all.end());
  for (std::int64_t i = 0; i < 100; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
  EXPECT_TRUE(groups_by_work(std::vector<Work>(63), 4).empty());
  EXPECT_EQ(mean_work({{7, 3, 5, 11}, {9, 5, 1, 13}}, {0, 1}).inner, 4);
}

TEST(CostFit, Correlates) {
  EXPECT_NEAR(correlation_of({{1, 2}, {2, 4}, {3, 6}}), 1, 1e-12);
  EXPECT_NEAR(correlation_of({{1, 3}, {2, 2}, {3, 1}}), -1, 1e-12);
  EXPECT_NEAR(correlation_of({{1, 1}, {2, 0}, {3, 1}}), 0, 1e-12);
  EXPECT_TRUE(std::isnan(correlation_of({{1, 2}, {2, 4}})));
  EXPECT_TRUE(std::isnan(correlation_of({{1, 2}, {1, 4}, {1, 5}})));
}

TEST(ParameterValues, AreReadFromText) {
  ParameterValues values;
  EXPECT_TRUE(add_parameter_values("max-depth=3,1000", values).ok());
  EXPECT_TRUE(add_parameter_values("candidates=7", values).ok());
  EXPECT_EQ(values, (ParameterValues{{{}, {3, 1000}, {7}}}));
  for (const char* text :
       {"", "max-prims", "max-prims=", "max-prims=1,", "max-prims=1,,2", "max-prims=x", "max-prims=0", "max-prims=1.5",
        "max-prims=2,2", "max-depth=5", "max-depth=1001", "depth=1", "=1"})
    EXPECT_FALSE(add_parameter_values(text, values).ok()) << text;
}

}  // namespace
}  // namespace bihive::workbench
