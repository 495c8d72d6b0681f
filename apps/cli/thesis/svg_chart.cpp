#include "svg_chart.h"

namespace bihive::cli::thesis {

std::string bar_chart(const ChartData&) {
  return "";
}
std::string line_chart(const ChartData&) {
  return "";
}

}  // namespace bihive::cli::thesis
