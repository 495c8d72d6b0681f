// What makes a look, by the graphics processor: against the CPU's pictures, and each effect is seen.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/creases.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/palette.h"
#include "support/gl_picture.h"

namespace bihive {
namespace {

using test::GlPictures;

constexpr int kWidth = 96, kHeight = 64;

struct Wanted {
  Scene scene;
  RenderSettings settings;
};

Wanted molecule() {
  Wanted wanted;
  Scene& scene = wanted.scene;
  scene.spheres = std::move(read_spheres_from_memory(bundled_molecule(), "1hpv.pdb", {})->spheres);
  colour_spheres(scene.spheres);
  scene.background = {0.9, 0.8, 1};
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, kWidth, kHeight);
  scene.lights = {light_behind(scene.camera)};
  RenderSettings& settings = wanted.settings;
  settings.width_px = kWidth;
  settings.height_px = kHeight;
  settings.samples_per_pixel = 2;
  return wanted;
}

// Few large spheres, two of them mirrors, on a plane.
Wanted balls() {
  Wanted wanted;
  wanted.scene = four_spheres_scene();
  wanted.settings.width_px = kWidth;
  wanted.settings.height_px = kHeight;
  wanted.settings.samples_per_pixel = 2;
  return wanted;
}

Image cpu_image(const Wanted& wanted) {
  const Tracer tracer = Tracer::build(wanted.scene, Engine::reference).value();
  return image_from_film(render(wanted.scene, tracer, wanted.settings)->film, wanted.settings.view, Transfer::srgb);
}

Image gpu_image(const Wanted& wanted, bool with_tree = true) {
  const Tracer tracer = Tracer::build(wanted.scene, Engine::reference).value();
  const GlRenderer::Picture picture =
      GlPictures::get().draw(wanted.scene, with_tree ? tracer.tree() : nullptr, wanted.settings);
  return image_from_film(picture.film, wanted.settings.view, Transfer::srgb);
}

double share_apart(const Image& a, const Image& b, int by) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  std::int64_t apart = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size() && a.rgb.size() == b.rgb.size(); i += 3) {
    bool differs = false;
    for (std::size_t c = i; c < i + 3; ++c) differs = differs || std::abs(int(a.rgb[c]) - int(b.rgb[c])) > by;
    apart += differs ? 1 : 0;
  }
  return static_cast<double>(apart) / (double(a.width) * a.height);
}

// The promise is 1 % of the pixels by more than 8. Both engines take the same directions and points, so the pictures
// are closer: 0.5 % by more than 2.
void expect_same(const Wanted& wanted, bool with_tree = true) {
  EXPECT_LE(share_apart(gpu_image(wanted, with_tree), cpu_image(wanted), 2), 0.005);
}

struct Effect {
  std::string name;
  std::function<void(Wanted&)> put;
  std::function<Wanted()> subject = molecule;
};

void put_soft_lights(Wanted& wanted) {
  LightRig rig;
  for (const auto& [name, preset] : light_presets())
    if (name == "studio") rig = preset;
  wanted.scene.lights = lights_around(rig, wanted.scene.camera);
  ASSERT_TRUE(has_soft_light(wanted.scene));
}

