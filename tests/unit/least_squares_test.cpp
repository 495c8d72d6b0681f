// Least squares with unknowns that are not negative.
#include "bihive/math/least_squares.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

using Rows = std::vector<std::array<double, 2>>;

TEST(LeastSquares, FindsTheOnlySolution) {
  // 2 x = 1, 4 y = 1, and a row that both together satisfy.
  const LeastSquares<2> found = nonnegative_least_squares(Rows{{2, 0}, {0, 4}, {1, 2}});
  EXPECT_NEAR(found.unknowns[0], 0.5, 1e-12);
  EXPECT_NEAR(found.unknowns[1], 0.25, 1e-12);
  EXPECT_NEAR(found.residual, 0, 1e-20);
  EXPECT_GT(found.covariance[0][0], 0);
}

// x + y = 1 and 3 x + 2 y = 1 have x = -1, which least_squares_of() refuses; then y alone leaves the least.
TEST(LeastSquares, ANegativeUnknownIs0) {
  const Rows rows{{1, 1}, {3, 2}};
  EXPECT_TRUE(std::isinf(least_squares_of(rows, {true, true}).residual));
  const LeastSquares<2> found = nonnegative_least_squares(rows);
  EXPECT_EQ(found.unknowns[0], 0);
  EXPECT_NEAR(found.unknowns[1], 0.6, 1e-12);
  EXPECT_NEAR(found.residual, 0.2, 1e-12);
}

TEST(LeastSquares, AnUnknownThatNoRowHoldsIs0) {
  const LeastSquares<2> found = nonnegative_least_squares(Rows{{2, 0}, {4, 0}});
  EXPECT_NEAR(found.unknowns[0], 0.3, 1e-12);
  EXPECT_EQ(found.unknowns[1], 0);
  EXPECT_EQ(found.covariance[1][1], 0);
}

}  // namespace
}  // namespace bihive
