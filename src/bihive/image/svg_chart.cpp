#include "bihive/image/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/image/html_text.h"

namespace bihive {
namespace {

// Units of the view box: a chart stays readable when a phone squeezes it to 330 pixels.
constexpr double kChartWidth = 480;
constexpr double kPlotHeight = 190;
constexpr double kLeft = 30;  // of the y axis's numbers
constexpr double kRight = 10;
constexpr double kLine = 17;         // from one line of text to the next
constexpr double kCharacter = 6.6;   // mean width of a character of 12 units
constexpr double kLegendMark = 20;   // a legend entry's mark with its gap
constexpr double kEntryGap = 14;     // between two legend entries
constexpr double kGroupFill = 0.84;  // the bars' share of a category's room
constexpr int kTicks = 6;            // approximate number of ticks on the y axis

// Seven colours that colour-blind people can tell apart [OkabeIto2008]. Its black is replaced by the text's colour,
// which changes with the dark scheme.
constexpr const char* kColours[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                    "#56b4e9", "#d55e00", "#f0e442", "currentColor"};

constexpr const char* kStyle =
    "<style>.bihive-chart{--paper:#fff;--rule:#d5d5d5;color:#1b1b1b;background:var(--paper);"
    "font:12px system-ui,sans-serif}"
    ".bihive-chart text{fill:currentColor}.bihive-chart .strong{font-weight:600;font-size:13px}"
    ".bihive-chart .rule{stroke:var(--rule)}.bihive-chart .axis{stroke:currentColor}"
    ".bihive-chart .outline{stroke:currentColor;stroke-width:.6}"
    ".bihive-chart .error{stroke:currentColor;stroke-width:1;fill:none}"
    ".bihive-chart .hollow{stroke:currentColor;stroke-width:1.4;fill:var(--paper)}"
    "@media(prefers-color-scheme:dark){.bihive-chart{--paper:#16181c;--rule:#3a3e45;color:#e6e6e6}}</style>";

std::string colour(std::size_t series) {
  return kColours[series % std::size(kColours)];
}

// 20000 as "20,000", 0.25 as "0.25", 1234.5 as "1,234" (four digits are enough to compare marks).
std::string number_text(double value) {
  const double size = std::fabs(value);
  if (size >= 1e12) return fmt::format("{:.3e}", value);
  if (size < 1000) return fmt::format("{:.4g}", value);
  std::string text = fmt::format("{:.0f}", size);
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) text.insert(static_cast<std::size_t>(at), ",");
  return value < 0 ? "-" + text : text;
}

// The y axis: round ticks. The first and the last tick are its ends.
struct Axis {
  std::vector<double> ticks;
  bool logarithmic;

  /// 0 at the bottom, 1 at the top.
  double place(double value) const {
    const double lo = ticks.front(), hi = ticks.back();
    if (!logarithmic) return (value - lo) / (hi - lo);
    return (std::log10(value) - std::log10(lo)) / (std::log10(hi) - std::log10(lo));
  }
};

Axis linear_axis(double lo, double hi) {
  // The step is 1, 2 or 5 times a power of ten.
  const double rough = (hi - lo) / kTicks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough <= power ? 1 : rough <= 2 * power ? 2 : rough <= 5 * power ? 5 : 10);
  Axis axis{{}, false};
  const auto first = static_cast<std::int64_t>(std::floor(lo / step + 1e-9));
  const auto last = static_cast<std::int64_t>(std::ceil(hi / step - 1e-9));
  for (std::int64_t i = first; i <= last; ++i) axis.ticks.push_back(static_cast<double>(i) * step);
  return axis;
}

Axis logarithmic_axis(double lo, double hi) {
  // Powers of ten. Some of their multiples too, if they do not crowd the axis.
  const auto first = static_cast<int>(std::floor(std::log10(lo)));
  const auto last = static_cast<int>(std::ceil(std::log10(hi)));
  std::vector<double> all;
  const std::vector<double> factors = hi < 20 * lo     ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
                                      : hi < 2000 * lo ? std::vector<double>{1, 2, 5}
                                                       : std::vector<double>{1};
  for (int i = first; i <= last; ++i)
    for (const double factor : factors) all.push_back(factor * std::pow(10.0, i));
  // From the last tick below the lowest value (bars need some height) to the first tick that is not below the highest
  // value.
  auto begin = std::lower_bound(all.begin(), all.end(), lo);
  if (begin != all.begin()) --begin;
  auto end = std::lower_bound(begin + 1, all.end(), hi * (1 - 1e-9));
  if (end != all.end()) ++end;
  return {{begin, end}, true};
}

