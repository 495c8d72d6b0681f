// The middle of measured values, and how far they spread.
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
