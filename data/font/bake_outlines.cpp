// Writes the outlines of a font's characters, as FreeType reads them, into the file that the library embeds
// (src/bihive/image/font.h reads it). Called by scripts/bake_font; not part of the build.
//
//   bake_outlines FONT.ttf OUTPUT
//
// The file holds 16-bit numbers, the lower byte first: units per em, ascent, descent (positive), glyph count, pair
// count. For each glyph: character (0: the box for unknown ones), advance, contour count; for each contour: point
// count; for each point: 2 x + (1 if it lies on the outline), y. For each kerning pair: left and right character, and
// what is added between them. Glyphs and pairs rise by character. All lengths are the font's units, so the bytes
// depend on the font alone and not on FreeType's version.
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

// Ranges of characters, both ends included.
constexpr std::uint32_t kRanges[][2] = {
    {0x20, 0x7E},      // ASCII
    {0xA0, 0xFF},      // Latin-1
    {0x131, 0x131},    // dotless i
    {0x152, 0x153},    // OE
    {0x391, 0x3A1},    // Greek capitals
    {0x3A3, 0x3A9},    //
    {0x3B1, 0x3C9},    // Greek small letters
    {0x3D1, 0x3D1},    // theta as a symbol
    {0x3D5, 0x3D5},    // phi as a symbol
    {0x2010, 0x2015},  // dashes
    {0x2018, 0x201A},  // quotes
    {0x201C, 0x201E},  //
    {0x2022, 0x2022},  // bullet
    {0x2026, 0x2026},  // ellipsis
    {0x2030, 0x2030},  // per mille
    {0x2032, 0x2033},  // primes
    {0x2070, 0x2071},  // superscripts
    {0x2074, 0x208E},  // superscripts, subscripts
    {0x2113, 0x2113},  // litre
    {0x212B, 0x212B},  // angstrom
    {0x2190, 0x2193},  // arrows
    {0x2202, 0x2202},  // partial
    {0x2206, 0x2207},  // increment, nabla
    {0x2211, 0x2212},  // sum, minus
    {0x221A, 0x221A},  // root
    {0x221D, 0x221E},  // proportional, infinity
    {0x222B, 0x222B},  // integral
    {0x2248, 0x2248},  // almost equal
    {0x2260, 0x2261},  // not equal, identical
    {0x2264, 0x2265},  // less or equal, greater or equal
    {0x27E8, 0x27E9},  // angle brackets
};

class Output {
 public:
  void put(long number) {
    if (number < -32768 || number > 65535) overflow = true;
    bytes += static_cast<char>(number & 0xFF);
    bytes += static_cast<char>((number >> 8) & 0xFF);
  }
  std::string bytes;
  bool overflow = false;
};

constexpr FT_Int32 kUnscaled = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;

bool put_glyph(FT_Face face, std::uint32_t character, Output& output) {
  const FT_UInt index = character == 0 ? 0 : FT_Get_Char_Index(face, character);
  if (FT_Load_Glyph(face, index, kUnscaled) != 0) return false;
  const FT_Outline& outline = face->glyph->outline;
  output.put(static_cast<long>(character));
  output.put(face->glyph->advance.x);
  output.put(outline.n_contours);
  int first = 0;
  for (int contour = 0; contour < outline.n_contours; ++contour) {
    const int last = outline.contours[contour];
    output.put(last - first + 1);
    for (int i = first; i <= last; ++i) {
      output.put(2 * outline.points[i].x + (outline.tags[i] & 1));
      output.put(outline.points[i].y);
      if ((outline.tags[i] & 3) == 2) return false;  // a cubic curve; TrueType has none
    }
    first = last + 1;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (argc != 3 || FT_Init_FreeType(&library) != 0 || FT_New_Face(library, argv[1], 0, &face) != 0) {
    std::fprintf(stderr, "usage: bake_outlines FONT.ttf OUTPUT\n");
    return 2;
  }

  // Take the characters that the font has.
  std::vector<std::uint32_t> characters;
  for (const auto& range : kRanges)
    for (std::uint32_t character = range[0]; character <= range[1]; ++character)
      if (FT_Get_Char_Index(face, character) != 0)
        characters.push_back(character);
      else
        std::fprintf(stderr, "bake_outlines: the font has no U+%04X\n", character);

  // Find the pairs of ASCII letters that the font moves.
  Output pairs;
  long pair_count = 0;
  for (std::uint32_t left = 0x21; left <= 0x7E; ++left)
    for (std::uint32_t right = 0x21; right <= 0x7E; ++right) {
      FT_Vector kerning{0, 0};
      FT_Get_Kerning(face, FT_Get_Char_Index(face, left), FT_Get_Char_Index(face, right), FT_KERNING_UNSCALED,
                     &kerning);
      if (kerning.x == 0) continue;
      pairs.put(static_cast<long>(left));
      pairs.put(static_cast<long>(right));
      pairs.put(kerning.x);
      ++pair_count;
    }

  // Write everything.
  Output output;
  output.put(face->units_per_EM);
  output.put(face->ascender);
  output.put(-face->descender);
  output.put(static_cast<long>(characters.size()) + 1);
  output.put(pair_count);
  bool good = put_glyph(face, 0, output);
  for (const std::uint32_t character : characters) good = put_glyph(face, character, output) && good;
  output.bytes += pairs.bytes;
  std::ofstream file(argv[2], std::ios::binary);
  file << output.bytes;
  file.close();
  if (!good || output.overflow || pairs.overflow || !file) {
    std::fprintf(stderr, "bake_outlines: %s cannot be written from %s\n", argv[2], argv[1]);
    return 1;
  }
  std::printf("%s: %zu characters, %ld pairs, %zu bytes\n", argv[2], characters.size(), pair_count,
              output.bytes.size());
  return 0;
}
