// OpenEXR files, read again by OpenEXR itself; and what stands in them.
#include "bihive/image/exr.h"

#include <gtest/gtest.h>

#if BIHIVE_HAS_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#endif

#include <cmath>
#include <cstring>
#include <limits>

#include "bihive/base/write_file.h"
#include "bihive/render/layers.h"
#include "bihive/render/renderer.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/surface.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/looks.h"
#include "bihive/wide/ray_batch.h"

namespace bihive {
namespace {

Scene some_scene() {
  return scenario_scene(Scenario::mixed, {300, 1.5F, 3}).value();
}

RenderSettings small_settings(const Scene& scene) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = 83;
  settings.height_px = 47;
  settings.samples_per_pixel = 2;
  return settings;
}

const Channel& channel_of(const std::vector<Channel>& channels, const std::string& name) {
  for (const Channel& channel : channels)
    if (channel.name == name) return channel;
  ADD_FAILURE() << name;
  return channels.front();
}

TEST(Layers, their_names) {
  const Result<std::vector<Layer>> layers = layers_from_text("radiance,attribute:b_factor,id");
  ASSERT_TRUE(layers.ok());
  ASSERT_EQ(layers->size(), 3u);
  EXPECT_EQ((*layers)[1].kind, LayerKind::attribute);
  EXPECT_EQ((*layers)[1].attribute, "b_factor");
  EXPECT_EQ(name_of_layer((*layers)[1]), "attribute:b_factor");
  EXPECT_TRUE(has_radiance(*layers));
  EXPECT_NE(layers_from_text("depht").error().message.find("albedo, depth"), std::string::npos);
  EXPECT_FALSE(check_layers(some_scene(), {}).ok());
  EXPECT_FALSE(check_layers(some_scene(), {Layer{}, Layer{}}).ok());
}

void light_is_the_film_and_the_others_are_the_closest_hits(const Scene& scene) {
  const RenderSettings settings = small_settings(scene);
  const std::vector<Layer> layers = layers_from_text("id,radiance,depth,normal,albedo,attribute:r").value();
  ASSERT_TRUE(check_layers(scene, layers).ok());
  for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    const Film film = render(scene, tracer, settings).value().film;
    const std::vector<Channel> channels = draw_layers(scene, tracer, settings, layers, film);
    ASSERT_EQ(channels.size(), 12u);
    const PixelRays rays(scene.camera, settings.width_px, settings.height_px);
    std::size_t pixel = 0;
    int found = 0;
    for (int y = 0; y < settings.height_px; ++y)
      for (int x = 0; x < settings.width_px; ++x, ++pixel) {
        for (int c = 0; c < 3; ++c)
          EXPECT_EQ(channel_of(channels, std::string(1, "RGB"[c])).numbers[pixel], film.radiance[pixel][c]);
        const Ray ray = rays.at(x + 0.5, y + 0.5);
        const SceneHit hit = scene_hit(scene, tracer, ray);
        const std::uint32_t expected = hit.found() ? static_cast<std::uint32_t>(hit.id) : kIdOfNothing;
        ASSERT_EQ(channel_of(channels, "id").ids[pixel], expected);
        const float depth = channel_of(channels, "Z").numbers[pixel];
        const float radius = channel_of(channels, "attribute.r").numbers[pixel];
        EXPECT_EQ(std::isfinite(depth), hit.found());
        EXPECT_EQ(std::isnan(radius), hit.id < 0);
        if (!hit.found()) continue;
        ++found;
        const Surface surface = surface_at(scene, ray, hit);
        EXPECT_NEAR(double(depth), dot(to_double(surface.origin) - scene.camera.eye, rays.forward()), 1e-3);
        EXPECT_EQ(channel_of(channels, "normal.Y").numbers[pixel], static_cast<float>(surface.normal.y));
        EXPECT_EQ(channel_of(channels, "albedo.G").numbers[pixel], static_cast<float>(surface.material.colour.y));
      }
    EXPECT_GT(found, 500);
  }
}

TEST(Layers, of_whole_spheres) {
  light_is_the_film_and_the_others_are_the_closest_hits(some_scene());
}

TEST(Layers, of_cut_spheres) {
  Scene scene = some_scene();
  ASSERT_TRUE(apply_looks(scene, {{"all", {AddClip{PlaneClip{{0, 0, 1}, 0}}}}}));
  light_is_the_film_and_the_others_are_the_closest_hits(scene);
}

#if BIHIVE_HAS_OPENEXR

