// The median and the quartiles of measured values.
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

}  // namespace bihive
