// Charts as SVG text: grouped bars and lines, with axes, legend and labels, readable in light and dark and without a
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
};

struct ChartData {
  std::string title;
  std::string x_label, y_label;
  std::vector<std::string> categories;
  std::vector<Series> series;
  bool logarithmic = false;  ///< y axis; then all values must be above 0
};

/// Bars in groups, one group a category. Marks carry <title> with name and value.
std::string bar_chart(const ChartData& data);
/// One line a series over the categories.
std::string line_chart(const ChartData& data);

}  // namespace bihive
