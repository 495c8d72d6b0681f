// Pictures of a replicated set are those of a set that holds the copies, bit for bit, with all that a picture can have.
// ctest: asan-long
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "bihive/geometry/each_sphere.h"
#include "bihive/math/rng.h"
#include "bihive/render/layers.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/creases.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/looks.h"
#include "bihive/simd/target.h"
#include "support/effort.h"
#include "support/scenes.h"
#include "support/world.h"

namespace bihive {
namespace {

struct Pair {
  Scene images, copies;
};

template <class T>
void repeat(std::vector<T>& values, std::int64_t times) {
  const std::vector<T> once = values;
  for (std::int64_t i = 1; i < times; ++i) values.insert(values.end(), once.begin(), once.end());
}

// A cloud with every attribute that changes a picture.
Pair scenes(std::array<Vec3d, 3> vectors, std::array<std::int32_t, 3> counts) {
  const test::World world = test::random_world("cloud", 5, 90, 1, 0.05, 0.3);
  Scene scene;
  scene.spheres = test::sphere_set(world);
  Material shiny = matte_material();
  shiny.reflective = 0.4;
  Material glass = matte_material();
  glass.transmissive = 0.6;
  glass.refraction_index = 1.3;
  scene.materials.push_back(shiny);
  scene.materials.push_back(glass);
  SphereAttributes& attributes = scene.spheres.attributes();
  SplitMix64 rng(3);
  NamedNumbers charge{"charge", {}};
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) {
    scene.material_of_sphere.push_back(id % 7 == 0 ? 2 : id % 3 == 0 ? 1 : 0);
    attributes.colour.push_back({float(rng.next_double()), float(rng.next_double()), float(rng.next_double())});
    attributes.opacity.push_back(id % 5 == 0 ? 0.4F : 1.0F);
    attributes.outline_px.push_back(id % 4 == 0 ? 2.0F : -1.0F);
    attributes.crease.push_back(static_cast<std::int32_t>(id % 2));
    charge.values.push_back(rng.next_double());
  }
  attributes.numbers.push_back(charge);
  Pair pair{scene, scene};
  EXPECT_TRUE(pair.images.spheres.replicate(vectors, counts).ok());

  test::World copies;
  for (int i = 0; i < counts[0]; ++i)
    for (int j = 0; j < counts[1]; ++j)
      for (int k = 0; k < counts[2]; ++k) {
        const Vec3d shift = double(i) * vectors[0] + double(j) * vectors[1] + double(k) * vectors[2];
        for (std::size_t s = 0; s < world.size(); ++s)
          copies.add(double(world.x[s]) + shift.x, double(world.y[s]) + shift.y, double(world.z[s]) + shift.z,
                     double(world.r[s]));
      }
  const std::int64_t times = std::int64_t{counts[0]} * counts[1] * counts[2];
  pair.copies.spheres = test::sphere_set(copies);
  repeat(pair.copies.material_of_sphere, times);
  SphereAttributes repeated = attributes;
  repeat(repeated.colour, times);
  repeat(repeated.opacity, times);
  repeat(repeated.outline_px, times);
  repeat(repeated.crease, times);
  repeat(repeated.numbers[0].values, times);
  pair.copies.spheres.attributes() = repeated;
  return pair;
}

void light(Scene& scene, Projection projection) {
  scene.camera = frame_spheres(scene.spheres, side_of(ViewFrom::iso), {30, projection}, 40, 30);
  const LightRig rig = *value_named(light_presets(), "studio");
  scene.lights = lights_around(rig, scene.camera);
  scene.ambient_light = rig.ambient_light;
}

RenderSettings everything() {
  RenderSettings settings;
  settings.width_px = 40;
  settings.height_px = 30;
  settings.recursion = 3;
  settings.light_points = 2;
  settings.ambient_occlusion = {2, 4};
  settings.opacity_rule = OpacityRule::once;
  settings.outline = Outline{1.5, 0.5, {0.1, 0, 0}};
  settings.fog = Fog{0.2, 0.9, 0.5};
  return settings;
}

void expect_equal(const Film& a, const Film& b, const std::string& what) {
  ASSERT_EQ(a.radiance.size(), b.radiance.size());
  EXPECT_EQ(std::memcmp(a.radiance.data(), b.radiance.data(), a.radiance.size() * sizeof(Vec3f)), 0) << what;
  EXPECT_EQ(a.coverage, b.coverage) << what;
}

void compare(const Pair& pair, const RenderSettings& settings, const std::string& what) {
  const Film truth = render(pair.copies, Tracer::build(pair.copies, Engine::reference).value(), settings).value().film;
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    const Tracer tracer = Tracer::build(pair.images, Engine::wide).value();
    for (const int threads : {1, 7}) {
      RenderSettings with_threads = settings;
      with_threads.threads = threads;
      expect_equal(render(pair.images, tracer, with_threads).value().film, truth,
                   what + ", " + target + ", threads " + std::to_string(threads));
    }
    ASSERT_TRUE(use_target("").ok());
  }
  for (const Engine engine : {Engine::reference, Engine::brute})
    expect_equal(render(pair.images, Tracer::build(pair.images, engine).value(), settings).value().film, truth,
                 what + ", scalar");
}

