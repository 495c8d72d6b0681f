// Whitted shading on scenes with answers calculated by hand.
// ctest: inlined
// ctest: asan-long
#include "bihive/render/shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bihive/render/shade/integrator.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

Material material(double ambient, double diffuse, double reflective, double specular, double transmissive,
                  double index) {
  return {{1, 0.5, 0.25}, ambient, diffuse, reflective, specular, 10, transmissive, index};
}

// A unit sphere at the origin, seen from +z.
Scene one_sphere(const Material& surface) {
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<float>{0}, {0}, {0}, {1}).value();
  scene.materials = {surface};
  scene.background = {0.25, 0.5, 1};
  return scene;
}

Ray ray_at(Vec3f origin, Vec3f direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return ray;
}

Vec3d radiance(const Scene& scene, const Ray& ray, int recursion, bool shadows) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  Integrator integrator(scene, tracer, recursion, shadows);
  return integrator.radiance(ray);
}

const Ray kHeadOn = ray_at({0, 0, 5}, {0, 0, -1});

void expect_near(Vec3d value, Vec3d expected, double tolerance) {
  EXPECT_NEAR(value.x, expected.x, tolerance);
  EXPECT_NEAR(value.y, expected.y, tolerance);
  EXPECT_NEAR(value.z, expected.z, tolerance);
}

TEST(Shading, light_behind_the_camera_reaches_ambient_plus_diffuse_plus_specular) {
  Scene scene = one_sphere(material(0.25, 0.5, 0, 0.125, 0, 1));
  scene.lights = {{{0, 0, 9}, {1, 1, 1}}};
  EXPECT_EQ(radiance(scene, kHeadOn, 1, true), (Vec3d{0.75 + 0.125, 0.375 + 0.125, 0.1875 + 0.125}));
}

TEST(Shading, lights_add_up_in_their_colours) {
  Scene scene = one_sphere(material(0, 0.5, 0, 0, 0, 1));
  scene.lights = {{{0, 0, 9}, {1, 0, 0}}, {{0, 0, 3}, {0, 1, 0.5}}};
  EXPECT_EQ(radiance(scene, kHeadOn, 1, true), (Vec3d{0.5, 0.25, 0.0625}));
}

TEST(Shading, a_light_behind_the_surface_gives_ambient_only) {
  Scene scene = one_sphere(material(0.5, 0.5, 0, 0.5, 0, 1));
  scene.lights = {{{0, 0, -9}, {1, 1, 1}}};
  EXPECT_EQ(radiance(scene, kHeadOn, 1, false), (Vec3d{0.5, 0.25, 0.125}));
}

TEST(Shading, shadows_fall_when_asked_for) {
  Scene scene = one_sphere(material(0, 1, 0, 0, 0, 1));
  scene.spheres = SphereSet::from_world(std::vector<float>{0, 0}, {0, 5}, {0, 1}, {1, 0.5F}).value();
  scene.lights = {{{0, 10, 1}, {1, 1, 1}}};
  const Ray at_the_front = ray_at({0, 0.5F, 5}, {0, 0, -1});
  EXPECT_GT(radiance(scene, at_the_front, 1, false).x, 0);
  EXPECT_EQ(radiance(scene, at_the_front, 1, true).x, 0);
}

TEST(Shading, a_mirror_shows_the_background) {
  EXPECT_EQ(radiance(one_sphere(material(0, 0, 0.5, 0, 0, 1)), kHeadOn, 2, true), (Vec3d{0.125, 0.25, 0.5}));
  EXPECT_EQ(radiance(one_sphere(material(0, 0, 0.5, 0, 0, 1)), kHeadOn, 1, true), (Vec3d{0, 0, 0}))
      << "depth 1: primary rays only";
}

TEST(Shading, clear_glass_needs_three_generations) {
  // Index 1: straight through, one surface in and one out.
  const Scene scene = one_sphere(material(0, 0, 0, 0, 0.5, 1));
  const Ray aside = ray_at({0.3F, 0.2F, 5}, {0, 0, -1});
  EXPECT_EQ(radiance(scene, aside, 2, true), (Vec3d{0, 0, 0}));
  expect_near(radiance(scene, aside, 3, true), Vec3d{0.25, 0.5, 1} * 0.25, 1e-15);
}

