// Charts as SVG text: grouped bars with axes, legend and labels, readable in light and dark and without a
// script.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bihive {

/// One value per category; nullopt leaves a gap.
struct Series {
  std::string name;
  std::vector<std::optional<double>> values;
  /// The spread of each value as an error bar; empty: none.
  struct Spread {
    double low, high;
  };
  std::vector<std::optional<Spread>> spreads = {};
};

/// Values from elsewhere in a bar chart: a hollow diamond at the place of a bar, whether there is a bar or not.
struct ChartMark {
  std::size_t series, category;  ///< the bar's
  double value;
  std::string name;  ///< in its <title>
};

struct ChartData {
  std::string title;
  std::string x_label, y_label;
  std::vector<std::string> categories;
  std::vector<Series> series;
  bool logarithmic = false;  ///< y axis; then all values must be above 0
  std::vector<ChartMark> marks = {};
  std::string marks_name = {};                 ///< in the legend
  std::optional<Series::Spread> y_range = {};  ///< the axis covers it too, so that several charts have one scale
};

/// Bars in groups, one group a category. Marks carry <title> with name and value.
std::string bar_chart(const ChartData& data);

}  // namespace bihive
