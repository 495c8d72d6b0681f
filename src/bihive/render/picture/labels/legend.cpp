#include <algorithm>
#include <cmath>

#include "bihive/image/font.h"
#include "bihive/image/round_numbers.h"
#include "bihive/render/picture/labels/parts.h"

namespace bihive {
namespace {

// In ems.
constexpr double kTitleHeight = 1.6;
constexpr double kBarWidth = 0.9;
constexpr double kBarHeight = 11;
constexpr double kTickLength = 0.3;
constexpr double kTextSize = 0.85;
constexpr double kGap = 0.4;        // between a colour and its text
constexpr double kRowHeight = 1.3;  // of a category
constexpr double kSquare = 0.85;
constexpr double kBetweenKeys = 1.4;
constexpr double kMostShareOfWidth = 0.45;

constexpr double kMostNameWidth = 12;

constexpr int kMostTicks = 6;
constexpr std::size_t kMostEntries = 16;

// A key that is ready to be drawn.
struct PreparedKey {
  LegendKey key;
  std::vector<Tick> ticks;

  double title_height() const { return key.title.empty() ? 0 : kTitleHeight; }
  double height() const {
    const double rows = static_cast<double>(key.entries.size()) * kRowHeight;
    const double gap = key.scale && !key.entries.empty() ? kGap : 0;
    return title_height() + (key.scale ? kBarHeight + kGap : 0) + gap + rows;
  }
  double width(const LabelPen& pen) const {
    double widest = pen.width_of(key.title, 1);
    for (const Tick& tick : ticks)
      widest = std::max(widest, kBarWidth + kTickLength + kGap / 2 + kTextSize * pen.width_of(tick.text, 1));
    for (const LegendEntry& entry : key.entries)
      widest = std::max(widest, kSquare + kGap + kTextSize * pen.width_of(entry.name, 1));
    return widest;
  }
};

// A name without its middle, if it is too wide.
std::string shortened(const LabelPen& pen, const std::string& name) {
  if (pen.width_of(name, 1) <= kMostNameWidth) return name;
  const std::vector<char32_t> letters = characters_of(name);
  for (std::size_t kept = letters.size() - 1;; --kept) {
    const std::size_t first = (2 * kept + 2) / 3;
    const std::string made =
        text_of(letters, 0, first) + "\u2026" + text_of(letters, letters.size() - (kept - first), letters.size());
    if (kept <= 1 || pen.width_of(made, 1) <= kMostNameWidth) return made;
  }
}

PreparedKey prepared(const LabelPen& pen, const LegendKey& key) {
  PreparedKey ready{key, {}};
  ready.key.title = shortened(pen, key.title);
  for (LegendEntry& entry : ready.key.entries) entry.name = shortened(pen, entry.name);
  if (key.scale) ready.ticks = ticks_of(key.scale->range, key.scale->logarithmic, kMostTicks);
  std::vector<LegendEntry>& entries = ready.key.entries;
  if (entries.size() <= kMostEntries) return ready;
  // The last line says how many are left out.
  const std::size_t left_out = entries.size() - (kMostEntries - 1);
  entries.resize(kMostEntries - 1);
  entries.push_back({"\u2026 " + std::to_string(left_out) + " more", {-1, -1, -1}});
  return ready;
}

CanvasArea rounded(const CanvasArea& area) {
  const auto round = [](double number) { return std::floor(number + 0.5); };
  return {round(area.x0), round(area.y0), round(area.x1), round(area.y1)};
}

// A frame around an area of whole pixels, and ticks at its right.
void draw_frame(LabelPen& pen, const CanvasArea& area, const std::vector<double>& tick_y) {
  const double line = pen.line();
  Shape frame;
  frame.add_rectangle({area.x0 - line, area.y0 - line, area.x1 + line, area.y0});
  frame.add_rectangle({area.x0 - line, area.y1, area.x1 + line, area.y1 + line});
  frame.add_rectangle({area.x0 - line, area.y0, area.x0, area.y1});
  frame.add_rectangle({area.x1, area.y0, area.x1 + line, area.y1});
  for (const double y : tick_y) {
    const double top = std::floor(y - 0.5 * line + 0.5);
    frame.add_rectangle({area.x1, top, area.x1 + kTickLength * pen.em(), top + line});
  }
  pen.draw(frame);
}

// The bar of a continuous map, from its end at the top to its begin: each row of pixels has the colour of its middle.
void draw_bar(LabelPen& pen, const PreparedKey& ready, double x, double y) {
  const LegendScale& scale = *ready.key.scale;
  const double em = pen.em();
  const CanvasArea bar = rounded({x, y, x + kBarWidth * em, y + kBarHeight * em});
  const auto place = [&](double number) {
    return bar.y1 - place_in_range(scale.range, scale.logarithmic, number) * bar.height();
  };
  std::vector<double> tick_y;
  for (const Tick& tick : ready.ticks) tick_y.push_back(place(tick.number));
  draw_frame(pen, bar, tick_y);
  for (double row = bar.y0; row < bar.y1; row += 1) {
    Shape stripe;
    stripe.add_rectangle({bar.x0, row, bar.x1, row + 1});
    const double share = (bar.y1 - (row + 0.5)) / bar.height();
    pen.fill(stripe, to_double(map_colour(scale.map, share, Transfer::none)));
  }
  for (std::size_t i = 0; i < ready.ticks.size(); ++i)
    pen.write(ready.ticks[i].text,
              {bar.x1 + (kTickLength + kGap / 2) * em, tick_y[i] + 0.5 * kCapitalHeight * kTextSize * em}, kTextSize);
}

void draw_entry(LabelPen& pen, const LegendEntry& entry, double x, double y) {
  const double em = pen.em();
  const CanvasArea square = rounded({x, y, x + kSquare * em, y + kSquare * em});
  if (entry.colour.x >= 0) {
    draw_frame(pen, square, {});
    Shape shape;
    shape.add_rectangle(square);
    pen.fill(shape, entry.colour);
  }
  pen.write(entry.name, {x + (kSquare + kGap) * em, y + (0.5 * kSquare + 0.5 * kCapitalHeight * kTextSize) * em},
            kTextSize);
}

void draw_key(LabelPen& pen, const PreparedKey& ready, double x, double y) {
  const double em = pen.em();
  if (!ready.key.title.empty()) pen.write(ready.key.title, {x, y + kAscent * em}, 1);
  y += ready.title_height() * em;
  if (ready.key.scale) {
    draw_bar(pen, ready, x, y);
    y += (kBarHeight + 2 * kGap) * em;
  }
  for (const LegendEntry& entry : ready.key.entries) {
    draw_entry(pen, entry, x, y);
    y += kRowHeight * em;
  }
}

}  // namespace

void draw_legend(LabelPen& pen, const std::vector<LegendKey>& keys, double top, double bottom) {
  // Measure all keys, in ems.
  std::vector<PreparedKey> ready;
  double height = -kBetweenKeys;
  double width = 0;
  for (const LegendKey& key : keys) {
    ready.push_back(prepared(pen, key));
    height += ready.back().height() + kBetweenKeys;
    width = std::max(width, ready.back().width(pen));
  }
  if (ready.empty()) return;

  // Make everything smaller where there is less room.
  const double room = std::max(bottom - top, 1.0);
  const double em = std::min({pen.em(), room / height, kMostShareOfWidth * pen.width() / width});
  LabelPen smaller = pen.with_em(em);
  const double x = pen.width() - pen.margin() - width * em;
  double y = std::max(top, 0.5 * (top + bottom - height * em));
  for (const PreparedKey& key : ready) {
    draw_key(smaller, key, x, y);
    y += (key.height() + kBetweenKeys) * em;
  }
}

}  // namespace bihive
