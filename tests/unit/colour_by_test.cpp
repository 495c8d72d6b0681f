// ctest: asan-long
#include "bihive/scene/colour_by.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bihive/image/colour_text.h"
#include "bihive/scene/palette.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using testing::HasSubstr;

std::uint32_t on_screen(Vec3f linear, Transfer transfer = Transfer::srgb) {
  std::uint32_t rgb = 0;
  for (int channel = 0; channel < 3; ++channel) rgb = rgb * 256 + byte_from_radiance(double(linear[channel]), transfer);
  return rgb;
}

const SphereSet& table() {
  static const SphereFile file = test::read_text(
      "x,y,z,r,type,heat,phase,element\n"
      "0,0,0,1,1,1,wet,C\n"
      "1,0,0,1,2,10,dry,O\n"
      "2,0,0,1,9,100,wet,C\n"
      "3,0,0,1,2,,dry,Fe\n"
      "4,0,0,1,1,inf,hot,C\n"
      "5,0,0,1,1,-5,hot,C\n",
      "a.csv");
  return file.spheres;
}

std::vector<Vec3f> coloured(const std::string& text, Transfer transfer = Transfer::srgb,
                            std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(6, 1)) {
  std::vector<Vec3f> colours(6, Vec3f{0.5F, 0.5F, 0.5F});
  const Result<ColourBy> how = colour_by_from_text(text);
  EXPECT_TRUE(how.ok()) << text;
  const auto status = colour_by(table(), *how, mask, transfer, colours);
  EXPECT_TRUE(status.ok()) << text << ": " << status.error().to_string();
  return colours;
}

// Colours that the authors of the maps publish.
TEST(ColourMaps, HaveTheirPublishedColours) {
  const struct {
    ColourMap::Name map;
    double share;
    std::uint32_t colour;
  } cases[] = {
      {ColourMap::viridis, 0, 0x440154},    {ColourMap::viridis, 0.5, 0x21908C}, {ColourMap::viridis, 1, 0xFDE725},
      {ColourMap::magma, 0, 0x000004},      {ColourMap::magma, 0.5, 0xB63779},   {ColourMap::magma, 1, 0xFCFDBF},
      {ColourMap::cividis, 0, 0x00204D},    {ColourMap::cividis, 1, 0xFFEA46},   {ColourMap::coolwarm, 0, 0x3B4CC0},
      {ColourMap::coolwarm, 0.5, 0xDDDDDD}, {ColourMap::coolwarm, 1, 0xB40426},
  };
  for (const auto& one : cases)
    for (const Transfer transfer : {Transfer::srgb, Transfer::none})
      EXPECT_EQ(on_screen(map_colour(one.map, one.share, transfer), transfer), one.colour) << one.share;
  EXPECT_EQ(map_colour(ColourMap::magma, -3, Transfer::srgb), map_colour(ColourMap::magma, 0, Transfer::srgb));
  EXPECT_EQ(map_colour(ColourMap::magma, INFINITY, Transfer::srgb), map_colour(ColourMap::magma, 1, Transfer::srgb));
}

TEST(ColourMaps, LightnessRises) {
  for (const ColourMap::Name map : {ColourMap::viridis, ColourMap::magma, ColourMap::cividis}) {
    double before = -1;
    for (int i = 0; i <= 100; ++i) {
      const Vec3f c = map_colour(map, i / 100.0, Transfer::srgb);
      const double luminance = 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
      EXPECT_GT(luminance, before) << i;
      before = luminance;
    }
  }
}

TEST(ColourMaps, AreOfOwnColoursToo) {
  const ColourMap map = colour_map_from("blue-white-#ff8000").value();
  EXPECT_EQ(map.colours, (std::vector<std::uint32_t>{0x0000FF, 0xFFFFFF, 0xFF8000}));
  EXPECT_EQ(text_of_colours(map.colours), "#0000ff-#ffffff-#ff8000");
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    EXPECT_EQ(on_screen(map_colour(map, 0.5, transfer), transfer), 0xFFFFFFU);
    EXPECT_EQ(on_screen(map_colour(map, 0.75, transfer), transfer), 0xFFBF80U);
    EXPECT_EQ(on_screen(map_colour(reversed(map), 0.25, transfer), transfer), 0xFFBF80U);
  }
  EXPECT_EQ(coloured("heat:blue-white-#ff8000:100,-5"), coloured("heat:#ff8000-white-blue:-5,100"));
  for (const char* wrong : {"blue", "blue-", "-blue", "blue--white", "blue-wihte", "blue-white_r"})
    EXPECT_FALSE(colour_map_from(wrong)) << wrong;
  std::string many = "red";
  for (std::size_t i = 1; i < kMostMapColours; ++i) many += "-red";
  EXPECT_TRUE(colour_map_from(many));
  EXPECT_FALSE(colour_map_from(many + "-red"));
}

