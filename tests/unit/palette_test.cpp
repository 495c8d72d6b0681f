// Colours by element, by type and by text.
// ctest: asan-long

#include "bihive/scene/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/image/colour_text.h"
#include "bihive/image/transfer.h"

namespace bihive {
namespace {

// The screen's colour for a linear colour, as 0xRRGGBB.
std::uint32_t on_screen(Vec3f linear) {
  std::uint32_t rgb = 0;
  for (int channel = 0; channel < 3; ++channel)
    rgb = rgb * 256 + byte_from_radiance(double(linear[channel]), Transfer::srgb);
  return rgb;
}

TEST(Palette, ElementsLookAsJmolPaintsThem) {
  EXPECT_EQ(on_screen(element_colour(1)), 0xFFFFFFu);    // hydrogen
  EXPECT_EQ(on_screen(element_colour(6)), 0x909090u);    // carbon
  EXPECT_EQ(on_screen(element_colour(7)), 0x3050F8u);    // nitrogen
  EXPECT_EQ(on_screen(element_colour(8)), 0xFF0D0Du);    // oxygen
  EXPECT_EQ(on_screen(element_colour(16)), 0xFFFF30u);   // sulphur
  EXPECT_EQ(on_screen(element_colour(26)), 0xE06633u);   // iron
  EXPECT_EQ(on_screen(element_colour(53)), 0x940094u);   // iodine
  EXPECT_EQ(on_screen(element_colour(57)), 0x70D4FFu);   // lanthanum
  EXPECT_EQ(on_screen(element_colour(79)), 0xFFD123u);   // gold
  EXPECT_EQ(on_screen(element_colour(92)), 0x008FFFu);   // uranium
  EXPECT_EQ(on_screen(element_colour(109)), 0xEB0026u);  // meitnerium
}

TEST(Palette, UnknownElementsArePink) {
  for (const int unknown : {0, -1, 110, 255, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
    EXPECT_EQ(on_screen(element_colour(unknown)), 0xFF1493u) << unknown;
}

TEST(Palette, FortyTypesInARowDiffer) {
  for (std::int32_t type = -20; type < 20; ++type) {
    for (std::int32_t step = 1; step < 40; ++step) EXPECT_NE(type_colour(type), type_colour(type + step)) << type;
    EXPECT_EQ(type_colour(type), type_colour(type + 40)) << type;
  }
  EXPECT_EQ(on_screen(type_colour(1)), 0xE69F00u);
  EXPECT_EQ(type_colour(std::numeric_limits<std::int32_t>::min()), type_colour(32));
  EXPECT_EQ(type_colour(std::numeric_limits<std::int32_t>::max()), type_colour(7));
}

SphereSet two_spheres() {
  return *SphereSet::from_world(std::vector<double>{0, 1}, {0, 1}, {0, 1}, {1, 1});
}

TEST(Palette, ElementsGoBeforeTypes) {
  SphereSet spheres = two_spheres();
  spheres.attributes().element = {6, 8};
  spheres.attributes().type = {1, 2};
  colour_spheres(spheres);
  ASSERT_EQ(spheres.attributes().colour.size(), 2u);
  EXPECT_EQ(spheres.attributes().colour[0], element_colour(6));
  EXPECT_EQ(spheres.attributes().colour[1], element_colour(8));
}

TEST(Palette, TypesColourWhereThereAreNoElements) {
  SphereSet spheres = two_spheres();
  spheres.attributes().type = {3, -5};
  colour_spheres(spheres);
  ASSERT_EQ(spheres.attributes().colour.size(), 2u);
  EXPECT_EQ(spheres.attributes().colour[0], type_colour(3));
  EXPECT_EQ(spheres.attributes().colour[1], type_colour(-5));
}

TEST(Palette, SoftTypesAreGreyerAndDifferToo) {
  const auto range = [](Vec3f c) { return std::max({c.x, c.y, c.z}) - std::min({c.x, c.y, c.z}); };
  for (std::int32_t type = 1; type < 8; ++type) {
    const Vec3f soft = type_colour(type, ElementScheme::soft);
    EXPECT_LT(range(soft), 0.8F * range(type_colour(type))) << type;
    EXPECT_GT(range(soft), 0.7F * range(type_colour(type))) << type;
    EXPECT_NE(soft, type_colour(type + 1, ElementScheme::soft)) << type;
  }
  SphereSet spheres = two_spheres();
  spheres.attributes().type = {1, 2};
  colour_spheres(spheres, ElementScheme::soft);
  EXPECT_EQ(spheres.attributes().colour[0], type_colour(1, ElementScheme::soft));
}

TEST(Palette, GivenColoursStay) {
  SphereSet spheres = two_spheres();
  spheres.attributes().element = {6, 8};
  spheres.attributes().colour = {{0.5f, 0.25f, 0}, {1, 1, 1}};
  colour_spheres(spheres);
  EXPECT_EQ(spheres.attributes().colour[0], (Vec3f{0.5f, 0.25f, 0}));
}

TEST(Palette, NothingKnownNothingColoured) {
  SphereSet spheres = two_spheres();
  colour_spheres(spheres);
  EXPECT_TRUE(spheres.attributes().colour.empty());
}

TEST(ColourText, BytesAreSharesWithoutTransfer) {
  EXPECT_EQ(*colour_from_text("#ff8000", Transfer::none), (Vec3d{1, 128 / 255.0, 0}));
  EXPECT_EQ(*colour_from_text("#FF8000", Transfer::none), (Vec3d{1, 128 / 255.0, 0}));
  EXPECT_EQ(*colour_from_text("srgb(1,5e-1,0)", Transfer::none), (Vec3d{1, 0.5, 0}));
  EXPECT_EQ(*colour_from_text("srgb(1,0.5,0)", Transfer::srgb), (Vec3d{1, linear_from_srgb(0.5), 0}));
  for (const char* const wrong :
       {"srgb(1,0.5)", "srgb(1,0.5,0,0)", "srgb(1,0.5,1.1)", "srgb(1,,0)", "srgb(1,0,0", "srgb()"})
    EXPECT_FALSE(colour_from_text(wrong, Transfer::srgb)) << wrong;
  EXPECT_EQ(*colour_from_text("white", Transfer::none), (Vec3d{1, 1, 1}));
}

TEST(ColourText, WhatIsWrittenIsSeen) {
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    const Vec3d colour = *colour_from_text("#017f80", transfer);
    EXPECT_EQ(byte_from_radiance(colour.x, transfer), 0x01);
    EXPECT_EQ(byte_from_radiance(colour.y, transfer), 0x7f);
    EXPECT_EQ(byte_from_radiance(colour.z, transfer), 0x80);
  }
}

TEST(ColourText, EveryListedNameIsKnown) {
  std::string_view names = kColourNames;
  int count = 0;
  while (!names.empty()) {
    const std::size_t end = names.find(", ");
    const std::string_view name = names.substr(0, end);
    EXPECT_TRUE(colour_from_text(name, Transfer::srgb)) << name;
    names.remove_prefix(end == std::string_view::npos ? names.size() : end + 2);
    ++count;
  }
  EXPECT_EQ(count, 13);
}

TEST(ColourText, EverythingElseIsNothing) {
  for (const char* text : {"", "#", "#fff", "#12345g", "#1234567", "White", "white ", "ff0000", "1,0,0"})
    EXPECT_FALSE(colour_from_text(text, Transfer::srgb)) << text;
}

}  // namespace
}  // namespace bihive
