// Least squares with a few unknowns, none of them negative.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace bihive {

template <std::size_t kUnknowns>
struct LeastSquares {
  using Row = std::array<double, kUnknowns>;

  Row unknowns{};
  std::array<Row, kUnknowns> covariance{};  ///< if each row's error has variance 1; 0 for an unknown at its bound
  double residual = std::numeric_limits<double>::infinity();  ///< the sum of squares; infinite without a solution
};

/// Minimizes the sum of (row . unknowns - 1)^2 over the rows, without the unknowns that are not `used`: these are 0. No
/// solution if it is not unique, or has a negative unknown.
template <std::size_t kUnknowns>
LeastSquares<kUnknowns> least_squares_of(const std::vector<std::array<double, kUnknowns>>& rows,
                                         const std::array<bool, kUnknowns>& used) {
  // The normal equations; an unknown that is not used has the equation unknown = 0.
  LeastSquares<kUnknowns> solution;
  std::array<std::array<double, kUnknowns>, kUnknowns> normal{};
  std::array<double, kUnknowns> right{};
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    solution.covariance[i][i] = used[i] ? 1 : 0;
    normal[i][i] = used[i] ? 0 : 1;
    if (!used[i]) continue;
    for (const auto& row : rows) {
      right[i] += row[i];
      for (std::size_t j = 0; j < kUnknowns; ++j) normal[i][j] += used[j] ? row[i] * row[j] : 0;
    }
  }
  // Invert by Gauss-Jordan elimination; the matrix is symmetric and positive, so the diagonal serves as pivot.
  for (std::size_t pivot = 0; pivot < kUnknowns; ++pivot) {
    if (!(std::abs(normal[pivot][pivot]) > 1e-14)) return {};
    const double scale = 1 / normal[pivot][pivot];
    for (std::size_t j = 0; j < kUnknowns; ++j) normal[pivot][j] *= scale, solution.covariance[pivot][j] *= scale;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const double factor = i == pivot ? 0 : normal[i][pivot];
      for (std::size_t j = 0; j < kUnknowns; ++j) {
        normal[i][j] -= factor * normal[pivot][j];
        solution.covariance[i][j] -= factor * solution.covariance[pivot][j];
      }
    }
  }
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t j = 0; j < kUnknowns; ++j) solution.unknowns[i] += solution.covariance[i][j] * right[j];
    if (solution.unknowns[i] < 0) return {};
  }
  solution.residual = 0;
  for (const auto& row : rows) {
    double sum = -1;
    for (std::size_t i = 0; i < kUnknowns; ++i) sum += row[i] * solution.unknowns[i];
    solution.residual += sum * sum;
  }
  return solution;
}

/// The best solution without a negative unknown: each set of unknowns that are not 0 is tried.
template <std::size_t kUnknowns>
LeastSquares<kUnknowns> nonnegative_least_squares(const std::vector<std::array<double, kUnknowns>>& rows) {
  LeastSquares<kUnknowns> best;
  for (std::size_t set = 1; set < (std::size_t{1} << kUnknowns); ++set) {
    std::array<bool, kUnknowns> used{};
    for (std::size_t i = 0; i < kUnknowns; ++i) used[i] = (set >> i & 1) != 0;
    const LeastSquares<kUnknowns> one = least_squares_of(rows, used);
    if (one.residual < best.residual) best = one;
  }
  return best;
}

}  // namespace bihive
