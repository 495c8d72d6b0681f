// Exposure and tone curves: their values, and what they do to a picture.
// ctest: asan-long
#include "bihive/image/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

TEST(Exposure, is_exact_for_whole_stops) {
  for (int stops = -32; stops <= 32; ++stops)
    EXPECT_EQ(exposure_factor({double(stops), ToneCurve::none}), std::ldexp(1.0, stops));
  EXPECT_NEAR(exposure_factor({0.5, ToneCurve::none}), std::sqrt(2.0), 1e-15);
  EXPECT_FALSE(Tone{}.any());
  EXPECT_TRUE((Tone{0.1, ToneCurve::none}.any()));
  EXPECT_TRUE((Tone{0, ToneCurve::soft}.any()));
}

TEST(ToneCurves, rise_from_0_to_1) {
  for (const auto curve : {soft_curve, filmic_curve}) {
    EXPECT_EQ(curve(0), 0);
    EXPECT_EQ(curve(-1), 0);
    EXPECT_EQ(curve(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(curve(1e300), 1);
    EXPECT_EQ(curve(std::numeric_limits<double>::infinity()), 1);
    double before = 0;
    for (double x = 1e-6; x < 20; x *= 1.001) {
      const double now = curve(x);
      ASSERT_TRUE(now > before || now == 1) << x;
      ASSERT_LE(now, 1) << x;
      before = now;
    }
    EXPECT_EQ(before, 1);
  }
}

TEST(ToneCurves, have_the_values_of_their_formulas) {
  EXPECT_EQ(soft_curve(0.5), 0.5);
  EXPECT_EQ(soft_curve(0.25), 0.25);
  EXPECT_NEAR(soft_curve(0.5 + 1e-7) - 0.5, 1e-7, 1e-13) << "the slope is the same on both sides";
  EXPECT_NEAR(soft_curve(kSoftWhite), 1, 1e-15);
  // s = 1: (1 + 1 / 49) / 2 of the upper half.
  EXPECT_NEAR(soft_curve(1), 0.5 + 0.25 * (1 + 1.0 / 49), 1e-15);
  EXPECT_NEAR(filmic_curve(1), 2.54 / 3.16, 1e-15);
  EXPECT_NEAR(filmic_curve(0.18), 0.18 * (2.51 * 0.18 + 0.03) / (0.18 * (2.43 * 0.18 + 0.59) + 0.14), 1e-15);
  EXPECT_LT(filmic_curve(7.24), 1);
}

TEST(Toned, soft_keeps_the_ratios_of_the_channels) {
  const Tone tone{1, ToneCurve::soft};
  const Vec3d light = toned({0.8, 0.4, 0.1}, tone, exposure_factor(tone));
  EXPECT_NEAR(light.x, soft_curve(1.6), 1e-15);
  EXPECT_NEAR(light.y / light.x, 0.5, 1e-15);
  EXPECT_NEAR(light.z / light.x, 0.125, 1e-15);
  EXPECT_EQ(toned({0.25, 0.1, 0}, tone, 2), (Vec3d{0.5, 0.2, 0})) << "dark light is exposed alone";
}

TEST(Toned, without_a_curve_it_is_a_factor) {
  EXPECT_EQ(toned({0.75, 3, 0}, {2, ToneCurve::none}, 4), (Vec3d{3, 12, 0}));
}

class Picture : public ::testing::Test {
 protected:
  Picture() : scene_(four_spheres_scene()) {
    scene_.plane.reset();
    scene_.background = {0.3, 0.6, 0.9};
    settings_ = settings_from(scene_.picture);
    settings_.width_px = 60;
    settings_.height_px = 45;
    settings_.samples_per_pixel = 1;
    settings_.recursion = 1;
  }
  Film draw() const {
    return render(scene_, Tracer::build(scene_.spheres, Engine::automatic).value(), settings_).value().film;
  }

  Scene scene_;
  RenderSettings settings_;
};

TEST_F(Picture, one_stop_doubles_the_light_and_leaves_the_background) {
  const Film before = draw();
  settings_.tone.exposure_stops = 1;
  const Film after = draw();
  const Vec3f background = to_float(scene_.background);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < before.radiance.size(); ++i) {
    if (before.radiance[i] == background) {
      ASSERT_EQ(after.radiance[i], background);
      continue;
    }
    ++hits;
    for (int channel = 0; channel < 3; ++channel)
      ASSERT_EQ(after.radiance[i][channel], 2 * before.radiance[i][channel]) << i;
  }
  EXPECT_GT(hits, 100u);
  EXPECT_LT(hits, before.radiance.size());
}

TEST_F(Picture, a_white_furnace_stays_white_at_no_stops) {
  // A surface that shines in the light of the background cannot be told from it.
  scene_.background = {1, 1, 1};
  scene_.lights.clear();
  for (Material& material : scene_.materials) {
    material = Material{};
    material.colour = {1, 1, 1};
    material.ambient = 1;
    material.diffuse = material.specular = 0;
  }
  for (const Vec3f& pixel : draw().radiance) ASSERT_EQ(pixel, (Vec3f{1, 1, 1}));
  settings_.tone = {2, ToneCurve::soft};  // 4 becomes white
  for (const Vec3f& pixel : draw().radiance) ASSERT_NEAR(pixel.x, 1, 1e-7);
}

TEST_F(Picture, laid_over_the_background_a_transparent_one_is_the_opaque_one) {
  settings_.samples_per_pixel = 4;
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::soft, ToneCurve::filmic}) {
    settings_.tone = {0.7, curve};
    settings_.transparent = false;
    const Film opaque = draw();
    settings_.transparent = true;
    const Film film = draw();
    for (std::size_t i = 0; i < film.radiance.size(); ++i) {
      const double share = double(film.coverage[i]);
      const Vec3d laid = share * to_double(film.radiance[i]) + (1 - share) * scene_.background;
      ASSERT_NEAR(length(laid - to_double(opaque.radiance[i])), 0, 1e-6) << i;
    }
  }
}

TEST_F(Picture, other_views_have_no_tone) {
  for (const View view : {View::normal, View::recursion, View::id}) {
    settings_.view = view;
    settings_.tone = {};
    const Film before = draw();
    settings_.tone = {2, ToneCurve::filmic};
    EXPECT_EQ(draw().radiance, before.radiance);
  }
}

}  // namespace
}  // namespace bihive