void put_opacity(Wanted& wanted, float opacity) {
  wanted.settings.opacity_rule = OpacityRule::once;
  std::vector<float>& shares = wanted.scene.spheres.attributes().opacity;
  shares.resize(static_cast<std::size_t>(wanted.scene.spheres.size()));
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = i % 3 == 0 ? 1 : opacity;
}

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kEffects{
      {"ambient_occlusion", [](Wanted& w) { w.settings.ambient_occlusion.emplace(); }},
      {"ambient_occlusion_of_some_distance",
       [](Wanted& w) {
         w.settings.ambient_occlusion = AmbientOcclusion{4, 200};
       }},
      {"ambient_occlusion_on_a_plane", [](Wanted& w) { w.settings.ambient_occlusion.emplace(); }, balls},
      {"soft_shadows", put_soft_lights},
      {"soft_shadows_of_many_points",
       [](Wanted& w) {
         put_soft_lights(w);
         w.settings.light_points = 100;
       }},
      {"soft_and_hard_lights_in_many_slices",
       [](Wanted& w) {
         put_soft_lights(w);
         w.scene.lights.push_back({w.scene.camera.eye + Vec3d{40, 60, 0}, {0.4, 0.3, 0.2}});
         w.settings.light_points = 150;
         w.settings.samples_per_pixel = 1;
       }},
      {"soft_shadows_on_a_plane",
       [](Wanted& w) {
         w.settings.shadows = true;
         w.scene.lights[0].radius = 3;
       },
       balls},
      {"fog",
       [](Wanted& w) {
         w.settings.fog = Fog{0.1, 0.8, 0.7};
       }},
      {"fog_on_a_plane",
       [](Wanted& w) {
         w.settings.fog = Fog{0, 1, 1};
       },
       balls},
      {"outlines",
       [](Wanted& w) {
         w.settings.outline = Outline{2, 1, {0, 0.1, 0.3}};
       },
       [] {
         Wanted w = molecule();
         w.scene.camera = enlarged(w.scene.camera, 5);
         return w;
       }},
      {"outlines_beside_a_plane",
       [](Wanted& w) {
         w.settings.outline = Outline{3, 0.5, {1, 0, 0}};
       },
       balls},
      {"creases_and_own_outlines",
       [](Wanted& w) {
         w.scene.spheres.attributes().crease = crease_groups(w.scene.spheres, "chain").value();
         std::vector<float>& own = w.scene.spheres.attributes().outline_px;
         own.assign(static_cast<std::size_t>(w.scene.spheres.size()), -1);
         for (std::size_t i = 0; i < 200; ++i) own[i] = 2;
       },
       [] {
         Wanted w = molecule();
         w.scene.camera = enlarged(w.scene.camera, 4);
         return w;
       }},
      {"opacity_once", [](Wanted& w) { put_opacity(w, 0.3F); }},
      {"opacity_once_with_shadows_and_occlusion",
       [](Wanted& w) {
         put_opacity(w, 0.4F);
         w.settings.ambient_occlusion = AmbientOcclusion{8, 16};
       }},
      {"opacity_once_of_mirrors_and_glass", [](Wanted& w) { put_opacity(w, 0.5F); }, balls},
      {"opacity_of_first_surfaces",
       [](Wanted& w) {
         put_opacity(w, 0.3F);
         w.settings.opacity_rule = OpacityRule::first;
         w.settings.ambient_occlusion = AmbientOcclusion{8, 16};
       }},
      {"opacity_of_first_surfaces_of_mirrors_and_glass",
       [](Wanted& w) {
         put_opacity(w, 0.5F);
         w.settings.opacity_rule = OpacityRule::first;
       },
       balls},
      {"refracting_glass_lets_light_pass",
       [](Wanted& w) {
         w.settings.shadows = true;
         w.settings.opacity_rule = OpacityRule::once;
       },
       balls},
      {"depth_of_field",
       [](Wanted& w) {
         w.scene.camera.aperture = 4;
         w.settings.samples_per_pixel = 9;
       }},
      {"exposure",
       [](Wanted& w) {
         w.settings.tone = Tone{1.5, ToneCurve::none};
       }},
      {"soft_tone",
       [](Wanted& w) {
         w.settings.tone = Tone{1, ToneCurve::soft};
       }},
      {"filmic_tone",
       [](Wanted& w) {
         w.settings.tone = Tone{-1, ToneCurve::filmic};
       },
       balls},
      {"all_together", [](Wanted& w) {
         put_soft_lights(w);
         put_opacity(w, 0.6F);
         w.settings.ambient_occlusion = AmbientOcclusion{10, 8};
         w.settings.light_points = 3;
         w.settings.outline.emplace();
         w.settings.fog.emplace();
         w.settings.tone = Tone{0.5, ToneCurve::soft};
       }}};
  return kEffects;
}

class Effects : public ::testing::TestWithParam<Effect> {};

TEST_P(Effects, are_the_cpus) {
  Wanted wanted = GetParam().subject();
  const Image without = cpu_image(wanted);
  GetParam().put(wanted);
  const Image cpu = cpu_image(wanted);
  EXPECT_GT(share_apart(cpu, without, 8), 0.01) << "the effect is seen";
  const double apart = share_apart(gpu_image(wanted), cpu, 2);
  EXPECT_LE(apart, 0.005);
  ::testing::Test::RecordProperty("apart", std::to_string(apart));
  std::printf("%s: %.4f %%\n", GetParam().name.c_str(), 100 * apart);
}

TEST_P(Effects, are_orthographic_too) {
  Wanted wanted = GetParam().subject();
  GetParam().put(wanted);
  if (wanted.scene.camera.aperture > 0) GTEST_SKIP() << "parallel rays have no lens";
  wanted.settings.samples_per_pixel = 1;
  wanted.scene.camera = with_projection(wanted.scene.camera, Projection::orthographic);
  expect_same(wanted);
}

INSTANTIATE_TEST_SUITE_P(all, Effects, ::testing::ValuesIn(effects()),
                         [](const auto& effect) { return effect.param.name; });

