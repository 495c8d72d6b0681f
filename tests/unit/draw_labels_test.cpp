// Legend, scale bar, axes and title over finished pixels; and what a legend says.
// ctest: asan-long
#include "bihive/render/draw_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bihive/io/bundled.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/legend.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/looks.h"

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kRow = "x,y,z,r,charge,part\n0,0,0,1,-1,a\n1,0,0,1,,b\n2,0,0,1,0,a\n3,0,0,1,1,c\n4,0,0,2,3,b\n";

Scene row(const std::vector<Look>& looks) {
  Result<LoadedScene> loaded = load_scene(kRow, "a.csv");
  EXPECT_TRUE(loaded.ok());
  EXPECT_TRUE(apply_looks(loaded->scene, looks).ok());
  loaded->scene.camera = with_projection(loaded->scene.camera, Projection::orthographic);
  return std::move(loaded->scene);
}

ColourBy by(const std::string& text) {
  return *colour_by_from_text(text);
}

RenderSettings sized(int width_px, int height_px, const Labels& labels) {
  RenderSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.labels = labels;
  return settings;
}

// The pixels of an empty picture with its labels.
PngPixels labelled(const Scene& scene, const RenderSettings& settings, int channels = 3, int bits = 8, double dpi = 0) {
  const Tile part = drawn_pixels(settings);
  PngPixels pixels{part.width(), part.height(), channels, bits, {}};
  const std::uint8_t empty = channels == 4 ? 0 : 255;
  pixels.bytes.assign(pixels.row_bytes() * static_cast<std::size_t>(part.height()), empty);
  EXPECT_TRUE(check_labels(scene, settings).ok());
  RenderSettings printed = settings;
  printed.dots_per_inch = dpi;
  draw_labels(pixels, scene, printed);
  return pixels;
}

const std::uint8_t* pixel_at(const PngPixels& pixels, int x, int y) {
  return &pixels.bytes[static_cast<std::size_t>(y) * pixels.row_bytes() +
                       static_cast<std::size_t>(x * pixels.channels * (pixels.bits / 8))];
}

bool is_white(const PngPixels& pixels, int x, int y) {
  const std::uint8_t* const at = pixel_at(pixels, x, y);
  return at[0] == 255 && at[1] == 255 && at[2] == 255;
}

// The first and last column and row that are not white; the end is not included.
Tile drawn_area(const PngPixels& pixels, const Tile& within) {
  Tile area{within.x1, within.y1, within.x0, within.y0};
  for (int y = within.y0; y < within.y1; ++y)
    for (int x = within.x0; x < within.x1; ++x) {
      if (is_white(pixels, x, y)) continue;
      area = {std::min(area.x0, x), std::min(area.y0, y), std::max(area.x1, x + 1), std::max(area.y1, y + 1)};
    }
  return area;
}

TEST(Legend, says_what_coloured_the_spheres_that_are_there) {
  const Scene scene = row({{"all", {by("charge:magma")}}, {"part b", {by("part")}}, {"part c", {SetShown{false}}}});
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].title, "charge");
  ASSERT_TRUE(keys[0].scale.has_value());
  EXPECT_EQ(keys[0].scale->map, ColourMap::magma);
  EXPECT_EQ(keys[0].scale->range, (std::pair{-1.0, 3.0}));
  EXPECT_TRUE(keys[0].entries.empty()) << "the sphere without a charge has another colour";
  EXPECT_EQ(keys[1].title, "part");
  ASSERT_EQ(keys[1].entries.size(), 1u);
  EXPECT_EQ(keys[1].entries[0].name, "b");
  const Vec3f colour = scene.spheres.attributes().colour[1];
  EXPECT_EQ(keys[1].entries[0].colour, screen_colour(to_double(colour), Transfer::srgb));
}

