// Round numbers for scales: 1, 2 or 5 times a power of ten, and their text.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bihive {

/// 10^exponent, within 1e-14 of it; exact from -22 to 22.
double power_of_ten(int exponent);

/// digit x 10^exponent; digit is 1, 2 or 5.
struct RoundNumber {
  int digit = 1;
  int exponent = 0;

  double value() const;
};

/// The one whose ratio to x is nearest to 1. x finite and above 0.
RoundNumber nearest_round_number(double x);

/// The text of a multiple of `step`: "0.25", "−3", "1.5×10⁶". Numbers of one scale have equally many decimals.
std::string number_label(double number, RoundNumber step);

/// A place on a scale and its text.
struct Tick {
  double number;
  std::string text;
};

/// At most about `most` ticks (3 or more) at round numbers inside of the range; on a logarithmic scale powers of ten,
/// or more where the range holds few. The range is finite; without extent it has one tick.
std::vector<Tick> ticks_of(std::pair<double, double> range, bool logarithmic, int most);

}  // namespace bihive
