// Outlines of some spheres alone, and creases between groups that touch.
// ctest: asan-long
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/scene/creases.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/looks.h"

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kPictureWidth = 120, kHeight = 60;

// Two balls that overlap, the right one a little deeper, seen from +z: red left, green right, both of their pure
// colour, on white. `part` is a, then b.
Scene two_balls() {
  Result<LoadedScene> loaded = load_scene("x,y,z,r,part\n-0.7,0,0,1,a\n0.7,0,-0.2,1,b\n", "a.csv");
  EXPECT_TRUE(loaded.ok());
  Scene scene = std::move(loaded->scene);
  Material pure;
  pure.glow = 1;
  scene.materials = {pure};
  scene.spheres.attributes().colour = {{1, 0, 0}, {0, 1, 0}};
  scene.camera.eye = {0, 0, 10};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.projection = Projection::orthographic;
  scene.camera.shorter_side = 2.4;
  scene.picture.width_px = kPictureWidth;
  scene.picture.height_px = kHeight;
  scene.picture.samples_per_pixel = 1;
  return scene;
}

Film drawn(const Scene& scene, const std::optional<Tile>& crop = std::nullopt, int threads = 1) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  RenderSettings settings = settings_from(scene.picture);
  settings.crop = crop;
  settings.threads = threads;
  return render(scene, tracer, settings)->film;
}

struct Counts {
  int red = 0, green = 0, black = 0, black_left = 0, black_right = 0;
};

// The balls meet near the middle column.
Counts counts_of(const Film& film) {
  Counts counts;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const Vec3f light = film.at(x, y);
      if (light.x == 1 && light.y == 0) ++counts.red;
      if (light.x == 0 && light.y == 1) ++counts.green;
      if (light.x != 0 || light.y != 0 || light.z != 0) continue;
      ++counts.black;
      if (x < kPictureWidth / 2 - 8) ++counts.black_left;
      if (x >= kPictureWidth / 2 + 8) ++counts.black_right;
    }
  return counts;
}

void put_looks(Scene& scene, const std::vector<Look>& looks) {
  const auto counts = apply_looks(scene, looks);
  EXPECT_TRUE(counts.ok()) << counts.error().to_string();
}

TEST(Outlines, one_ball_has_an_outline_of_its_own) {
  Scene scene = two_balls();
  EXPECT_EQ(counts_of(drawn(scene)).black, 0);
  put_looks(scene, {{"part a", {SetOutline{2}}}});
  const Counts left = counts_of(drawn(scene));
  EXPECT_GT(left.black_left, 100);
  EXPECT_EQ(left.black_right, 0);

  // The picture's outline is for the others, and 0 means none.
  scene.picture.outline = Outline{1, 0.1, {0, 0, 0}};
  const Counts both = counts_of(drawn(scene));
  EXPECT_GT(both.black_right, 50);
  EXPECT_GT(both.black_left, both.black_right);
  put_looks(scene, {{"part a", {SetOutline{0}}}});
  const Counts right = counts_of(drawn(scene));
  EXPECT_EQ(right.black_left, 0);
  EXPECT_EQ(right.black_right, both.black_right);
}

TEST(Outlines, a_crease_runs_where_groups_meet_alone) {
  Scene scene = two_balls();
  put_looks(scene, {{"all", {SetCrease{"part"}}}});
  EXPECT_THAT(scene.spheres.attributes().crease, ElementsAre(1, 2));
  const Film creased = drawn(scene);
  const Counts counts = counts_of(creased);
  EXPECT_GT(counts.black, 20);
  EXPECT_LT(counts.black, 60);
  // It is on the ball in front, beside the other one, and not along the background.
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kPictureWidth; ++x) {
      const bool black = creased.at(x, y) == Vec3f{0, 0, 0};
      EXPECT_TRUE(!black || std::abs(x - kPictureWidth / 2) < 8) << x << " " << y;
    }

  // The same group has none. Balls that no crease was asked for are a group of their own.
  put_looks(scene, {{"all", {SetCrease{"radius"}}}});
  EXPECT_EQ(counts_of(drawn(scene)).black, 0);
  scene = two_balls();
  put_looks(scene, {{"part b", {SetCrease{"part"}}}});
  EXPECT_EQ(counts_of(drawn(scene)).black, counts.black);
}