const std::array<Vec3d, 3> kSkewed{Vec3d{2.1, 0, 0}, Vec3d{0.7, 2.2, 0}, Vec3d{0, -0.4, 2.3}};

TEST(ImagesPicture, IsThatOfCopies) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Pair pair = scenes(kSkewed, {2, 2, 3});
    light(pair.images, projection);
    light(pair.copies, projection);
    EXPECT_EQ(pair.images.camera, pair.copies.camera);
    compare(pair, everything(), "everything");
    RenderSettings first = everything();
    first.opacity_rule = OpacityRule::first;
    compare(pair, first, "first surfaces");
    RenderSettings plain = everything();
    plain.opacity_rule = OpacityRule::each_surface;
    plain.fog.reset();
    plain.transparent = true;
    plain.adaptive_samples = true;
    compare(pair, plain, "each surface");
    for (const View view : {View::recursion, View::normal, View::distance, View::id}) {
      plain = RenderSettings();
      plain.width_px = 40;
      plain.height_px = 30;
      plain.view = view;
      compare(pair, plain, "view");
    }
  }
}

// Layers of cells whose spheres overlap those of the next, or lie in one place with them.
TEST(ImagesPicture, OfTightCellsIsThatOfCopies) {
  for (const std::array<Vec3d, 3>& vectors :
       {std::array<Vec3d, 3>{Vec3d{0.3, 0, 0}, Vec3d{0, -0.2, 0}, Vec3d{0, 0, 1e-9}},
        std::array<Vec3d, 3>{Vec3d{1e20, 0, 0}, Vec3d{0, 2, 0}, Vec3d{0, 0, 2}}}) {
    Pair pair = scenes(vectors, {2, 2, 2});
    light(pair.images, Projection::perspective);
    light(pair.copies, Projection::perspective);
    EXPECT_EQ(pair.images.camera, pair.copies.camera);
    compare(pair, everything(), "tight");
  }
}

TEST(ImagesPicture, ColoursByPlaceRunOverAllCopies) {
  for (const char* attribute : {"x", "z", "index", "charge"}) {
    Pair pair = scenes(kSkewed, {2, 1, 2});
    ColourBy how;
    how.attribute = attribute;
    const std::vector<Look> looks{{"charge < 0.7", {how}}, {"charge > 0.9", {SetColour{std::string("red")}}}};
    ASSERT_TRUE(apply_looks(pair.images, looks).ok());
    ASSERT_TRUE(apply_looks(pair.copies, looks).ok());
    EXPECT_EQ(pair.images.coloured_by[0].range, pair.copies.coloured_by[0].range) << attribute;
    light(pair.images, Projection::perspective);
    light(pair.copies, Projection::perspective);
    compare(pair, everything(), attribute);
  }
}