TEST(Legend, unknown_numbers_have_their_colour_and_other_colours_no_meaning) {
  const std::vector<LegendKey> keys = legend_of(row({{"all", {by("charge::-2,2")}}}));
  ASSERT_EQ(keys.size(), 1u);
  ASSERT_EQ(keys[0].entries.size(), 1u);
  EXPECT_EQ(keys[0].entries[0].name, "unknown");
  EXPECT_EQ(keys[0].scale->range, (std::pair{-2.0, 2.0}));
  EXPECT_TRUE(legend_of(row({{"all", {by("charge"), SetColour{std::string("red")}}}})).empty());
  EXPECT_TRUE(legend_of(row({})).empty());
}

TEST(Legend, lists_elements_by_number) {
  const auto loaded = load_scene(bundled_molecule(), "1hpv.pdb");
  ASSERT_TRUE(loaded.ok());
  const std::vector<LegendKey> keys = legend_of(loaded->scene);
  ASSERT_EQ(keys.size(), 1u);
  std::vector<std::string> names;
  for (const LegendEntry& entry : keys[0].entries) names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("C", "N", "O", "S"));
  EXPECT_EQ(loaded->scene.length_unit, "Å");
}

TEST(DrawLabels, a_pixel_of_the_bar_has_the_map_s_colour) {
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    Scene scene = row({{"all", {by("x:viridis")}}});
    scene.picture.transfer = transfer;
    const PngPixels pixels = labelled(scene, sized(640, 480, {.legend = true}));
    // Find the bar: a column of colours between dark frame lines. Its rows run through the map from the end down.
    int rows = 0, x = 639;
    Tile bar{0, 0, 0, 0};
    const auto is_colour = [&](int column, int y) {
      const std::uint8_t* const at = pixel_at(pixels, column, y);
      return std::abs(at[0] - at[1]) + std::abs(at[1] - at[2]) > 40;
    };
    for (; x > 0 && rows < 50; --x) {
      rows = 0;
      for (int y = 0; y < 480; ++y) {
        if (!is_colour(x, y)) continue;
        if (rows == 0) bar.y0 = y;
        bar.y1 = y + 1;
        ++rows;
      }
    }
    ASSERT_GE(rows, 50);
    EXPECT_EQ(rows, bar.height()) << "without a gap";
    for (int y = bar.y0; y < bar.y1; ++y) {
      const double share = 1 - (y + 0.5 - bar.y0) / bar.height();
      const Vec3f colour = map_colour(ColourMap::viridis, share, Transfer::none);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_EQ(pixel_at(pixels, x, y)[channel], byte_from_radiance(double(colour[channel]), Transfer::none)) << y;
    }
  }
}

TEST(DrawLabels, the_scale_bar_is_as_long_as_it_says) {
  for (const double shorter_side : {7.3, 50.0, 1e-7, 3.3e9}) {
    Scene scene = row({});
    scene.camera.shorter_side = shorter_side;
    const PngPixels pixels = labelled(scene, sized(1000, 700, {.scale_bar = true}));
    // The coverage of the bar's lowest rows: dark letters of 0.1 on white, without the seam, which is white here.
    double longest = 0;
    for (int y = 600; y < 700; ++y) {
      double dark = 0;
      for (int x = 0; x < 1000; ++x) dark += (255 - pixel_at(pixels, x, y)[0]) / (255.0 - 26);
      longest = std::max(longest, dark);
    }
    const double world = longest * length_of_pixel(scene.camera, 1000, 700);
    const double power = std::pow(10, std::floor(std::log10(world * 1.01)));
    const double digit = std::round(world / power);
    EXPECT_TRUE(digit == 1 || digit == 2 || digit == 5) << world;
    EXPECT_NEAR(longest, digit * power / length_of_pixel(scene.camera, 1000, 700), 0.5) << shorter_side;
    EXPECT_GT(longest, 120);
    EXPECT_LT(longest, 320);
  }
}