Axis axis_of(const ChartData& data) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  const auto cover = [&](double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  };
  for (const Series& series : data.series) {
    for (const std::optional<double>& value : series.values)
      if (value) cover(*value);
    for (const std::optional<Series::Spread>& spread : series.spreads)
      if (spread) cover(spread->low), cover(spread->high);
  }
  for (const ChartMark& mark : data.marks) cover(mark.value);
  if (data.y_range) cover(data.y_range->low), cover(data.y_range->high);
  if (!(lo <= hi)) lo = hi = 1;
  if (data.logarithmic && lo > 0) return logarithmic_axis(lo, hi);
  lo = std::min(lo, 0.0);
  hi = std::max(hi, 0.0);
  return linear_axis(lo, lo == hi ? lo + 1 : hi);
}

class Chart {
 public:
  explicit Chart(const ChartData& data) : data_(data), axis_(axis_of(data)) {
    // The places of title, legend, plot, categories, and label of the x axis.
    double x = 0;
    top_ = 22 + kLine;
    std::vector<std::string> names;
    for (const Series& series : data_.series) names.push_back(series.name);
    if (!data_.marks.empty()) names.push_back(data_.marks_name);
    for (const std::string& name : names) {
      const double width = kLegendMark + kCharacter * static_cast<double>(name.size());
      if (x > 0 && x + width > kChartWidth - 20) {
        x = 0;
        top_ += kLine;
      }
      legend_.push_back({10 + x, top_});
      x += width + kEntryGap;
    }
    top_ += 18;
    std::size_t widest = 0;
    for (const double tick : axis_.ticks) widest = std::max(widest, number_text(tick).size());
    left_ = kLeft + kCharacter * static_cast<double>(widest);
    std::size_t longest = 0;
    for (const std::string& category : data_.categories) longest = std::max(longest, category.size());
    // Long names are tilted, and the first one needs room on its left.
    tilted_ = kCharacter * static_cast<double>(longest) > slot() - 6;
    if (tilted_)
      left_ = std::max(left_, kCharacter * 0.87 * static_cast<double>(data_.categories.front().size()) - slot() / 2);
    bottom_ = top_ + kPlotHeight;
    height_ = bottom_ + (tilted_ ? kLine + kCharacter * 0.5 * static_cast<double>(longest) : kLine) + kLine + 10;
  }

  std::string bars() const {
    std::string marks;
    const double width = kGroupFill * slot() / static_cast<double>(std::max<std::size_t>(1, data_.series.size()));
    const double base = data_.logarithmic ? bottom_ : y_of(0);
    for (std::size_t s = 0; s < data_.series.size(); ++s)
      for (std::size_t c = 0; c < data_.categories.size(); ++c) {
        const std::optional<double> value = value_of(s, c);
        if (!value) continue;
        const double x =
            left_ + slot() * (static_cast<double>(c) + 0.5 - kGroupFill / 2) + width * static_cast<double>(s);
        const double y = y_of(*value);
        marks += fmt::format(
            "<rect class=\"mark outline\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
            "fill=\"{}\">{}</rect>\n",
            x, std::min(y, base), width, std::fabs(base - y), colour(s), title_of(s, c));
        marks += error_bar(s, c, x + width / 2);
      }
    for (const ChartMark& mark : data_.marks)
      marks += hollow(left_ + slot() * (static_cast<double>(mark.category) + 0.5 - kGroupFill / 2) +
                          width * (static_cast<double>(mark.series) + 0.5),
                      y_of(mark.value),
                      fmt::format("<title>{}: {}</title>", escape_html(mark.name), number_text(mark.value)));
    return document(marks);
  }

