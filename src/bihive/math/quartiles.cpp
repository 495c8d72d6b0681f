#include "bihive/math/quartiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {

Quartiles quartiles_of(std::vector<double> values) {
  BIHIVE_CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double rest = place - static_cast<double>(below);
    return values[below] * (1 - rest) + values[above] * rest;
  };
  return {at(0.25), at(0.5), at(0.75)};
}

double median(std::vector<double> values) {
  return quartiles_of(std::move(values)).median;
}

MeanAndSd mean_and_sd(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

}  // namespace bihive
