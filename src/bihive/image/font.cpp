#include "bihive/image/font.h"

#include <cstdint>
#include <unordered_map>

#include "bihive/base/check.h"

namespace bihive {
namespace {

// Reads the embedded numbers one after the other (data/font/bake_outlines.cpp describes them).
class OutlineReader {
 public:
  explicit OutlineReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t number() {
    BIHIVE_CHECK(at_ + 2 <= bytes_.size());
    const auto low = static_cast<unsigned char>(bytes_[at_]);
    const auto high = static_cast<unsigned char>(bytes_[at_ + 1]);
    at_ += 2;
    return low | static_cast<std::uint32_t>(high) << 8;
  }
  int signed_number() { return static_cast<std::int16_t>(number()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct OutlineTable {
  std::unordered_map<char32_t, Glyph> glyphs;
  std::unordered_map<std::uint32_t, double> kerning;  // by the two characters
};

std::uint32_t pair_of(char32_t left, char32_t right) {
  return static_cast<std::uint32_t>(left) << 16 | static_cast<std::uint32_t>(right);
}

Glyph read_glyph(OutlineReader& reader, double unit) {
  Glyph glyph;
  glyph.advance = reader.signed_number() / unit;
  glyph.contours.resize(reader.number());
  for (std::vector<OutlinePoint>& contour : glyph.contours) {
    contour.resize(reader.number());
    for (OutlinePoint& point : contour) {
      const int x_and_flag = reader.signed_number();
      point.on_curve = (x_and_flag & 1) != 0;
      point.x = 0.5 * (x_and_flag - (point.on_curve ? 1 : 0)) / unit;
      point.y = reader.signed_number() / unit;
    }
  }
  return glyph;
}

OutlineTable read_outlines() {
  OutlineTable font;
  OutlineReader reader(font_outlines());
  const double unit = reader.number();
  reader.number();  // its own ascent and descent leave room for accents on capitals
  reader.number();
  const std::uint32_t glyphs = reader.number();
  const std::uint32_t pairs = reader.number();
  for (std::uint32_t i = 0; i < glyphs; ++i) {
    const char32_t character = reader.number();
    font.glyphs.emplace(character, read_glyph(reader, unit));
  }
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const char32_t left = reader.number();
    const char32_t right = reader.number();
    font.kerning.emplace(pair_of(left, right), reader.signed_number() / unit);
  }
  return font;
}

const OutlineTable& dejavu_sans() {
  static const OutlineTable font = read_outlines();
  return font;
}

// The bytes of the character at the begin of the text, or 0 if it is no UTF-8 [RFC3629]; `character` is set then.
std::size_t decode(std::string_view text, char32_t& character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4 || length > text.size()) return 0;
  character = length == 1 ? first : first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    character = character << 6 | (byte(i) & 0x3FU);
  }
  const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
  return character < kLeast[length] || surrogate || character > 0x10FFFF ? 0 : length;
}

}  // namespace

const Glyph& glyph_of(char32_t character, const Font* font) {
  if (font != nullptr)
    if (const Glyph* const glyph = font->glyph(character)) return *glyph;
  const OutlineTable& own = dejavu_sans();
  const auto known = own.glyphs.find(character);
  return known != own.glyphs.end() ? known->second : own.glyphs.at(0);
}

bool has_glyph(char32_t character, const Font* font) {
  if (font != nullptr && font->glyph(character) != nullptr) return true;
  return character != 0 && dejavu_sans().glyphs.count(character) > 0;
}

double kerning_between(char32_t left, char32_t right, const Font* font) {
  if (font != nullptr) {
    const bool has_left = font->glyph(left) != nullptr, has_right = font->glyph(right) != nullptr;
    if (has_left && has_right) return font->kerning(left, right);
    if (has_left || has_right) return 0;
  }
  if (left > 0xFFFF || right > 0xFFFF) return 0;
  const OutlineTable& own = dejavu_sans();
  const auto known = own.kerning.find(pair_of(left, right));
  return known != own.kerning.end() ? known->second : 0;
}

std::vector<char32_t> characters_of(std::string_view utf8) {
  std::vector<char32_t> characters;
  while (!utf8.empty()) {
    char32_t character = 0xFFFD;
    const std::size_t length = decode(utf8, character);
    characters.push_back(length > 0 ? character : 0xFFFD);
    utf8.remove_prefix(length > 0 ? length : 1);
  }
  return characters;
}

std::string text_of(const std::vector<char32_t>& characters, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i) {
    const char32_t c = characters[i];
    const auto add = [&](unsigned mark, char32_t bits) { text += static_cast<char>(mark | bits); };
    if (c < 0x80) {
      add(0, c);
    } else {
      if (c >= 0x10000)
        add(0xF0, c >> 18), add(0x80, c >> 12 & 0x3F);
      else if (c >= 0x800)
        add(0xE0, c >> 12);
      if (c >= 0x800)
        add(0x80, c >> 6 & 0x3F);
      else
        add(0xC0, c >> 6);
      add(0x80, c & 0x3F);
    }
  }
  return text;
}

}  // namespace bihive