TEST(Shading, refraction_follows_snell) {
  const Scene scene = one_sphere(material(0, 0, 0, 0, 1, 1.5));
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  const Ray ray = ray_at({0.6F, 0, 5}, {0, 0, -1});
  const Surface surface = surface_at(scene, ray, scene_hit(scene, tracer, ray));
  EXPECT_FALSE(surface.from_inside);
  const Ray inside = transmitted_ray(surface);
  EXPECT_TRUE(inside.inside);
  EXPECT_EQ(inside.leaves, 0);
  const Vec3d direction = to_double(inside.direction);
  const double sine_out = 0.6;
  const double sine_in = length(cross(direction, surface.normal));
  EXPECT_NEAR(sine_in, sine_out / 1.5, 1e-6);
  EXPECT_LT(direction.x, 0) << "bent towards the normal";

  // It leaves on the far side at the angle at which it entered.
  const SceneHit exit = scene_hit(scene, tracer, inside);
  ASSERT_EQ(exit.id, 0);
  const Surface far = surface_at(scene, inside, exit);
  EXPECT_TRUE(far.from_inside);
  const Ray out = transmitted_ray(far);
  EXPECT_FALSE(out.inside);
  EXPECT_NEAR(length(cross(to_double(out.direction), far.normal)), sine_out, 1e-6);
  EXPECT_FALSE(scene_hit(scene, tracer, out).found()) << "a sphere left outward is not met again";
}

TEST(Shading, total_reflection_on_entering_goes_along_the_mirror_direction) {
  // Index 0.5: beyond 30 degrees nothing enters.
  const Scene scene = one_sphere(material(0, 0, 0, 0, 1, 0.5));
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  const Ray ray = ray_at({0.8F, 0, 5}, {0, 0, -1});
  const Surface surface = surface_at(scene, ray, scene_hit(scene, tracer, ray));
  const Ray transmitted = transmitted_ray(surface);
  EXPECT_EQ(transmitted.direction, reflected_ray(surface).direction);
  EXPECT_FALSE(transmitted.inside);
  expect_near(radiance(scene, ray, 2, true), scene.background, 1e-15);
}

TEST(Shading, the_normal_is_turned_against_a_ray_from_inside) {
  Scene scene = one_sphere(material(0, 1, 0, 0, 0, 1));
  scene.lights = {{{0, 0, 0.5}, {1, 1, 1}}};
  const Ray from_middle = ray_at({0, 0, 0}, {0, 0, -1});
  EXPECT_EQ(radiance(scene, from_middle, 1, true).x, 1) << "a light inside lights the inner side";
  scene.lights = {{{0, 0, 9}, {1, 1, 1}}};
  EXPECT_EQ(radiance(scene, from_middle, 1, true).x, 0) << "the sphere hides a light outside";
}

TEST(Shading, checker_of_the_thesis) {
  Scene scene = thesis_scene_without_spheres();
  scene.lights.clear();
  const auto down_at = [&](float x, float z) { return radiance(scene, ray_at({x, 0, z}, {0, -1, 0}), 1, false).x; };
  EXPECT_DOUBLE_EQ(down_at(1, 1), 0.8 * 0.3);
  EXPECT_DOUBLE_EQ(down_at(6, 1), 0.6 * 0.3);
  EXPECT_DOUBLE_EQ(down_at(6, 6), 0.8 * 0.3);
  EXPECT_DOUBLE_EQ(down_at(-1, 1), 0.6 * 0.3);
  EXPECT_DOUBLE_EQ(down_at(-1, -1), 0.8 * 0.3);
  EXPECT_DOUBLE_EQ(down_at(600, 1), 0.7 * 0.3) << "far away: the mean";
  EXPECT_DOUBLE_EQ(down_at(499, 1), 0.6 * 0.3) << "floor(99.8) + floor(0.2) is odd";
}

TEST(Shading, transparent_sphere_of_the_thesis_is_dark_grey_at_depth_1) {
  const Scene scene = four_spheres_scene();
  const Vec3d centre = scene.spheres.centre(3);
  const Vec3d towards = normalized(centre - scene.camera.eye);
  const Vec3d value = radiance(scene, ray_at({0, 0, 100}, to_float(towards)), 1, false);
  EXPECT_EQ(value.x, value.y);
  EXPECT_EQ(value.x, value.z);
  EXPECT_GE(value.x, 0.1);
  EXPECT_LE(value.x, 0.2);
}

}  // namespace
}  // namespace bihive