TEST(DrawLabels, titles_stay_inside) {
  const std::string words = "a long title of many words that is broken between them, ";
  for (const std::string& title : {std::string("T"), words + words, std::string(300, 'W'), std::string("two\nlines")}) {
    const PngPixels pixels = labelled(row({}), sized(400, 300, {.title = title}));
    const Tile area = drawn_area(pixels, {0, 0, 400, 300});
    EXPECT_GT(area.width(), 0) << title;
    EXPECT_GE(area.x0, 1) << title;
    EXPECT_LE(area.x1, 399) << title;
    EXPECT_LE(area.y1, 100) << title;
    EXPECT_NEAR(area.x0 + area.x1, 400, 6) << "in the middle: " << title;
  }
}

TEST(DrawLabels, letters_grow_with_the_picture_and_its_dots_per_inch) {
  const auto height_of = [](int width_px, int height_px, double dpi) {
    const PngPixels pixels = labelled(row({}), sized(width_px, height_px, {.title = "H"}), 3, 8, dpi);
    return drawn_area(pixels, {0, 0, width_px, height_px}).height();
  };
  EXPECT_NEAR(height_of(1280, 720, 0), 20, 1);
  EXPECT_NEAR(height_of(2560, 1440, 0), 40, 2);
  EXPECT_NEAR(height_of(1280, 720, 300), 33, 1) << "1.35 x 8 points x 300 / 72 x 0.73";
  EXPECT_NEAR(height_of(1280, 720, 1e6), 43, 1) << "no more than 6 % of the side";
}

TEST(DrawLabels, opacity_appears_where_letters_are) {
  RenderSettings settings = sized(800, 500, {.axes = true, .title = "Title"});
  settings.transparent = true;
  for (const int bits : {8, 16}) {
    const PngPixels pixels = labelled(row({}), settings, 4, bits);
    int opaque = 0, clear = 0;
    for (int y = 0; y < 500; ++y)
      for (int x = 0; x < 800; ++x) {
        const std::uint8_t opacity = pixel_at(pixels, x, y)[3 * bits / 8];
        opaque += opacity == 255 ? 1 : 0;
        clear += opacity == 0 ? 1 : 0;
      }
    EXPECT_GT(opaque, 150) << bits;
    EXPECT_GT(clear, 380000) << bits;
  }
}

TEST(DrawLabels, a_crop_has_the_pixels_of_the_whole) {
  const Scene scene = row({{"all", {by("charge")}}});
  RenderSettings settings =
      sized(320, 200, {.legend = true, .scale_bar = true, .axes = true, .title = "Whole and part"});
  for (const int channels : {3, 4}) {
    settings.transparent = channels == 4;
    settings.crop.reset();
    const PngPixels whole = labelled(scene, settings, channels);
    for (const Tile part : {Tile{0, 0, 1, 1}, Tile{17, 3, 160, 199}, Tile{270, 60, 320, 200}, Tile{100, 0, 200, 20}}) {
      settings.crop = part;
      const PngPixels cut = labelled(scene, settings, channels);
      for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
          for (int channel = 0; channel < channels; ++channel)
            ASSERT_EQ(pixel_at(cut, x - part.x0, y - part.y0)[channel], pixel_at(whole, x, y)[channel])
                << x << " " << y;
    }
  }
}

TEST(DrawLabels, tiny_and_flat_pictures_are_no_fault) {
  const Scene scene = row({{"all", {by("charge"), by("part")}}});
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 400}, {400, 3}, {20, 20}})
    labelled(scene,
             sized(width, height, {.legend = true, .scale_bar = true, .axes = true, .title = "Many words here"}));
}