TEST(ImagesPicture, LooksKeepTheCopies) {
  Pair pair = scenes(kSkewed, {2, 2, 1});
  const std::vector<Look> looks{{"charge < 0.3", {SetShown{false}}}, {"charge > 0.6", {ScaleRadius{1.5}}}};
  ASSERT_TRUE(apply_looks(pair.images, looks).ok());
  ASSERT_TRUE(apply_looks(pair.copies, looks).ok());
  ASSERT_EQ(pair.images.spheres.total_size(), pair.copies.spheres.size());
  for (std::int64_t id = 0; id < pair.copies.spheres.size(); ++id)
    ASSERT_EQ(input_id(pair.images, id), input_id(pair.copies, id)) << id;
  light(pair.images, Projection::perspective);
  light(pair.copies, Projection::perspective);
  compare(pair, everything(), "hidden");
  EXPECT_EQ(focus_on(pair.images.spheres, pair.images.camera, "charge > 0.5").value(),
            focus_on(pair.copies.spheres, pair.copies.camera, "charge > 0.5").value());
  for_each_sphere(pair.images.spheres, [&](std::int64_t id, Vec3d centre, double radius) {
    ASSERT_EQ(centre, pair.copies.spheres.centre(id));
    ASSERT_EQ(radius, pair.copies.spheres.radius(id));
  });

  // Layers of numbers.
  const std::vector<Layer> layers = layers_from_text("albedo,depth,normal,id,attribute:charge").value();
  RenderSettings settings;
  settings.width_px = 40;
  settings.height_px = 30;
  const auto drawn = [&](const Scene& scene) {
    return draw_layers(scene, Tracer::build(scene, Engine::wide).value(), settings, layers, {}, nullptr);
  };
  const std::vector<Channel> of_images = drawn(pair.images);
  const std::vector<Channel> of_copies = drawn(pair.copies);
  ASSERT_FALSE(of_copies.empty());
  ASSERT_EQ(of_images.size(), of_copies.size());
  for (std::size_t i = 0; i < of_copies.size(); ++i) {
    EXPECT_EQ(of_images[i].ids, of_copies[i].ids) << of_copies[i].name;
    ASSERT_EQ(of_images[i].numbers.size(), of_copies[i].numbers.size());
    if (of_copies[i].numbers.empty()) continue;
    EXPECT_EQ(std::memcmp(of_images[i].numbers.data(), of_copies[i].numbers.data(),
                          of_copies[i].numbers.size() * sizeof(float)),
              0)
        << of_copies[i].name;
  }
}

// However many copies there are, a set and its tracer hold what one copy needs.
TEST(ImagesPicture, TakesTheMemoryOfOneCopy) {
  const auto bytes = [](std::array<std::int32_t, 3> counts) {
    const Pair pair = scenes(kSkewed, {1, 1, 1});
    SphereSet set = pair.images.spheres;
    EXPECT_TRUE(set.replicate(kSkewed, counts).ok());
    const Tracer tracer = Tracer::build(set, Engine::wide).value();
    EXPECT_EQ(tracer.wide_tree()->size, set.size());
    return set.allocated_bytes() + tracer.wide_tree()->allocated_bytes();
  };
  EXPECT_EQ(bytes({3, 3, 3}), bytes({300, 300, 300}));
}

TEST(ImagesPicture, RefusesWhatItCannotDraw) {
  Pair pair = scenes(kSkewed, {2, 1, 1});
  light(pair.images, Projection::perspective);
  RenderSettings settings = everything();
  EXPECT_FALSE(render(pair.images, Tracer::build(pair.copies, Engine::wide).value(), settings).ok());
  settings.view = View::traversal;
  const Tracer reference = Tracer::build(pair.images, Engine::reference).value();
  const auto refused = render(pair.images, reference, settings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().to_string().find("replicate"), std::string::npos);
  ASSERT_TRUE(apply_looks(pair.images, {{"all", {AddClip{PlaneClip{{0, 0, 1}, 0}}}}}).ok());
  EXPECT_FALSE(Tracer::build(pair.images, Engine::wide).ok());
}

}  // namespace
}  // namespace bihive
