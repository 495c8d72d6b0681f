#include <algorithm>

#include "bihive/image/font.h"
#include "bihive/render/picture/labels/parts.h"

namespace bihive {
namespace {

constexpr double kTitleSize = 1.35;
constexpr double kTitleLine = 1.3;  // of the title's size
constexpr int kMostTitleLines = 4;

// The lines of a title: at each line break, and between words where a line is too long.
std::vector<std::string> title_lines(const LabelPen& pen, const std::string& title, double size, double width) {
  std::vector<std::string> lines(1);
  std::string word;
  const auto end_word = [&] {
    std::string& line = lines.back();
    const std::string longer = line.empty() || word.empty() ? line + word : line + " " + word;
    if (line.empty() || pen.width_of(longer, size) <= width)
      line = longer;
    else
      lines.push_back(word);
    word.clear();
  };
  for (const char c : title) {
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r')
      end_word();
    else
      word += c;
    if (c == '\n') lines.emplace_back();
  }
  end_word();
  return lines;
}

}  // namespace

double draw_title(LabelPen& pen, const std::string& title) {
  // Make the letters smaller until all lines fit.
  const double room = pen.width() - 2 * pen.margin();
  double size = kTitleSize * pen.em();
  std::vector<std::string> lines;
  for (int attempt = 0; attempt < 8; ++attempt) {
    lines = title_lines(pen, title, size, room);
    double widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, pen.width_of(line, size));
    const bool few = lines.size() <= static_cast<std::size_t>(kMostTitleLines);
    if (widest <= room && few) break;
    size *= few ? std::min(0.98, room / widest) : 0.8;
  }

  // Draw them, each in the middle.
  double top = pen.margin() * 0.8;
  for (const std::string& line : lines) {
    const CanvasPoint start{0.5 * (pen.width() - pen.width_of(line, size)), top + kAscent * size};
    pen.write(line, start, size / pen.em());
    top += kTitleLine * size;
  }
  return top;
}

}  // namespace bihive