TEST(ColourMaps, AreReadFromFiles) {
  using Colours = std::vector<std::uint32_t>;
  EXPECT_EQ(read_colour_map("# of my own\n#0000ff\n\nwhite\n#FF8000", "m").value(),
            (Colours{0x0000FF, 0xFFFFFF, 0xFF8000}));
  EXPECT_EQ(read_colour_map("0 0 1\n1, 1,1\n1,0.5,0\n", "m").value(), (Colours{0x0000FF, 0xFFFFFF, 0xFF8000}));
  EXPECT_EQ(read_colour_map("0 0 1\nred\n255\t128 0\n", "m").value(), (Colours{0x000001, 0xFF0000, 0xFF8000}));
  for (const auto& [text, message] : {std::pair{"", "m: a colour map has at least two colours"},
                                      {"red\n", "m: a colour map has at least two colours"},
                                      {"red\n1 2\n", "m:2: expected a colour but found '1 2'"},
                                      {"red\n1 2 256\n", "m:2: expected a colour"},
                                      {"red\n1 -2 25\n", "m:2: expected a colour"},
                                      {"red\n1 2 3 4\n", "m:2: expected a colour"},
                                      {"rde\n1 2 3\n", "m:1: expected a colour but found 'rde'"}}) {
    const auto colours = read_colour_map(text, "m");
    ASSERT_FALSE(colours.ok()) << text;
    EXPECT_THAT(colours.error().to_string(), HasSubstr(message));
  }
  EXPECT_FALSE(read_colour_map(std::string(5000, '\n').insert(0, "1 1 1") + "1 1 1\n1 x 1", "m").ok());
  std::string many;
  for (std::size_t i = 0; i <= kMostMapColours; ++i) many += "1 1 1\n";
  EXPECT_THAT(read_colour_map(many, "m").error().to_string(), HasSubstr("m:1025: a colour map has at most 1024"));

  EXPECT_EQ(colour_map_file("heat:maps/a.txt:0,1"), "maps/a.txt");
  EXPECT_EQ(colour_map_file("heat:a.txt"), "a.txt");
  for (const char* none :
       {"heat", "heat:magma", "heat:0.5,1.5", "heat:mid=0.5", "heat:log", "a.b:jet", "heat:red-blue"})
    EXPECT_EQ(colour_map_file(none), "") << none;
  EXPECT_EQ(with_map("heat:a.txt:0,1", {0xFF, 0xFFFFFF}), "heat:#0000ff-#ffffff:0,1");
  EXPECT_EQ(with_map("heat:a.txt", {0xFF, 0xFFFFFF}), "heat:#0000ff-#ffffff");
}

TEST(ColourBy, AFiniteRangeIsTheDefault) {
  const auto colours = coloured("heat");
  EXPECT_EQ(colours[5], map_colour(ColourMap::viridis, 0, Transfer::srgb)) << "-5 is least";
  EXPECT_EQ(colours[2], map_colour(ColourMap::viridis, 1, Transfer::srgb)) << "100 is most";
  EXPECT_EQ(colours[4], colours[2]) << "infinity has the end's colour";
  EXPECT_EQ(on_screen(colours[3]), 0x808080u) << "unknown";
  EXPECT_EQ(colours[0], map_colour(ColourMap::viridis, (1.0 / 2 + 5.0 / 2) / (100.0 / 2 + 5.0 / 2), Transfer::srgb));
}

TEST(ColourBy, ARangeOfOwnAndALogarithm) {
  const auto colours = coloured("heat:magma:1,100:log");
  EXPECT_EQ(on_screen(colours[1]), on_screen(map_colour(ColourMap::magma, 0.5, Transfer::srgb)));
  EXPECT_EQ(colours[5], colours[0]) << "-5 lies below a logarithmic range";
  EXPECT_EQ(coloured("heat:magma:10,100:log")[5], map_colour(ColourMap::magma, 0, Transfer::srgb));
  EXPECT_EQ(coloured("heat:magma_r:10,100:log")[5], map_colour(ColourMap::magma, 1, Transfer::srgb));
  EXPECT_EQ(coloured("heat:magma:log")[0], map_colour(ColourMap::magma, 0, Transfer::srgb));
  EXPECT_EQ(coloured("heat::5,20")[0], map_colour(ColourMap::viridis, 0, Transfer::srgb)) << "below the range";
}

TEST(ColourBy, OnlySelectedSpheresCountAndChange) {
  const auto colours = coloured("x", Transfer::srgb, {0, 1, 1, 0, 0, 0});
  EXPECT_EQ(colours[1], map_colour(ColourMap::viridis, 0, Transfer::srgb));
  EXPECT_EQ(colours[2], map_colour(ColourMap::viridis, 1, Transfer::srgb));
  EXPECT_EQ(colours[0], (Vec3f{0.5F, 0.5F, 0.5F}));
}

TEST(ColourBy, CategoriesForTextsTypesAndElements) {
  EXPECT_EQ(coloured("phase")[0], type_colour(1));
  EXPECT_EQ(coloured("phase")[1], type_colour(2));
  EXPECT_EQ(coloured("phase")[5], type_colour(3));
  EXPECT_EQ(coloured("type")[2], type_colour(9));
  EXPECT_EQ(coloured("element")[1], element_colour(8));
  EXPECT_EQ(coloured("heat:okabe-ito")[1], type_colour(10));
  EXPECT_EQ(coloured("type:viridis")[2], map_colour(ColourMap::viridis, 1, Transfer::srgb)) << "numbers, if asked for";
  EXPECT_EQ(on_screen(coloured("phase", Transfer::none)[0], Transfer::none), on_screen(type_colour(1)));
}

