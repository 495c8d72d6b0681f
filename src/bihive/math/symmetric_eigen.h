// Eigenvalues and eigenvectors of small symmetric matrices, by Jacobi's rotations in a fixed order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bihive {

template <std::size_t kSize>
using SymmetricMatrix = std::array<std::array<double, kSize>, kSize>;

/// In falling order of the values; of equal ones the first found comes first. Vectors have length 1 and are at right
/// angles; their signs mean nothing.
template <std::size_t kSize>
struct Eigensystem {
  std::array<double, kSize> values;
  std::array<std::array<double, kSize>, kSize> vectors;  ///< vectors[i] belongs to values[i]
};

/// Sweeps over all pairs of rows, until each element beside the diagonal is too small to change its diagonal elements,
/// and then is 0. Built of + - x / sqrt in a fixed order, so the same bits everywhere.
template <std::size_t kSize>
Eigensystem<kSize> eigensystem_of(SymmetricMatrix<kSize> a) {
  constexpr int kMostSweeps = 64;
  SymmetricMatrix<kSize> v{};  // eigenvectors as columns
  for (std::size_t i = 0; i < kSize; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool is_diagonal = true;
    for (std::size_t p = 0; p < kSize; ++p)
      for (std::size_t q = p + 1; q < kSize; ++q) {
        const double beside = std::abs(a[p][q]);
        if (std::abs(a[p][p]) + beside == std::abs(a[p][p]) && std::abs(a[q][q]) + beside == std::abs(a[q][q])) {
          a[p][q] = a[q][p] = 0;
          continue;
        }
        is_diagonal = false;
        // The rotation by the smaller angle that makes a[p][q] zero.
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(1 + theta * theta));
        const double c = 1 / std::sqrt(1 + t * t), s = t * c;
        const double shift = t * a[p][q];
        a[p][p] -= shift;
        a[q][q] += shift;
        a[p][q] = a[q][p] = 0;
        const auto rotate = [c, s](double& x, double& y) {
          const double before = x;
          x = c * before - s * y;
          y = s * before + c * y;
        };
        for (std::size_t k = 0; k < kSize; ++k) {
          if (k != p && k != q) {
            rotate(a[k][p], a[k][q]);
            a[p][k] = a[k][p];
            a[q][k] = a[k][q];
          }
          rotate(v[k][p], v[k][q]);
        }
      }
    if (is_diagonal) break;
  }
  std::array<std::size_t, kSize> order{};
  for (std::size_t i = 0; i < kSize; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&a](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
  Eigensystem<kSize> system{};
  for (std::size_t i = 0; i < kSize; ++i) {
    system.values[i] = a[order[i]][order[i]];
    for (std::size_t k = 0; k < kSize; ++k) system.vectors[i][k] = v[k][order[i]];
  }
  return system;
}

}  // namespace bihive
