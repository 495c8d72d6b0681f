#include "bihive/image/round_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr double kLog10Of2 = 0.30102999566398120;
constexpr int kMostDecimals = 4;       // more are written as powers of ten
constexpr double kMostPlain = 100000;  // as are numbers from here on

// The largest exponent whose power of ten is not above x.
int exponent_below(double x) {
  int exponent = static_cast<int>(std::floor(portable_log2(x) * kLog10Of2));
  while (power_of_ten(exponent) > x) --exponent;
  while (power_of_ten(exponent + 1) <= x) ++exponent;
  return exponent;
}

std::string with_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> kDigits{"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text;
  for (const char digit : fmt::format("{}", exponent))
    text += digit == '-' ? "\u207B" : kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

// Multiples of `step` inside of the range; at most `most`.
std::vector<Tick> multiples(std::pair<double, double> range, RoundNumber step, int most) {
  std::vector<Tick> ticks;
  const double width = step.value();
  // Rounding must not lose an end of the range.
  constexpr double kSlack = 1e-9;
  const double first = std::ceil(range.first / width - kSlack);
  const double last = std::floor(range.second / width + kSlack);
  if (last - first >= most) return ticks;
  for (double i = first; i <= last; i += 1) {
    const double number = i == 0 ? 0 : i * width;  // no -0
    ticks.push_back({number, number_label(number, step)});
  }
  return ticks;
}

std::vector<Tick> linear_ticks(std::pair<double, double> range, int most) {
  const double extent = range.second - range.first;
  if (!(extent > 0) || !std::isfinite(extent)) return {};
  // The finest step that does not make too many.
  RoundNumber step = nearest_round_number(extent / most / 3);
  for (int i = 0; i < 12; ++i) {
    const std::vector<Tick> ticks = multiples(range, step, most);
    if (ticks.size() >= 2) return ticks;
    step = step.digit == 1   ? RoundNumber{2, step.exponent}
           : step.digit == 2 ? RoundNumber{5, step.exponent}
                             : RoundNumber{1, step.exponent + 1};
  }
  return {};
}

std::vector<Tick> logarithmic_ticks(std::pair<double, double> range, int most) {
  const int low = exponent_below(range.first);
  const int high = exponent_below(range.second);
  const int every = (high - low) / most + 1;
  std::vector<Tick> decades, all;
  for (int exponent = low; exponent <= high; ++exponent)
    for (const int digit : {1, 2, 5}) {
      const RoundNumber step{digit, exponent};
      const double number = step.value();
      if (number < range.first || number > range.second) continue;
      const Tick tick{number, number_label(number, step)};
      if (digit == 1 && (exponent - low) % every == 0) decades.push_back(tick);
      all.push_back(tick);
    }
  if (decades.size() >= 3) return decades;
  return all.size() >= 2 && all.size() <= static_cast<std::size_t>(most) + 2 ? all : linear_ticks(range, most);
}

}  // namespace

double power_of_ten(int exponent) {
  double power = 1;
  for (int i = 0; i < std::min(std::abs(exponent), 400); ++i) power *= 10;
  if (exponent >= 0) return power;
  // 10^-309 and smaller are not normal numbers; their inverse would be infinite.
  return std::isfinite(power) ? 1 / power : 1e-300 / power_of_ten(-exponent - 300);
}

double RoundNumber::value() const {
  return exponent >= 0 || exponent < -300 ? digit * power_of_ten(exponent) : digit / power_of_ten(-exponent);
}

RoundNumber nearest_round_number(double x) {
  const int below = exponent_below(x);
  RoundNumber nearest{1, below};
  double least = x / nearest.value();
  for (const RoundNumber candidate : {RoundNumber{2, below}, RoundNumber{5, below}, RoundNumber{1, below + 1}}) {
    const double ratio = candidate.value() > x ? candidate.value() / x : x / candidate.value();
    if (ratio < least) {
      nearest = candidate;
      least = ratio;
    }
  }
  return nearest;
}

std::string number_label(double number, RoundNumber step) {
  if (number == 0) return "0";
  const double size = std::abs(number);
  if (size < kMostPlain && -step.exponent <= kMostDecimals)
    return with_minus(fmt::format("{:.{}f}", number, std::max(0, -step.exponent)));
  const int exponent = exponent_below(size * (1 + 1e-12));
  const double mantissa = number / power_of_ten(exponent);
  const std::string power = "10" + superscript(exponent);
  const int decimals = std::clamp(exponent - step.exponent, 0, 15);
  const std::string text = with_minus(fmt::format("{:.{}f}", mantissa, decimals));
  return text == "1" ? power : text + "\u00D7" + power;
}

std::vector<Tick> ticks_of(std::pair<double, double> range, bool logarithmic, int most) {
  std::vector<Tick> ticks = logarithmic && range.first > 0 ? logarithmic_ticks(range, most) : linear_ticks(range, most);
  if (!ticks.empty()) return ticks;
  // Without extent, or so narrow that no round number is inside: the ends themselves.
  const auto tick = [](double number) { return Tick{number, with_minus(fmt::format("{:.6g}", number))}; };
  if (range.first == range.second) return {tick(range.first)};
  return {tick(range.first), tick(range.second)};
}

}  // namespace bihive