TEST(DrawLabels, letters_are_dark_on_light_and_light_on_dark_backgrounds) {
  Scene scene = row({});
  const RenderSettings settings = sized(1280, 720, {.title = "H"});
  scene.background = {0, 0, 0};
  const PngPixels on_black = labelled(scene, settings);
  int lightest = 0, darkest = 255;
  const Tile area = drawn_area(on_black, {0, 0, 1280, 720});
  for (int y = area.y0; y < area.y1; ++y)
    for (int x = area.x0; x < area.x1; ++x) {
      lightest = std::max<int>(lightest, pixel_at(on_black, x, y)[0] < 255 ? pixel_at(on_black, x, y)[0] : 0);
      darkest = std::min<int>(darkest, pixel_at(on_black, x, y)[0]);
    }
  EXPECT_EQ(lightest, 245);
  EXPECT_LT(darkest, 60) << "the seam has the background's colour";
}

TEST(Legend, names_of_selections_are_a_key_of_their_own) {
  const Scene scene = row({{"all", {by("charge:magma"), SetLegendName{"Charge (e)"}}},
                           {"part a", {SetLegendName{"ligand"}, SetColour{std::string("#ff0000")}}},
                           {"x = 3", {SetColour{std::string("#0000ff")}, SetLegendName{"ion"}}},
                           {"x = 4", {SetColour{std::string("#ff0000")}, SetLegendName{"ligand"}}}});
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].title, "Charge (e)");
  EXPECT_EQ(keys[1].title, "");
  ASSERT_EQ(keys[1].entries.size(), 2u) << "one name with one colour stands once";
  EXPECT_EQ(keys[1].entries[0].name, "ligand");
  EXPECT_EQ(keys[1].entries[1].name, "ion");
  EXPECT_NEAR(keys[1].entries[1].colour.z, 1, 1e-9);
  EXPECT_EQ(legend_of(scene, {.legend_title = "e"})[0].title, "e") << "the last key with a title has the title";
  EXPECT_EQ(equal_colours(scene), "");
}

TEST(Legend, a_title_stands_above_names_alone) {
  const Scene scene = row({{"part a", {SetColour{std::string("red")}, SetLegendName{"ligand"}}}});
  const std::vector<LegendKey> keys = legend_of(scene, {.legend_title = "Parts"});
  ASSERT_FALSE(keys.empty());
  EXPECT_EQ(keys.back().entries.front().name, "ligand");
}

TEST(Legend, colours_that_look_alike_are_told) {
  const auto two = [](const std::string& a, const std::string& b) {
    return equal_colours(
        row({{"part a", {SetColour{a}, SetLegendName{"A"}}}, {"part b", {SetColour{b}, SetLegendName{"B"}}}}));
  };
  EXPECT_EQ(two("red", "red"), "the legend has one colour for A and B");
  EXPECT_EQ(two("#e69f00", "orange"), "the legend has nearly one colour for A and B");
  EXPECT_EQ(two("red", "orange"), "");
}

TEST(Legend, a_name_needs_one_colour) {
  Result<LoadedScene> loaded = load_scene(kRow, "a.csv");
  const auto counts =
      apply_looks(loaded->scene, {{"part a", {SetColour{std::string("red")}}}, {"all", {SetLegendName{"all"}}}});
  ASSERT_FALSE(counts.ok());
  EXPECT_THAT(counts.error().message, HasSubstr("several"));
}

TEST(DrawLabels, what_a_picture_cannot_have_is_refused) {
  Scene scene = row({{"all", {by("charge")}}});
  RenderSettings settings = sized(300, 200, {.legend = true, .scale_bar = true});
  EXPECT_TRUE(check_labels(scene, settings).ok());
  settings.view = View::normal;
  EXPECT_THAT(check_labels(scene, settings).error().message, HasSubstr("view"));
  settings.view = View::shaded;
  scene.camera.projection = Projection::perspective;
  EXPECT_THAT(check_labels(scene, settings).error().message, HasSubstr("perspective"));
  settings.labels.scale_bar = false;
  scene.coloured_by_of_sphere.assign(5, -1);
  EXPECT_THAT(check_labels(scene, settings).error().message, HasSubstr("meaning"));
}

}  // namespace
}  // namespace bihive
