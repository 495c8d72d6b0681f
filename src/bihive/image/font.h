// The letters of legends and titles: outlines of DejaVu Sans, which the library brings along
// (data/font, docs/decisions/0019-letters-as-outlines.md), or of a font that the user chooses (image/font_file.h).
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

/// A font that is used in place of DejaVu Sans. Any number of threads may call it at a time.
class Font {
 public:
  virtual ~Font() = default;
  /// Null: the font lacks the character. A glyph lives as long as the font.
  virtual const Glyph* glyph(char32_t character) const = 0;
  /// As kerning_between(), of characters that the font has.
  virtual double kerning(char32_t left, char32_t right) const = 0;
};

/// The outline of a character (a Unicode number): of `font`, if there is one and it has the character, else of DejaVu
/// Sans; a box for one that both lack.
const Glyph& glyph_of(char32_t character, const Font* font = nullptr);

/// Kerning: added to the advance of `left` before `right`, in units of the font's size. 0 between glyphs of two fonts.
double kerning_between(char32_t left, char32_t right, const Font* font = nullptr);

/// From the line that letters stand on to the top and to the bottom of a line of text, in units of the font's size.
constexpr double kAscent = 0.76;
constexpr double kDescent = 0.24;
constexpr double kCapitalHeight = 0.73;

/// Whether one of the fonts has it; glyph_of() then gives no box.
bool has_glyph(char32_t character, const Font* font = nullptr);

/// The characters of UTF-8 text. A byte that belongs to no character is U+FFFD.
std::vector<char32_t> characters_of(std::string_view utf8);
/// Characters `begin` to before `end` as UTF-8.
std::string text_of(const std::vector<char32_t>& characters, std::size_t begin, std::size_t end);

/// The embedded file data/font/outlines.bin.
std::string_view font_outlines();

}  // namespace bihive