std::string temporary(const std::string& name) {
  return ::testing::TempDir() + "bihive_exr_" + name;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Exr, openexr_reads_the_same_numbers) {
  const Scene scene = some_scene();
  RenderSettings settings = small_settings(scene);
  settings.transparent = true;
  settings.crop = Tile{3, 5, 80, 44};
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  const Film film = render(scene, tracer, settings).value().film;
  const std::vector<Layer> layers = layers_from_text("radiance,id,depth").value();
  const ExrForm form{83, 47, *settings.crop, draw_layers(scene, tracer, settings, layers, film), {{"Scene", "bär"}},
                     72};
  const std::string path = temporary("read.exr");
  ASSERT_TRUE(write_exr(path, form));

  Imf::InputFile file(path.c_str());
  EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {82, 46}));
  EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({3, 5}, {79, 43}));
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("Scene").value(), "bär");
  EXPECT_EQ(Imf::xDensity(file.header()), 72);
  constexpr std::size_t kPixels = 77 * 39;
  std::vector<float> red(kPixels), opacity(kPixels), depth(kPixels);
  std::vector<std::uint32_t> ids(kPixels);
  Imf::FrameBuffer buffer;
  const auto add = [&](const char* name, Imf::PixelType type, void* to) {
    buffer.insert(name, Imf::Slice::Make(type, to, Imath::V2i(3, 5), 77, 39));
  };
  add("R", Imf::FLOAT, red.data());
  add("A", Imf::FLOAT, opacity.data());
  add("Z", Imf::FLOAT, depth.data());
  add("id", Imf::UINT, ids.data());
  file.setFrameBuffer(buffer);
  file.readPixels(5, 43);
  EXPECT_TRUE(same_bits(red, channel_of(form.channels, "R").numbers));
  EXPECT_TRUE(same_bits(depth, channel_of(form.channels, "Z").numbers));
  EXPECT_TRUE(same_bits(opacity, film.coverage));
  EXPECT_EQ(ids, channel_of(form.channels, "id").ids);
  for (std::size_t i = 0; i < kPixels; ++i) EXPECT_EQ(red[i], film.radiance[i].x * film.coverage[i]);
}

TEST(Exr, rows_in_any_bands_give_the_same_file) {
  std::vector<Channel> all{{"R", false, std::vector<float>(50 * 40), {}},
                           {"id", true, {}, std::vector<std::uint32_t>(50 * 40)}};
  for (std::size_t i = 0; i < all[0].numbers.size(); ++i) {
    all[0].numbers[i] = static_cast<float>(std::sqrt(double(i)));
    all[1].ids[i] = static_cast<std::uint32_t>(i / 7);
  }
  const ExrForm form{50, 40, {0, 0, 50, 40}, all, {}, 0};
  ASSERT_TRUE(write_exr(temporary("whole.exr"), form));
  for (const std::size_t band_rows : {1, 7, 16}) {
    Result<ExrWriter> writer = ExrWriter::begin(temporary("bands.exr"), form);
    ASSERT_TRUE(writer.ok());
    for (std::size_t y = 0; y < 40; y += band_rows) {
      const auto first = static_cast<std::ptrdiff_t>(y * 50);
      const auto end = static_cast<std::ptrdiff_t>(std::min<std::size_t>(y + band_rows, 40) * 50);
      const std::vector<Channel> rows{{"R", false, {all[0].numbers.begin() + first, all[0].numbers.begin() + end}, {}},
                                      {"id", true, {}, {all[1].ids.begin() + first, all[1].ids.begin() + end}}};
      ASSERT_TRUE(writer->add(rows));
    }
    ASSERT_TRUE(writer->finish());
    EXPECT_TRUE(read_file(temporary("bands.exr")).value() == read_file(temporary("whole.exr")).value());
  }
}

TEST(Exr, faults_are_errors) {
  const ExrForm form{2, 1, {0, 0, 2, 1}, {{"R", false, {1, 2}, {}}}, {}, 0};
  EXPECT_FALSE(write_exr("/nowhere/a.exr", form).ok());
  EXPECT_NE(write_exr("/dev/full", form).error().message.find("device"), std::string::npos);
}

#else

TEST(Exr, a_build_without_openexr_says_so) {
  EXPECT_FALSE(can_write_exr());
  EXPECT_NE(write_exr("a.exr", {}).error().message.find("no OpenEXR"), std::string::npos);
}

#endif

}  // namespace
}  // namespace bihive
