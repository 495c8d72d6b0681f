// Spreads of repeated values, as JSON and as numbers, and how the thesis rounds what it prints.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bihive/base/readable.h"
#include "bihive/math/quartiles.h"
#include "experiment.h"

namespace bihive::thesis {

/// Mean and sample standard deviation; the deviation of a single value is 0.
struct Spread {
  double mean = 0, sd = 0;
  Json json() const { return {{"mean", mean}, {"sd", sd}}; }
};
inline Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

inline Json quartiles_json(const std::vector<double>& values) {
  const Quartiles all = quartiles_of(values);
  return {{"lower", all.lower}, {"median", all.median}, {"upper", all.upper}};
}

/// Half a unit of the last digit of a printed number: "4,095" 0.5, "87.51%" 0.005.
inline double print_rounding(const std::string& printed) {
  const std::size_t point = printed.find('.');
  double unit = 1;
  if (point != std::string::npos)
    for (std::size_t i = point + 1; i < printed.size() && printed[i] >= '0' && printed[i] <= '9'; ++i) unit /= 10;
  return unit / 2;
}

/// Within three standard deviations; without deviation, within print rounding. If our value has no deviation and the
/// printed one is whole, the numbers must be equal.
inline bool inside_three_sd(double stated, const std::string& printed, const Spread& ours) {
  if (print_rounding(printed) == 0.5 && ours.sd == 0) return stated == ours.mean;
  // Slightly more than the rounding itself, because 0.005 is no binary number.
  return std::abs(stated - ours.mean) <= 3 * ours.sd + print_rounding(printed) * (1 + 1e-9);
}

}  // namespace bihive::thesis