TEST(ColourBy, MapsAreReversedAndRangesArePercentilesOrHaveAMiddle) {
  EXPECT_EQ(coloured("heat:magma_r"), coloured("heat:magma:100,-5"));
  EXPECT_EQ(coloured("heat:magma_r")[5], map_colour(ColourMap::magma, 1, Transfer::srgb)) << "-5 is least";
  EXPECT_EQ(coloured("heat:magma_r:100,-5"), coloured("heat:magma:-5,100")) << "reversed twice";
  EXPECT_EQ(coloured("heat:0%,100%"), coloured("heat"));
  EXPECT_EQ(coloured("heat:100%,0%"), coloured("heat:viridis_r"));
  EXPECT_EQ(coloured("heat:coolwarm:mid=0"), coloured("heat:coolwarm:-100,100"));
  EXPECT_EQ(coloured("heat:coolwarm:-5,5:mid=1"), coloured("heat:coolwarm:-5,7"));
  EXPECT_EQ(coloured("heat:log:mid=10"), coloured("heat:1,100:log")) << "1 to 100, with 10 in the middle";
  EXPECT_EQ(colour_map_names().size(), 10U);
  for (const std::string& name : colour_map_names())
    EXPECT_EQ(colour_map_from(name + "_r").has_value(), name != "okabe-ito") << name;
  // Five numbers: a quarter lies at the second.
  const SphereFile file =
      test::read_text("x,y,z,r,n\n0,0,0,1,0\n1,0,0,1,1\n2,0,0,1,2\n3,0,0,1,3\n4,0,0,1,1000\n", "a.csv");
  const std::vector<std::uint8_t> all(5, 1);
  std::vector<Vec3f> colours(5);
  const auto done = colour_by(file.spheres, *colour_by_from_text("n:25%,75%"), all, Transfer::srgb, colours);
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(*done->range, (std::pair{1.0, 3.0}));
  EXPECT_EQ(*colour_by(file.spheres, *colour_by_from_text("n:0%,10%"), all, Transfer::srgb, colours)->range,
            (std::pair{0.0, 0.4}));
}

TEST(ColourBy, ExpressionsAreNumbers) {
  EXPECT_EQ(coloured("heat * 2"), coloured("heat"));
  EXPECT_EQ(coloured("-heat:magma"), coloured("heat:magma_r"));
  std::vector<Vec3f> colours(6);
  const auto error_of = [&](const char* text) {
    const auto done =
        colour_by(table(), *colour_by_from_text(text), std::vector<std::uint8_t>(6, 1), Transfer::srgb, colours);
    EXPECT_FALSE(done.ok()) << text;
    return done.ok() ? "" : done.error().to_string();
  };
  EXPECT_THAT(error_of("haet + 1"),
              HasSubstr("'haet + 1': column 1: there is no attribute 'haet'; did you mean 'heat'?"));
  EXPECT_THAT(error_of("heat * (1"), HasSubstr("column 10: expected"));
  EXPECT_THAT(error_of("phase + 1"), HasSubstr("'phase' holds texts"));
  EXPECT_THAT(error_of("nothing"), HasSubstr("there is no attribute \"nothing\""));
}

TEST(ColourBy, FaultsAreNamed) {
  for (const auto& [text, message] :
       {std::pair{"", "expected the name of an attribute"},
        {"x:jet", "there is no colour map \"jet\"; there are viridis, magma"},
        {"x:magma:3", "expected a range MIN,MAX"},
        {"x:magma:3,3", "expected a range MIN,MAX"},
        {"x:magma:nan,3", "expected a range MIN,MAX"},
        {"x:magma:0,3:log", "begins above 0"},
        {"x:magma:1,3:lg", "expected a range MIN,MAX, \"log\" or \"mid=NUMBER\", each once, found \"lg\""},
        {"x:magma:1,3:log:x", "each once, found \"x\""},
        {"x:log:log", "each once, found \"log\""},
        {"x:magma:2%,98", "expected a range MIN,MAX"},
        {"x:magma:2%,198%", "expected a range MIN,MAX"},
        {"x:mid=q", "expected a number after mid="},
        {"x:log:mid=-1", "the middle of a logarithmic range is above 0"},
        {"x:okabe-ito:1,2", "okabe-ito is for categories"},
        {"x:okabe-ito_r", "there is no colour map"}}) {
    const Result<ColourBy> how = colour_by_from_text(text);
    ASSERT_FALSE(how.ok()) << text;
    EXPECT_THAT(how.error().to_string(), HasSubstr(message));
  }
  std::vector<Vec3f> colours(6);
  const auto status =
      colour_by(table(), *colour_by_from_text("phase:magma"), std::vector<std::uint8_t>(6, 1), Transfer::srgb, colours);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("holds texts, and this map needs numbers"));
}

}  // namespace
}  // namespace bihive