// Many layers, in rows towards the eye, some at the same place: each counts once, in the order of the CPU.
TEST(Layers, of_any_number_count_once) {
  std::vector<double> x, y, z, r;
  std::vector<float> opacity;
  for (int layer = 0; layer < 60; ++layer)
    for (int copy = 0; copy < (layer % 10 == 0 ? 2 : 1); ++copy) {
      x.push_back(0.01 * layer);
      y.push_back(0);
      z.push_back(-3.0 * layer);
      r.push_back(1);
      opacity.push_back(layer == 59 ? 1 : copy == 1 && layer == 30 ? 1 : 0.05F);
    }
  Wanted wanted;
  wanted.scene.spheres = SphereSet::from_world(x, y, z, r).value();
  wanted.scene.spheres.attributes().opacity = opacity;
  Material mirror = matte_material();
  mirror.reflective = 0.4;
  wanted.scene.materials = {mirror};
  wanted.scene.background = {0.2, 0.5, 1};
  wanted.scene.camera.eye = {0, 0, 12};
  wanted.scene.camera.look_at = {0, 0, 0};
  wanted.scene.lights = {light_behind(wanted.scene.camera)};
  wanted.settings.width_px = 48;
  wanted.settings.height_px = 48;
  wanted.settings.samples_per_pixel = 1;
  wanted.settings.opacity_rule = OpacityRule::once;
  wanted.settings.recursion = 1;
  for (const bool with_tree : {true, false}) expect_same(wanted, with_tree);
  wanted.settings.recursion = 3;
  expect_same(wanted);
  wanted.settings.view = View::recursion;
  expect_same(wanted);
}

TEST(Effects, without_a_tree) {
  Wanted wanted = balls();
  wanted.settings.ambient_occlusion = AmbientOcclusion{};
  wanted.settings.outline.emplace();
  put_opacity(wanted, 0.5F);
  expect_same(wanted, false);
}

// A part has the pixels of the whole picture, outlines at its edges too.
TEST(Crop, is_a_part_of_the_picture) {
  Wanted wanted = molecule();
  wanted.scene.camera = enlarged(wanted.scene.camera, 4);
  wanted.settings.outline = Outline{3, 1, {0, 0, 0}};
  wanted.settings.fog.emplace();
  for (const View view : {View::shaded, View::distance}) {
    wanted.settings.view = view;
    wanted.settings.crop.reset();
    const Image whole = gpu_image(wanted);
    wanted.settings.crop = Tile{21, 10, 70, 41};
    const Image part = gpu_image(wanted);
    ASSERT_EQ(part.width, 49);
    ASSERT_EQ(part.height, 31);
    for (int y = 0; y < part.height; ++y)
      for (int i = 0; i < 3 * part.width; ++i)
        ASSERT_EQ(part.rgb[std::size_t(3 * part.width * y + i)],
                  whole.rgb[std::size_t(3 * (kWidth * (y + 10) + 21) + i)]);
  }
}

// Coverage and light of transparent pictures.
TEST(Transparent, is_the_cpus) {
  for (const View view : {View::shaded, View::normal, View::id}) {
    Wanted wanted = molecule();
    wanted.settings.view = view;
    wanted.settings.transparent = true;
    wanted.settings.samples_per_pixel = 3;
    wanted.settings.fog.emplace();
    put_opacity(wanted, 0.5F);
    const Tracer tracer = Tracer::build(wanted.scene, Engine::reference).value();
    const Film cpu = render(wanted.scene, tracer, wanted.settings)->film;
    const Film gpu = GlPictures::get().draw(wanted.scene, tracer.tree(), wanted.settings).film;
    ASSERT_EQ(gpu.coverage.size(), cpu.coverage.size());
    int apart = 0, partly = 0;
    for (std::size_t i = 0; i < cpu.coverage.size(); ++i) {
      partly += cpu.coverage[i] > 0.01F && cpu.coverage[i] < 0.99F ? 1 : 0;
      double difference = std::abs(double(cpu.coverage[i]) - double(gpu.coverage[i]));
      for (int c = 0; c < 3; ++c)
        difference = std::max(difference, std::abs(double(cpu.radiance[i][c]) - double(gpu.radiance[i][c])));
      apart += difference > 0.01 ? 1 : 0;
    }
    EXPECT_GT(partly, 100);
    EXPECT_LE(apart, 0.005 * kWidth * kHeight);
  }
}

// The numbers of rays are the CPU's, nearly: no slice follows a path twice in the counts.
TEST(Effects, count_rays) {
  Wanted wanted = balls();
  wanted.settings.shadows = true;
  wanted.settings.ambient_occlusion = AmbientOcclusion{5, 300};
  const Tracer tracer = Tracer::build(wanted.scene, Engine::reference).value();
  const RenderCounts cpu = render(wanted.scene, tracer, wanted.settings)->rays;
  const GlRenderer::Picture gpu = GlPictures::get().draw(wanted.scene, tracer.tree(), wanted.settings);
  const double others = double(cpu.shadow + cpu.reflected + cpu.transmitted + cpu.ambient);
  EXPECT_EQ(gpu.primary, cpu.primary);
  EXPECT_NEAR(double(gpu.others), others, 0.002 * others);
}

TEST(Effects, cut_spheres_are_refused) {
  Wanted wanted = balls();
  wanted.scene.clips.push_back(Clip{});
  wanted.scene.spheres.attributes().clips.assign(static_cast<std::size_t>(wanted.scene.spheres.size()), 1);
  const Status status = GlPictures::get().renderer().set_scene(wanted.scene, nullptr);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("no cut spheres"), std::string::npos);
}

}  // namespace
}  // namespace bihive
