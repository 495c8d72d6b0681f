#include "bihive/thesis/cost_diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bihive/image/html_text.h"

namespace bihive {
namespace {

// Units of the view box. The plot lies where costs.svg draws its axes.
constexpr double kLeft = 56, kRight = 468, kTop = 30, kPlotHeight = 230, kLine = 17;
constexpr double kPlotWidth = kRight - kLeft;
constexpr double kCharacter = 6.6;  // mean width of a character of 12 units
constexpr double kMarker = 4.2;

// Axes: an inner node in sphere tests, a leaf in inner nodes. costs.svg has their ticks.
constexpr double kLeastInner = 0.25, kMostInner = 16, kMostLeaf = 1;
constexpr int kSampleColumns = 120, kSampleRows = 51;

// Shades from pale to deep blue, in equal steps of sRGB.
std::string colour_of(int wins, int most) {
  const double part = most == 0 ? 0 : static_cast<double>(wins) / most;
  const auto mix = [part](double pale, double deep) {
    return static_cast<int>(std::lround(pale + part * (deep - pale)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(247, 8), mix(251, 81), mix(255, 156));
}

class Diagram {
 public:
  explicit Diagram(const CostDiagram& data) : data_(data) {}

  std::string svg() {
    std::string regions = cells() + outline("pattern", [this](std::size_t at) { return bool(data_.pattern[at]); });
    if (!data_.share.empty()) regions += outline("share", [this](std::size_t at) { return data_.share[at] >= 0.5; });
    std::string points;
    for (const CostPoint& point : data_.points) points += mark(point);
    return fmt::format(fmt::runtime(cost_diagram_template()), fmt::arg("title", escape_html(data_.title)),
                       fmt::arg("style", cost_diagram_style()), fmt::arg("regions", regions),
                       fmt::arg("points", points), fmt::arg("colours", colours()),
                       fmt::arg("pattern_label", escape_html(data_.pattern_label)),
                       fmt::arg("share", data_.share.empty() ? "" : share_legend()));
  }

 private:
  std::size_t columns() const { return data_.inner.size(); }
  std::size_t rows() const { return data_.leaf.size(); }

  static double within(double cost, const std::vector<double>& axis) {
    return std::clamp(cost, axis.front(), axis.back());
  }
  // At the edge if the cost lies outside. The middle of the first column lies half a cell right of the axis, and so
  // does that of the first row.
  double x_of(double inner) const {
    const double low = std::log10(data_.inner.front()), high = std::log10(data_.inner.back());
    const double part = (std::log10(within(inner, data_.inner)) - low) / (high - low);
    return kLeft + cell_width_ / 2 + part * (kPlotWidth - cell_width_);
  }
  double y_of(double leaf) const {
    const double part = (within(leaf, data_.leaf) - data_.leaf.front()) / (data_.leaf.back() - data_.leaf.front());
    return kTop + kPlotHeight - cell_height_ / 2 - part * (kPlotHeight - cell_height_);
  }
  double x_at(std::size_t column) const { return kLeft + static_cast<double>(column) * cell_width_; }
  double y_at(std::size_t row) const { return kTop + kPlotHeight - static_cast<double>(row) * cell_height_; }

  // One rectangle for each run of equal cells of a row.
  std::string cells() const {
    std::string all;
    for (std::size_t row = 0; row < rows(); ++row)
      for (std::size_t begin = 0, end = 0; begin < columns(); begin = end) {
        const int wins = data_.wins[row * columns() + begin];
        for (end = begin; end < columns() && data_.wins[row * columns() + end] == wins; ++end) {
        }
        all += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>",
                           x_at(begin), y_at(row + 1), static_cast<double>(end - begin) * cell_width_ + 0.2,
                           cell_height_ + 0.2, colour_of(wins, data_.most_wins));
      }
    return all;
  }

  // The edges between cells of the region and others.
  std::string outline(const char* style, const std::function<bool(std::size_t)>& belongs) const {
    std::string path;
    const auto at = [&](std::size_t row, std::size_t column) {
      return row < rows() && column < columns() && belongs(row * columns() + column);
    };
    for (std::size_t row = 0; row <= rows(); ++row)
      for (std::size_t column = 0; column <= columns(); ++column) {
        const bool here = at(row, column);
        if (column > 0 ? at(row, column - 1) != here : here)
          path += fmt::format("M{:.2f} {:.2f}V{:.2f}", x_at(column), y_at(row), y_at(row + 1));
        if (row > 0 ? at(row - 1, column) != here : here)
          path += fmt::format("M{:.2f} {:.2f}H{:.2f}", x_at(column), y_at(row), x_at(column + 1));
      }
    return path.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>", style, path);
  }

  // Drawn at the edge, with its numbers, if it lies outside.
  std::string mark(const CostPoint& point) {
    const double inner = point.fitted.costs().inner, inner_error = point.fitted.inner_error;
    const double leaf = point.fitted.costs().leaf, leaf_error = point.fitted.leaf_error;
    const double x = x_of(inner), y = y_of(leaf);
    const bool outside = inner != within(inner, data_.inner) || leaf != within(leaf, data_.leaf);
    std::string drawn;
    if (!outside)
      drawn = fmt::format("<path class=\"error\" d=\"M{:.1f} {:.1f}H{:.1f}M{:.1f} {:.1f}V{:.1f}\"/>",
                          x_of(inner - inner_error), y, x_of(inner + inner_error), x, y_of(leaf - leaf_error),
                          y_of(leaf + leaf_error));

    // Place its name below names already there, or above them near the axis.
    const std::string numbers = fmt::format("{:.2f}, {:.2f}", inner, leaf);
    const std::string name = outside ? point.name + " (" + numbers + ")" : point.name;
    const double width = kCharacter * static_cast<double>(name.size());
    const bool to_the_left = x + 8 + width > kRight;
    const double left = to_the_left ? x - 8 - width : x + 8;
    double base = std::max(y - 6, kTop + 12);
    const double step = base + kLine > kTop + kPlotHeight ? -kLine : kLine;
    for (const Name& other : names_)
      if (left < other.right && other.left < left + width && std::abs(base - other.base) < kLine)
        base = other.base + step;
    names_.push_back({left, left + width, base});
    return drawn + fmt::format(
                       "<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}: {}</title></circle>"
                       "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"halo\">{}</text>",
                       x, y, kMarker, escape_html(point.name), numbers, to_the_left ? x - 8 : x + 8, base,
                       to_the_left ? "end" : "start", escape_html(name));
  }

  std::string share_legend() const {
    return "<path class=\"share\" d=\"M56 344.4h22\"/><text x=\"84\" y=\"348.4\">" + escape_html(data_.share_label) +
           "</text>\n";
  }

  // The legend's: a box for each number of wins.
  std::string colours() const {
    std::string all;
    for (int wins = 0; wins <= data_.most_wins; ++wins)
      all += fmt::format(
          "<rect x=\"{0}\" y=\"303.4\" width=\"18\" height=\"14\" fill=\"{1}\"/>"
          "<text x=\"{2}\" y=\"314.4\" text-anchor=\"middle\" class=\"{3}\">{4}</text>",
          88 + 18 * wins, colour_of(wins, data_.most_wins), 97 + 18 * wins,
          2 * wins > data_.most_wins ? "on-deep" : "on-pale", wins);
    return all;
  }

  struct Name {
    double left, right, base;
  };

  const CostDiagram& data_;
  std::vector<Name> names_;
  const double cell_width_ = kPlotWidth / static_cast<double>(columns());
  const double cell_height_ = kPlotHeight / static_cast<double>(rows());
};

}  // namespace

CostDiagram cost_diagram(const FigureWork& work, const WinPattern& pattern, const std::vector<FigureWork>& seeds) {
  const std::string winner = tree_name(pattern.max_prims);
  CostDiagram diagram;
  diagram.title = fmt::format("Configurations won by {}", winner);
  diagram.pattern_label =
      fmt::format("the text: {} wins {}, {} Scenario {} with {} spheres", winner, pattern.wins,
                  tree_name(pattern.exception_max_prims), pattern.exception.first, pattern.exception.second);
  diagram.share_label = fmt::format("the same with at least half of {} seeds", seeds.size());
  diagram.most_wins = static_cast<int>(work.size());
  for (int i = 0; i < kSampleColumns; ++i)
    diagram.inner.push_back(kLeastInner * std::pow(kMostInner / kLeastInner, i / (kSampleColumns - 1.0)));
  for (int i = 0; i < kSampleRows; ++i) diagram.leaf.push_back(kMostLeaf * i / (kSampleRows - 1));
  for (const double leaf : diagram.leaf)
    for (const double inner : diagram.inner) {
      const StepCosts costs{inner, leaf, 0};
      diagram.wins.push_back(static_cast<int>(wins_of(work, pattern, costs)));
      diagram.pattern.push_back(pattern_holds(work, pattern, costs));
      if (seeds.empty()) continue;
      const auto with = std::count_if(seeds.begin(), seeds.end(),
                                      [&](const FigureWork& seed) { return pattern_holds(seed, pattern, costs); });
      diagram.share.push_back(static_cast<double>(with) / static_cast<double>(seeds.size()));
    }
  return diagram;
}

std::string cost_diagram_svg(const CostDiagram& diagram) {
  return Diagram(diagram).svg();
}

std::string cost_diagram_csv(const CostDiagram& diagram) {
  std::string text = "inner_node_per_sphere_test,leaf_per_inner_node,wins,pattern,share_of_seeds\n";
  for (std::size_t row = 0; row < diagram.leaf.size(); ++row)
    for (std::size_t column = 0; column < diagram.inner.size(); ++column) {
      const std::size_t at = row * diagram.inner.size() + column;
      text += fmt::format("{:.6g},{:.6g},{},{},{}\n", diagram.inner[column], diagram.leaf[row], diagram.wins[at],
                          diagram.pattern[at] ? 1 : 0,
                          diagram.share.empty() ? "" : fmt::format("{:.4g}", diagram.share[at]));
    }
  return text;
}

}  // namespace bihive
