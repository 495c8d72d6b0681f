// The median, the quartiles, the mean and the deviation of measured values.
#pragma once

#include <vector>

namespace bihive {

/// By linear interpolation between the sorted values.
struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};
/// At least one value.
Quartiles quartiles_of(std::vector<double> values);
double median(std::vector<double> values);

/// Mean and sample standard deviation; the deviation of a single value is 0, and both are 0 without any.
struct MeanAndSd {
  double mean = 0, sd = 0;
};
MeanAndSd mean_and_sd(const std::vector<double>& values);

}  // namespace bihive
