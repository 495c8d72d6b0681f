// A picture that is drawn and written in bands of rows is the picture drawn whole: the same bits, the same file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "bihive/image/png.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/memory.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/style.h"

namespace bihive {
namespace {

struct Drawing {
  Scene scene;
  RenderSettings settings;
};

// The demo in the default style: outlines, fog, ambient occlusion, soft shadows; and all labels.
Drawing demo(int width_px, int height_px) {
  const Style style = style_named("default").value();
  Drawing drawing{built_in_scene("demo", {}, {}, &style).value().scene, {}};
  drawing.scene.camera = with_projection(drawing.scene.camera, Projection::orthographic);
  drawing.settings = settings_from(drawing.scene.picture);
  drawing.settings.width_px = width_px;
  drawing.settings.height_px = height_px;
  drawing.settings.samples_per_pixel = 2;
  return drawing;
}

PngPixels finished(const Drawing& drawing, const Film& film, const Tile& pixels, int bits) {
  RenderSettings of_part = drawing.settings;
  of_part.crop = pixels;
  PngPixels rows = png_pixels_from_film(film, drawing.scene.picture.transfer, bits);
  draw_labels(rows, drawing.scene, of_part);
  return rows;
}

std::string file_of_bands(const Drawing& drawing, const Tracer& tracer, int band_rows, int bits) {
  const Tile drawn = drawn_pixels(drawing.settings);
  Result<PngEncoder> encoder =
      PngEncoder::begin(drawn.width(), drawn.height(), drawing.settings.transparent ? 4 : 3, bits,
                        {{"Software", "test"}}, 300, drawing.scene.picture.transfer == Transfer::srgb);
  EXPECT_TRUE(encoder.ok());
  std::string file;
  const auto take = [&](const Film& film, const Tile& pixels) {
    EXPECT_LE(pixels.height(), band_rows);
    const Status status = encoder->add(finished(drawing, film, pixels, bits));
    file += encoder->take_bytes();
    return status;
  };
  EXPECT_TRUE(render_in_bands(drawing.scene, tracer, drawing.settings, band_rows, take));
  EXPECT_TRUE(encoder->finish());
  return file + encoder->take_bytes();
}

void expect_same_file(const Drawing& drawing, const Tracer& tracer, int bits) {
  const Result<Rendered> whole = render(drawing.scene, tracer, drawing.settings);
  ASSERT_TRUE(whole.ok());
  const Tile drawn = drawn_pixels(drawing.settings);
  const std::string expected =
      encode_png(finished(drawing, whole->film, drawn, bits), {{"Software", "test"}}, 300).value();
  for (const int band_rows : {1, 7, 64, 1000})
    EXPECT_TRUE(file_of_bands(drawing, tracer, band_rows, bits) == expected) << band_rows << " rows";
}

TEST(Bands, the_file_of_the_default_style_with_labels) {
  Drawing drawing = demo(90, 70);
  ASSERT_TRUE(drawing.settings.outline.has_value());
  drawing.settings.labels.legend = drawing.settings.labels.scale_bar = drawing.settings.labels.axes = true;
  drawing.settings.labels.title = "B\u00E4nder";
  ASSERT_TRUE(check_labels(drawing.scene, drawing.settings).ok());
  const Tracer tracer = Tracer::build(drawing.scene.spheres, Engine::wide).value();
  expect_same_file(drawing, tracer, 8);
  drawing.settings.transparent = true;
  expect_same_file(drawing, tracer, 16);
  drawing.settings.crop = Tile{11, 13, 80, 60};
  expect_same_file(drawing, tracer, 8);
  drawing.settings.crop.reset();
  drawing.settings.adaptive_samples = true;
  expect_same_file(drawing, tracer, 8);
}

TEST(Bands, every_view_and_opacity) {
  Drawing drawing = demo(60, 50);
  drawing.scene.spheres.attributes().opacity.assign(static_cast<std::size_t>(drawing.scene.spheres.size()), 0.5F);
  const Tracer tracer = Tracer::build(drawing.scene.spheres, Engine::reference).value();
  for (const View view :
       {View::shaded, View::recursion, View::traversal, View::normal, View::distance, View::id, View::tree}) {
    drawing.settings.view = view;
    const Result<Rendered> whole = render(drawing.scene, tracer, drawing.settings);
    ASSERT_TRUE(whole.ok());
    Film film(60, 50);
    const auto take = [&](const Film& rows, const Tile& pixels) -> Status {
      std::copy(rows.radiance.begin(), rows.radiance.end(), film.radiance.begin() + pixels.y0 * 60);
      return Done{};
    };
    const Result<RenderedBands> bands = render_in_bands(drawing.scene, tracer, drawing.settings, 9, take);
    ASSERT_TRUE(bands.ok());
    EXPECT_EQ(std::memcmp(film.radiance.data(), whole->film.radiance.data(), sizeof(Vec3f) * 60 * 50), 0);
    EXPECT_EQ(bands->rays.primary, whole->rays.primary);
    EXPECT_EQ(bands->rays.shadow, whole->rays.shadow);
  }
}

TEST(Bands, progress_is_that_of_the_picture_and_a_fault_or_a_cancel_ends_it) {
  const Scene scene = four_spheres_scene();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = settings.height_px = 100;
  settings.threads = 1;
  double last = 0;
  int bands = 0;
  const auto count = [&bands](const Film&, const Tile&) -> Status {
    ++bands;
    return Done{};
  };
  const auto grows = [&last](double done) {
    EXPECT_GT(done, last);
    last = done;
  };
  ASSERT_TRUE(render_in_bands(scene, tracer, settings, 30, count, grows).ok());
  EXPECT_EQ(bands, 4);
  EXPECT_DOUBLE_EQ(last, 1);

  const auto fail = [](const Film&, const Tile& pixels) -> Status {
    if (pixels.y0 == 30) return Error{"full", "", 0, 0, ""};
    return Done{};
  };
  EXPECT_EQ(render_in_bands(scene, tracer, settings, 30, fail).error().message, "full");

  CancelToken token;
  bands = 0;
  const auto cancel = [&](const Film&, const Tile&) -> Status {
    ++bands;
    token.cancel();
    return Done{};
  };
  EXPECT_EQ(render_in_bands(scene, tracer, settings, 30, cancel, {}, &token).error().message, "cancelled");
  EXPECT_EQ(bands, 1);
}

TEST(Bands, their_rows_fit_the_memory) {
  EXPECT_EQ(rows_of_band(720, 1280 * 18), 720);
  const int rows = rows_of_band(11200, 40000 * 18);
  EXPECT_LE(rows * 40000.0 * 18, kBandBytes);
  EXPECT_EQ(rows % 64, 0);
  EXPECT_GT(rows, 0);
  EXPECT_EQ(rows_of_band(100, 1e12), 1);
}

}  // namespace
}  // namespace bihive
