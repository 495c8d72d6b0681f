// Eigenvalues of small symmetric matrices.
#include "bihive/math/symmetric_eigen.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

template <std::size_t kSize>
void expect_eigensystem(const SymmetricMatrix<kSize>& matrix, double largest) {
  const Eigensystem<kSize> found = eigensystem_of(matrix);
  for (std::size_t i = 0; i < kSize; ++i) {
    if (i > 0) {
      EXPECT_GE(found.values[i - 1], found.values[i]);
    }
    for (std::size_t row = 0; row < kSize; ++row) {
      double product = 0;
      for (std::size_t k = 0; k < kSize; ++k) product += matrix[row][k] * found.vectors[i][k];
      EXPECT_NEAR(product, found.values[i] * found.vectors[i][row], 1e-13 * largest);
    }
    for (std::size_t j = 0; j < kSize; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < kSize; ++k) product += found.vectors[i][k] * found.vectors[j][k];
      EXPECT_NEAR(product, i == j ? 1 : 0, 1e-13);
    }
  }
}

template <std::size_t kSize>
void expect_random_ones() {
  SplitMix64 random(7);
  const auto uniform = [&random] { return 6 * random.next_double() - 3; };
  for (int repeat = 0; repeat < 200; ++repeat) {
    SymmetricMatrix<kSize> matrix{};
    double largest = 0;
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t j = i; j < kSize; ++j) {
        matrix[i][j] = matrix[j][i] = uniform();
        largest += std::abs(matrix[i][j]);
      }
    expect_eigensystem(matrix, largest);
  }
}

TEST(SymmetricEigen, VectorsAreThoseOfTheMatrix) {
  expect_random_ones<3>();
  expect_random_ones<4>();
}

TEST(SymmetricEigen, DiagonalMatricesKeepTheirAxesExactly) {
  const Eigensystem<3> found = eigensystem_of<3>({{{1, 0, 0}, {0, 5, 0}, {0, 0, 2}}});
  EXPECT_EQ(found.values, (std::array<double, 3>{5, 2, 1}));
  EXPECT_EQ(found.vectors[0], (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(found.vectors[2], (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(eigensystem_of<3>({}).vectors[1], (std::array<double, 3>{0, 1, 0}));
}

TEST(SymmetricEigen, MatricesOfRankOneAndOfAllMagnitudes) {
  for (const double scale : {1e-150, 1.0, 1e150}) {
    SymmetricMatrix<3> ones{};
    for (auto& row : ones) row = {scale, scale, scale};
    expect_eigensystem(ones, scale);
  }
  expect_eigensystem<3>({{{1e20, 1, 1e-20}, {1, 1, 1}, {1e-20, 1, 1e-20}}}, 1e20);
}

}  // namespace
}  // namespace bihive
