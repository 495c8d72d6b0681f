// Adaptive samples: which pixels get more, and what becomes of the picture.
// ctest: asan-long
#include "bihive/render/picture/edge_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

TEST(SampleRange, differs_by_the_root_of_the_light) {
  SampleRange range;
  EXPECT_FALSE(range.differs());
  range.add({0.25, 0.25, 0.25});
  EXPECT_FALSE(range.differs());
  range.add({0.25, 0.30, 0.25});  // sqrt: 0.548
  EXPECT_FALSE(range.differs());
  range.add({0.25, 0.25, 0.1914});  // sqrt: 0.4375 - 0.00001
  EXPECT_TRUE(range.differs());
}

TEST(SampleRange, light_beyond_white_does_not_differ) {
  SampleRange range;
  range.add({1, 1, 1});
  range.add({5, 1, std::nan("")});
  EXPECT_TRUE(range.differs()) << "NaN is black";
  SampleRange bright;
  bright.add({1, 2, 3});
  bright.add({5, 1, 1e30});
  EXPECT_FALSE(bright.differs());
}

TEST(EdgePixels, are_noted_or_differ_from_a_neighbour) {
  Film film(5, 4);
  film.radiance.assign(20, {0.25f, 0.25f, 0.25f});
  film.at(3, 1) = {0.25f, 0.45f, 0.25f};  // the root differs by 0.17
  EdgePixels edges;
  edges.resize(5, 4);
  edges.note(0, 3, true);
  edges.find(film, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(edges.at(x, y), (x >= 2 && y <= 2) || (x == 0 && y == 3)) << x << "," << y;
}

TEST(EdgePixels, coverage_counts) {
  Film film;
  film.resize(3, 1, true);
  film.radiance.assign(3, {0, 0, 0});
  film.coverage = {0, 0, 0.25f};
  EdgePixels edges;
  edges.resize(3, 1);
  edges.find(film, 1);
  EXPECT_FALSE(edges.at(0, 0));
  EXPECT_TRUE(edges.at(1, 0));
  EXPECT_TRUE(edges.at(2, 0));
}

class AdaptivePicture : public ::testing::Test {
 protected:
  AdaptivePicture() : scene_(four_spheres_scene()) {
    settings_ = settings_from(scene_.picture);
    settings_.width_px = 101;
    settings_.height_px = 83;
    settings_.recursion = 2;
    settings_.adaptive_samples = true;
  }
  Rendered draw(const RenderSettings& settings, Engine engine = Engine::automatic) const {
    return render(scene_, Tracer::build(scene_.spheres, engine).value(), settings).value();
  }
  RenderSettings with_samples(int samples) const {
    RenderSettings settings = settings_;
    settings.adaptive_samples = false;
    settings.samples_per_pixel = samples;
    return settings;
  }

  Scene scene_;
  RenderSettings settings_;
};

void expect_same_bits(const Film& a, const Film& b) {
  ASSERT_EQ(a.radiance.size(), b.radiance.size());
  EXPECT_EQ(std::memcmp(a.radiance.data(), b.radiance.data(), a.radiance.size() * sizeof(Vec3f)), 0);
  EXPECT_EQ(a.coverage, b.coverage);
}

TEST_F(AdaptivePicture, each_pixel_is_that_of_few_or_of_many_samples) {
  const Film adaptive = draw(settings_).film;
  const Film few = draw(with_samples(kFewSamples)).film, many = draw(with_samples(kManySamples)).film;
  int refined = 0, different = 0;
  for (std::size_t i = 0; i < adaptive.radiance.size(); ++i) {
    const bool is_few = adaptive.radiance[i] == few.radiance[i], is_many = adaptive.radiance[i] == many.radiance[i];
    ASSERT_TRUE(is_few || is_many) << i;
    refined += !is_few;
    different += few.radiance[i] != many.radiance[i];
  }
  EXPECT_GT(refined, 300);
  EXPECT_LT(refined, different);
}

TEST_F(AdaptivePicture, has_the_same_bits_for_engines_threads_and_parts) {
  for (const bool look : {false, true}) {
    settings_.transparent = look;
    if (look) settings_.outline = Outline{1.5, 0.5, {0.1, 0, 0}};
    if (look) settings_.fog = Fog{0.2, 0.9, 0.5};
    if (look) settings_.tone = {0.5, ToneCurve::filmic};
    settings_.crop.reset();
    const Film whole = draw(settings_).film;
    for (const Engine engine : {Engine::reference, Engine::wide})
      for (const int threads : {1, 2, 7}) {
        settings_.threads = threads;
        expect_same_bits(draw(settings_, engine).film, whole);
      }
    for (const Tile& part : {Tile{0, 0, 101, 83}, {1, 2, 101, 83}, {33, 7, 34, 8}, {5, 9, 65, 48}, {60, 0, 101, 20}}) {
      settings_.crop = part;
      expect_same_bits(draw(settings_).film, part_of(whole, part));
    }
  }
}

TEST_F(AdaptivePicture, slices_do_not_show) {
  const Tracer tracer = Tracer::build(scene_.spheres, Engine::automatic).value();
  const Film whole = draw(settings_).film;
  Result<SlicedPicture> sliced = SlicedPicture::begin(scene_, tracer, settings_);
  ASSERT_TRUE(sliced);
  while (!sliced->finished()) sliced->advance(0);
  expect_same_bits(sliced->take().film, whole);
}

TEST_F(AdaptivePicture, a_flat_picture_costs_nothing_more) {
  scene_.plane.reset();
  scene_.camera.look_at = scene_.camera.eye + Vec3d{0, 100, 1};  // the empty sky
  EXPECT_EQ(draw(settings_).rays.primary, 101 * 83 * kFewSamples);
}

TEST_F(AdaptivePicture, is_nearer_to_the_limit_than_few_samples) {
  const Film limit = draw(with_samples(256)).film;
  const auto error = [&](const Film& film) {
    double sum = 0;
    for (std::size_t i = 0; i < film.radiance.size(); ++i)
      sum += length(to_double(film.radiance[i]) - to_double(limit.radiance[i]));
    return sum;
  };
  const Rendered adaptive = draw(settings_);
  const double of_few = error(draw(with_samples(kFewSamples)).film);
  const double of_many = error(draw(with_samples(kManySamples)).film);
  EXPECT_LT(error(adaptive.film), 0.6 * of_few);
  EXPECT_LT(error(adaptive.film), 2 * of_many);
  EXPECT_LT(adaptive.rays.primary, 101 * 83 * 10);
}

TEST_F(AdaptivePicture, other_views_get_few_samples) {
  for (const View view : {View::normal, View::distance, View::id, View::recursion}) {
    settings_.view = view;
    expect_same_bits(draw(settings_).film, draw(with_samples(kFewSamples)).film);
  }
}

}  // namespace
}  // namespace bihive