TEST(Outlines, parts_and_threads_have_the_bits_of_the_whole) {
  Scene scene = two_balls();
  scene.picture.outline = Outline{1, 0.1, {0, 0, 0}};
  put_looks(scene, {{"part a", {SetOutline{5}}}, {"all", {SetCrease{"part"}}}});
  const Film whole = drawn(scene);
  EXPECT_TRUE(drawn(scene, std::nullopt, 7).radiance == whole.radiance);
  const Tile tile{41, 13, 83, 55};
  const Film part = drawn(scene, tile);
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) EXPECT_EQ(part.at(x - tile.x0, y - tile.y0), whole.at(x, y));
}

// The light that lines take away, as a share of the picture.
double ink_of(Scene scene, double scale) {
  scene.picture.width_px = static_cast<int>(kPictureWidth * scale);
  scene.picture.height_px = static_cast<int>(kHeight * scale);
  scene.picture.samples_per_pixel = 16;
  const auto light_of = [&scene] {
    const Film film = drawn(scene);
    double light = 0;
    for (const Vec3f& pixel : film.radiance) light += double(pixel.x) + double(pixel.y) + double(pixel.z);
    return light / static_cast<double>(film.radiance.size());
  };
  const double with = light_of();
  scene.picture.outline.reset();
  return light_of() - with;
}

TEST(Outlines, lines_in_units_of_the_picture_take_the_same_share_of_it_in_every_size) {
  Scene scene = two_balls();
  scene.picture.line_unit = LineUnit::picture;
  scene.picture.outline = Outline{16, 0.1, {0, 0, 0}};  // 1.3 pixels at 60 rows
  const double ink = ink_of(scene, 4);
  EXPECT_GT(ink, 0.02);
  EXPECT_NEAR(ink_of(scene, 10), ink, 0.05 * ink);
  EXPECT_NEAR(ink_of(scene, 0.5), ink, 0.3 * ink);  // thinner than a pixel
  scene.picture.line_unit = LineUnit::px;
  EXPECT_LT(ink_of(scene, 10), 0.6 * ink_of(scene, 4));
}

TEST(Outlines, a_wider_line_takes_more_light_up_to_a_share_of_its_sphere) {
  Scene scene = two_balls();
  double before = 0;
  for (const double width : {1.0, 2.0, 3.0, 4.0}) {
    scene.picture.outline = Outline{width, 0.1, {0, 0, 0}};
    const double ink = ink_of(scene, 1);
    EXPECT_GT(ink, before) << width;
    before = ink;
  }
  scene.picture.outline = Outline{5, 0.1, {0, 0, 0}};  // radii of 25 pixels: lines of 25 / 6
  const double most = ink_of(scene, 1);
  scene.picture.outline = Outline{16, 0.1, {0, 0, 0}};
  EXPECT_EQ(ink_of(scene, 1), most);
}

TEST(Outlines, points_count_pixels_of_the_print) {
  RenderSettings settings;
  EXPECT_EQ(line_unit_px(settings), 1);
  settings.line_unit = LineUnit::pt;
  settings.dots_per_inch = 300;
  EXPECT_EQ(line_unit_px(settings), 300.0 / 72);
  settings.line_unit = LineUnit::picture;
  settings.width_px = 1440;
  settings.height_px = 3000;
  EXPECT_EQ(line_unit_px(settings), 2);
}

TEST(Outlines, numbers_make_groups_too) {
  Result<LoadedScene> loaded = load_scene("x,y,z,r,mol\n0,0,0,1,7\n1,0,0,1,\n2,0,0,1,3\n3,0,0,1,7\n", "a.csv");
  ASSERT_TRUE(loaded.ok());
  EXPECT_THAT(*crease_groups(loaded->scene.spheres, "mol"), ElementsAre(1, 0, 2, 1));
  EXPECT_THAT(crease_groups(loaded->scene.spheres, "molt").error().hint, HasSubstr("mol"));
}

TEST(Outlines, hidden_spheres_take_theirs_along) {
  Scene scene = two_balls();
  put_looks(scene, {{"part b", {SetOutline{3}, SetCrease{"part"}}}, {"part a", {SetShown{false}}}});
  EXPECT_THAT(scene.spheres.attributes().outline_px, ElementsAre(3));
  EXPECT_THAT(scene.spheres.attributes().crease, ElementsAre(2));
}

TEST(Outlines, faults_are_said) {
  Scene scene = two_balls();
  EXPECT_THAT(apply_looks(scene, {{"all", {SetOutline{0.5}}}}).error().message, HasSubstr("1 to 16"));
  EXPECT_THAT(apply_looks(scene, {{"all", {SetCrease{"chain"}}}}).error().message, HasSubstr("chain"));
}

}  // namespace
}  // namespace bihive
