// The letters of legends and titles: outlines of DejaVu Sans, which the library brings along
// (data/font, docs/decisions/0019-letters-as-outlines.md).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bihive {

/// In units of the font's size (1 = one em): x to the right, y up from the line that letters stand on.
struct OutlinePoint {
  double x, y;
  bool on_curve;  ///< false: the control point of a quadratic curve
};

struct Glyph {
  double advance;  ///< to where the next letter begins
  std::vector<std::vector<OutlinePoint>> contours;
};

/// The outline of a character (a Unicode number); a box for one that the font lacks.
const Glyph& glyph_of(char32_t character);

/// What is added to the advance of `left` in front of `right`, in units of the font's size.
double kerning_between(char32_t left, char32_t right);

/// From the line that letters stand on to the top and to the bottom of a line of text, in units of the font's size.
constexpr double kAscent = 0.76;
constexpr double kDescent = 0.24;
constexpr double kCapitalHeight = 0.73;

/// Whether the font has it; glyph_of() then gives no box.
bool has_glyph(char32_t character);

/// The characters of UTF-8 text. A byte that belongs to no character is U+FFFD.
std::vector<char32_t> characters_of(std::string_view utf8);
/// Characters `begin` to before `end` as UTF-8.
std::string text_of(const std::vector<char32_t>& characters, std::size_t begin, std::size_t end);

/// The embedded file data/font/outlines.bin.
std::string_view font_outlines();

}  // namespace bihive
