// Shapes with exact edges, letters, and how masks are blended over pixels.
// ctest: asan-long
#include "bihive/image/shape.h"

#include <gtest/gtest.h>

#include "bihive/image/font.h"
#include "bihive/image/overlay.h"

namespace bihive {
namespace {

double area_of(const CoverageMask& mask) {
  double sum = 0;
  for (const float share : mask.shares) sum += double(share);
  return sum;
}

TEST(Shape, a_rectangle_covers_its_area_of_each_pixel) {
  Shape shape;
  shape.add_rectangle({1.5, -0.25, 3.25, 1});
  const CoverageMask mask = mask_of(shape);
  EXPECT_EQ(mask.at(1, 0), 0.5F);
  EXPECT_EQ(mask.at(2, 0), 1);
  EXPECT_EQ(mask.at(3, 0), 0.25F);
  EXPECT_EQ(mask.at(2, -1), 0.25F);
  EXPECT_EQ(mask.at(4, 0), 0);
  EXPECT_EQ(mask.at(2, 1), 0);
}

TEST(Shape, a_triangle_has_its_area_whichever_way_round) {
  Shape one, other, both;
  one.add_polygon({{0.3, 0.2}, {7.9, 1.4}, {2.2, 9.7}});
  other.add_polygon({{2.2, 9.7}, {7.9, 1.4}, {0.3, 0.2}});
  const double area = 0.5 * ((7.9 - 0.3) * (9.7 - 0.2) - (2.2 - 0.3) * (1.4 - 0.2));
  EXPECT_NEAR(area_of(mask_of(one)), area, 1e-5);
  EXPECT_EQ(mask_of(one).shares, mask_of(other).shares);
  both.add_polygon({{0.3, 0.2}, {7.9, 1.4}, {2.2, 9.7}});
  both.add_polygon({{2.2, 9.7}, {7.9, 1.4}, {0.3, 0.2}});
  EXPECT_EQ(mask_of(both).at(3, 3), 1) << "polygons above each other cover, and never cancel";
}

TEST(Shape, lines_and_discs_have_their_area) {
  Shape line, disc, none;
  line.add_line({1, 1}, {4, 5}, 0.5);
  EXPECT_NEAR(area_of(mask_of(line)), 5 * 0.5, 1e-5);
  disc.add_disc({10, 10}, 4);
  EXPECT_NEAR(area_of(mask_of(disc)), 3.14159265 * 16, 0.1);
  none.add_line({1, 1}, {1, 1}, 3);
  EXPECT_EQ(area_of(mask_of(none)), 0);
}

TEST(Shape, letters_stand_on_their_line_and_advance) {
  Shape shape;
  shape.add_text("E", {10, 50}, 40);
  const CoverageMask mask = mask_of(shape);
  EXPECT_EQ(mask.pixels.y1, 50);
  EXPECT_NEAR(mask.pixels.y0, 50 - 40 * kCapitalHeight, 1);
  EXPECT_GT(mask.pixels.x0, 10);
  EXPECT_LT(mask.pixels.x1, 10 + text_width("E", 40));
  EXPECT_DOUBLE_EQ(text_width("mm", 10), 2 * text_width("m", 10));
  EXPECT_LT(text_width("AV", 10), text_width("A", 10) + text_width("V", 10)) << "kerning";
}

TEST(Shape, a_letter_has_its_hole) {
  Shape shape;
  shape.add_text("O", {0, 100}, 100);
  const CoverageMask mask = mask_of(shape);
  EXPECT_EQ(mask.at((mask.pixels.x0 + mask.pixels.x1) / 2, 100 - 36), 0);
  EXPECT_GT(area_of(mask), 500);
}

TEST(Font, has_the_characters_of_figures_and_a_box_for_others) {
  const Glyph* const box = &glyph_of(0x4E2D);
  for (const char32_t character : characters_of("AZaz09~ÄßÅµ°×²αβγΩ⁻⁰¹⁵₂−–…\u212B≤≥∞"))
    EXPECT_NE(&glyph_of(character), box) << static_cast<unsigned>(character);
  EXPECT_FALSE(box->contours.empty());
  EXPECT_EQ(&glyph_of(0xFFFD), box);
  EXPECT_EQ(&glyph_of(0x1F600), box);
  EXPECT_TRUE(glyph_of(U' ').contours.empty());
}

TEST(Font, reads_utf8_and_replaces_what_is_none) {
  EXPECT_EQ(characters_of("aÅ−😀"), (std::vector<char32_t>{U'a', 0xC5, 0x2212, 0x1F600}));
  EXPECT_EQ(characters_of("\xC5"), (std::vector<char32_t>{0xFFFD}));
  EXPECT_EQ(characters_of("\xC0\x80z"), (std::vector<char32_t>{0xFFFD, 0xFFFD, U'z'}));
  EXPECT_EQ(characters_of("\xED\xA0\x80"), (std::vector<char32_t>{0xFFFD, 0xFFFD, 0xFFFD}));
}

TEST(Shape, a_wider_mask_reaches_as_far_as_asked_for) {
  Shape shape;
  shape.add_rectangle({10, 10, 12, 12});
  const CoverageMask wide = widened(mask_of(shape), 3);
  EXPECT_EQ(wide.at(11, 11), 1);
  EXPECT_EQ(wide.at(8, 11), 1);
  EXPECT_EQ(wide.at(7, 11), 0.5F);
  EXPECT_EQ(wide.at(6, 11), 0);
  EXPECT_EQ(wide.at(7, 7), 0) << "round at the corners";
}

TEST(Overlay, covers_finished_pixels_by_the_share) {
  for (const int bits : {8, 16}) {
    PngPixels pixels{2, 1, 3, bits, std::vector<std::uint8_t>(static_cast<std::size_t>(6 * bits / 8), 0)};
    Shape shape;
    shape.add_rectangle({0, 0, 1.5, 1});
    blend(pixels, {0, 0, 2, 1}, mask_of(shape), {1, 0.2, 0});
    EXPECT_EQ(pixels.bytes[0], 255);
    const std::size_t second = static_cast<std::size_t>(3 * bits / 8);
    EXPECT_NEAR(pixels.bytes[second], 127.5, 0.6);
    EXPECT_EQ(pixels.bytes[second / 3], 51) << bits;
    EXPECT_EQ(pixels.bytes.back(), 0);
  }
}

TEST(Overlay, opacity_grows_like_that_of_layers) {
  // Nothing, half covered by red: red of half opacity. Blue of opacity 0.4, half covered by red: 0.7 in all.
  PngPixels pixels{2, 1, 4, 8, {0, 0, 0, 0, 0, 0, 255, 102}};
  Shape shape;
  shape.add_rectangle({0, 0, 2, 0.5});
  blend(pixels, {0, 0, 2, 1}, mask_of(shape), {1, 0, 0});
  EXPECT_EQ(pixels.bytes[0], 255);
  EXPECT_EQ(pixels.bytes[3], 128);
  EXPECT_EQ(pixels.bytes[4], 182) << "0.5 / 0.7 of 255";
  EXPECT_EQ(pixels.bytes[6], 73);
  EXPECT_NEAR(pixels.bytes[7], 0.7 * 255, 0.6);
}

TEST(Overlay, a_part_holds_the_pixels_of_the_whole) {
  PngPixels whole{8, 6, 3, 8, std::vector<std::uint8_t>(8 * 6 * 3, 200)};
  const Tile part{2, 1, 7, 5};
  PngPixels cut{5, 4, 3, 8, std::vector<std::uint8_t>(5 * 4 * 3, 200)};
  Shape shape;
  shape.add_text("g", {0.3, 4.2}, 8);
  blend(whole, {0, 0, 8, 6}, mask_of(shape), {0, 0, 0});
  blend(cut, part, mask_of(shape), {0, 0, 0});
  for (int y = part.y0; y < part.y1; ++y)
    for (int i = 0; i < 3 * part.width(); ++i)
      EXPECT_EQ(cut.bytes[static_cast<std::size_t>((y - part.y0) * 15 + i)],
                whole.bytes[static_cast<std::size_t>(y * 24 + 3 * part.x0 + i)]);
}

}  // namespace
}  // namespace bihive