 private:
  double slot() const {
    return (kChartWidth - left_ - kRight) / static_cast<double>(std::max<std::size_t>(1, data_.categories.size()));
  }
  double y_of(double value) const { return bottom_ - kPlotHeight * axis_.place(value); }

  // A value outside the axis gets no mark.
  std::optional<double> value_of(std::size_t series, std::size_t category) const {
    const std::vector<std::optional<double>>& values = data_.series[series].values;
    if (category >= values.size() || !values[category] || !std::isfinite(*values[category])) return std::nullopt;
    if (axis_.logarithmic && !(*values[category] > 0)) return std::nullopt;
    return values[category];
  }

  std::string title_of(std::size_t series, std::size_t category) const {
    return fmt::format("<title>{}, {}: {}</title>", escape_html(data_.series[series].name),
                       escape_html(data_.categories[category]), number_text(*value_of(series, category)));
  }

  // From one end of the spread to the other, if there is one.
  std::string error_bar(std::size_t series, std::size_t category, double x) const {
    const auto& spreads = data_.series[series].spreads;
    if (category >= spreads.size() || !spreads[category]) return "";
    return fmt::format("<path class=\"error\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", x, y_of(spreads[category]->low),
                       y_of(spreads[category]->high));
  }

  static std::string hollow(double x, double y, const std::string& title) {
    return fmt::format("<path class=\"hollow\" d=\"M{:.1f} {:.1f}l4 5l-4 5l-4 -5z\">{}</path>\n", x, y - 5, title);
  }

  std::string text(double x, double y, const std::string& attributes, const std::string& content) const {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, escape_html(content));
  }

  std::string axes() const {
    std::string out;
    for (const double tick : axis_.ticks) {
      const double y = y_of(tick);
      const bool zero = tick == 0 || (axis_.logarithmic && tick == axis_.ticks.front());
      out += fmt::format("<path class=\"{}\" d=\"M{} {:.1f}H{}\"/>\n", zero ? "axis" : "rule", left_, y,
                         kChartWidth - kRight);
      out += text(left_ - 5, y + 4, "text-anchor=\"end\"", number_text(tick));
    }
    for (std::size_t c = 0; c < data_.categories.size(); ++c) {
      const double x = left_ + slot() * (static_cast<double>(c) + 0.5), y = bottom_ + kLine;
      const std::string attributes =
          tilted_ ? fmt::format("text-anchor=\"end\" transform=\"rotate(-30 {:.1f} {:.1f})\"", x, y)
                  : "text-anchor=\"middle\"";
      out += text(x, y, attributes, data_.categories[c]);
    }
    const double middle = (top_ + bottom_) / 2;
    out += text((left_ + kChartWidth) / 2, height_ - 8, "text-anchor=\"middle\"", data_.x_label);
    out += text(14, middle, fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 14 {:.1f})\"", middle),
                data_.y_label);
    return out;
  }

  std::string legend() const {
    std::string out;
    for (std::size_t s = 0; s < data_.series.size(); ++s) {
      const auto [x, y] = legend_[s];
      out += fmt::format("<rect class=\"outline\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"10\" fill=\"{}\"/>\n",
                         x + 1, y - 9, colour(s));
      out += text(x + kLegendMark, y, "", data_.series[s].name);
    }
    if (!data_.marks.empty()) {
      const auto [x, y] = legend_.back();
      out += hollow(x + 7, y - 4, "") + text(x + kLegendMark, y, "", data_.marks_name);
    }
    return out;
  }

  std::string document(const std::string& marks) const {
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"bihive-chart\" viewBox=\"0 0 {} {:.0f}\" "
               "role=\"img\" "
               "aria-label=\"{}\">\n{}\n",
               kChartWidth, height_, escape_html(data_.title), kStyle) +
           text(10, 20, "class=\"strong\"", data_.title) + legend() + axes() + marks + "</svg>\n";
  }

  const ChartData& data_;
  Axis axis_;
  struct Place {
    double x, y;
  };
  std::vector<Place> legend_;
  double left_ = 0, top_ = 0, bottom_ = 0, height_ = 0;
  bool tilted_ = false;
};

}  // namespace

std::string bar_chart(const ChartData& data) {
  return Chart(data).bars();
}

}  // namespace bihive
