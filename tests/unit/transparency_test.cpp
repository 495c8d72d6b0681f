// Spheres that light passes straight, under OpacityRule::once: how much gets through, in which order, and to where.
// ctest: asan-long
#include "bihive/render/transparency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/render/query/brute_force.h"
#include "bihive/render/renderer.h"
#include "bihive/render/shade/integrator.h"
#include "bihive/render/shading.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

struct Layer {
  Vec3d centre;
  double radius = 1;
  float opacity = 1;
  Vec3f glow{};  // its colour, which needs no light
};

// Seen from (0, 0, 100) towards -z. Each sphere shows its colour as it is.
Scene scene_of_layers(const std::vector<Layer>& balls) {
  std::vector<double> x, y, z, r;
  Scene scene;
  for (const Layer& ball : balls) {
    x.push_back(ball.centre.x);
    y.push_back(ball.centre.y);
    z.push_back(ball.centre.z);
    r.push_back(ball.radius);
  }
  scene.spheres = SphereSet::from_world(x, y, z, r).value();
  for (const Layer& ball : balls) {
    scene.spheres.attributes().colour.push_back(ball.glow);
    scene.spheres.attributes().opacity.push_back(ball.opacity);
  }
  Material flat;
  flat.ambient = 1;
  scene.materials = {flat};
  scene.camera.eye = {0, 0, 100};
  scene.background = {1, 1, 1};
  scene.picture.opacity_rule = OpacityRule::once;
  return scene;
}

Transparency parts_of(const Scene& scene) {
  return Transparency::of(scene, scene.picture.opacity_rule, Engine::wide, 1).value();
}

Vec3d light_along(const Scene& scene, Vec3f origin, Vec3f direction, int recursion = 1) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  const Transparency parts = parts_of(scene);
  Integrator integrator(scene, tracer, recursion, true, nullptr, nullptr, &parts);
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return integrator.radiance(ray);
}

constexpr Vec3f kAhead{0, 0, -1};

// Shares of light are fixed point (math/optical_depth.h): halves are exact.
constexpr double kStep = 2e-7;

TEST(Transparency, a_sphere_takes_its_opacity_once) {
  Scene scene = scene_of_layers({{{0, 0, 0}, 1, 0.5F}});
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead).x, 0.5);
  // The old rule: both surfaces, and a generation each.
  scene.picture.opacity_rule = OpacityRule::each_surface;
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead, 3).x, 0.25);
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead, 1).x, 0);
}

TEST(Transparency, layers_need_no_recursion) {
  std::vector<Layer> balls;
  for (int i = 0; i < 10; ++i) balls.push_back({{0, 0, -3.0 * i}, 1, 0.25F});
  EXPECT_EQ(light_along(scene_of_layers(balls), {0, 0, 10}, kAhead).x, std::pow(0.75, 10));
}

TEST(Transparency, of_one_opacity_the_first_surface_alone_counts) {
  std::vector<Layer> balls;
  for (int i = 0; i < 10; ++i) balls.push_back({{0, 0, -3.0 * i}, 1, 0.25F, {1, 0, 0}});
  balls.push_back({{0, 0, -100}, 1, 1, {0, 0, 1}});
  Scene scene = scene_of_layers(balls);
  scene.picture.opacity_rule = OpacityRule::first;
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead), (Vec3d{0.25, 0, 0.75}));
  // A ray that starts inside of one leaves it, and that is all.
  EXPECT_EQ(light_along(scene, {0, 0, 0}, kAhead), (Vec3d{0.25, 0, 0.75}));

  // Another opacity is a body of its own; within a sixteenth it is the same.
  scene.spheres.attributes().opacity[2] = 0.5F;
  scene.spheres.attributes().opacity[3] = 0.2F;
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead), (Vec3d{0.25 + 0.75 * 0.5, 0, 0.75 * 0.5}));
  EXPECT_EQ(opacity_class(1), kOpacityClasses - 1);
  EXPECT_EQ(opacity_class(1e-9), 0);
  EXPECT_EQ(opacity_class(0.75), 12);
}

TEST(Transparency, light_is_weakened_by_the_first_surface_alone_and_not_tinted) {
  Scene scene = scene_of_layers({{{0, 0, 0}, 1, 0.25F, {1, 0, 0}}, {{0, 0, -3}, 1, 0.25F, {1, 0, 0}}});
  Ray ray;
  ray.origin = {0, 0, 10};
  ray.direction = kAhead;
  scene.picture.opacity_rule = OpacityRule::once;
  const Vec3d of_both = parts_of(scene).to_light->share(ray);
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(of_both[channel], channel == 0 ? 0.5625 : 0.5625 * 0.5625, kStep);
  scene.picture.opacity_rule = OpacityRule::first;
  EXPECT_EQ(parts_of(scene).to_light->share(ray), (Vec3d{0.75, 0.75, 0.75}));

  // Refracting spheres are bodies each.
  scene.spheres.attributes().opacity.clear();
  scene.materials[0].transmissive = 0.5;
  scene.materials[0].refraction_index = 1.5;
  const Vec3d of_glass = parts_of(scene).to_light->share(ray);
  scene.picture.opacity_rule = OpacityRule::once;
  EXPECT_EQ(of_glass, parts_of(scene).to_light->share(ray));
  EXPECT_LT(of_glass.x, 0.3);
}

TEST(Transparency, overlapping_spheres_count_as_one) {
  // Two that overlap, one inside of them, and one apart; then one of another opacity, and an opaque one.
  Scene scene = scene_of_layers({{{0, 0, 0}, 1, 0.25F, {1, 0, 0}},
                                 {{0, 0, -1.5}, 1, 0.25F, {0, 1, 0}},
                                 {{0, 0, -0.75}, 0.5, 0.25F, {0, 1, 0}},
                                 {{0, 0, -5}, 1, 0.25F, {0, 0, 1}},
                                 {{0, 0, -4.5}, 1, 0.5F, {0, 0, 1}},
                                 {{0, 0, -20}, 1, 1, {0, 1, 0}}});
  scene.picture.opacity_rule = OpacityRule::as_one;
  EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead), (Vec3d{0.25, 0.75 * 0.75 * 0.5, 0.75 * 0.5 + 0.75 * 0.5 * 0.25}));
  // What starts inside exits the last of them.
  EXPECT_EQ(light_along(scene, {0, 0, -0.75F}, kAhead),
            (Vec3d{0, 0.25 + 0.75 * 0.75 * 0.5, 0.75 * 0.5 + 0.75 * 0.5 * 0.25}));
  // Nothing of the union is crossed by a ray that ends in it.
  Ray ray;
  ray.origin = {0, 0, -0.75F};
  ray.direction = kAhead;
  ray.t_max = 1.7;
  EXPECT_EQ(parts_of(scene).to_light->share(ray).x, 1);
  ray.t_max = 1.75;
  EXPECT_EQ(parts_of(scene).to_light->share(ray).x, 0.75);
  // Spheres that touch are one, also where one ends as the other begins.
  scene.spheres = SphereSet::from_world(std::vector<double>{0, 0}, {0, 0}, {0, -2}, {1, 1}).value();
  scene.spheres.attributes().opacity = {0.25F, 0.25F};
  ray.origin = {0, 0, 10};
  ray.t_max = 100;
  EXPECT_EQ(parts_of(scene).to_light->share(ray).x, 0.75);
}

// A dumb-bell along z, and a stick beside it; their opacity is that of their spheres.
TEST(Transparency, sticks_are_as_clear_as_their_spheres) {
  Scene scene = scene_of_layers(
      {{{0, 0, 0}, 1, 0.25F, {1, 0, 0}}, {{0, 0, -10}, 1, 0.25F, {0, 0, 1}}, {{5, 0, 0}, 1, 1, {0, 1, 0}}});
  scene.sticks = StickSet::between(scene.spheres, std::vector<SpherePair>{{0, 1}}, 0.5).value();
  ASSERT_TRUE(scene.sticks.add(scene.spheres, {{{5, 0, -3}, {5, 0, -6}, 0.25, 0, 2}}));
  const auto share_at = [&](Vec3f origin, Vec3f direction, OpacityRule rule) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return Transparency::of(scene, rule, Engine::wide, 1)->to_eye->share(ray).x;
  };
  for (const OpacityRule rule : {OpacityRule::once, OpacityRule::first, OpacityRule::as_one}) {
    // Across both, across the stick alone, the opaque point of an arrow alone, and past both.
    EXPECT_EQ(share_at({-9, 0, -5}, {1, 0, 0}, rule), 0);
    EXPECT_NEAR(share_at({0, -9, -5}, {0, 1, 0}, rule), 0.75, kStep);
    EXPECT_EQ(share_at({5, -9, -4}, {0, 1, 0}, rule), 0);
    EXPECT_EQ(share_at({2, -9, -4}, {0, 1, 0}, rule), 1);
  }
  // Along it: two spheres and a stick, of which the blue sphere tints red light too; or one body.
  EXPECT_NEAR(share_at({0, 0, 9}, kAhead, OpacityRule::once), std::pow(0.75, 4), kStep);
  EXPECT_EQ(share_at({0, 0, 9}, kAhead, OpacityRule::first), 0.75);
  EXPECT_EQ(share_at({0, 0, 9}, kAhead, OpacityRule::as_one), 0.75);
  // Through both spheres, whose stick lies beside the ray.
  EXPECT_EQ(share_at({0.75F, 0, 9}, kAhead, OpacityRule::as_one), 0.75 * 0.75);
  EXPECT_EQ(share_at({0.75F, 0, 9}, kAhead, OpacityRule::first), 0.75);

  // Halves of their own colour tint the light.
  Ray ray;
  ray.origin = {0, -9, -3};
  ray.direction = {0, 1, 0};
  const auto parts = Transparency::of(scene, OpacityRule::once, Engine::wide, 1).value();
  EXPECT_NEAR(parts.to_light->share(ray).x, 0.75, kStep);
  EXPECT_NEAR(parts.to_light->share(ray).z, 0.75 * 0.75, kStep);
  ray.origin = {0, -9, -7};
  EXPECT_NEAR(parts.to_light->share(ray).x, 0.75 * 0.75, kStep);
  EXPECT_NEAR(parts.to_light->share(ray).z, 0.75, kStep);
}

TEST(Transparency, a_stick_between_spheres_of_two_opacities_has_two_parts) {
  Scene scene = scene_of_layers({{{0, 0, 0}, 1, 0.25F}, {{0, 0, -10}, 1, 1}, {{0, 0, -20}, 1, 1}});
  scene.sticks = StickSet::between(scene.spheres, std::vector<SpherePair>{{1, 2}}, 0.5).value();
  EXPECT_TRUE(check_sticks(scene));
  scene.sticks = StickSet::between(scene.spheres, std::vector<SpherePair>{{0, 1}}, 0.5).value();
  EXPECT_FALSE(check_sticks(scene));
  EXPECT_FALSE(Tracer::build(scene, Engine::wide));
  const auto is_parted = [&](const SpherePair& pair) { return !are_equally_clear(scene, pair[0], pair[1]); };
  scene.sticks = StickSet::between(scene.spheres, {{{0, 1}, {}}, {{1, 2}, {}}}, 0.5, is_parted).value();
  ASSERT_TRUE(check_sticks(scene));
  ASSERT_EQ(scene.sticks.size(), 3);
  const Transparency parts = parts_of(scene);
  for (const auto& [z, share] : {std::pair(-3.0F, 0.75), std::pair(-7.0F, 0.0), std::pair(-15.0F, 0.0)}) {
    Ray ray;
    ray.origin = {0, -9, z};
    ray.direction = {0, 1, 0};
    EXPECT_NEAR(parts.to_eye->share(ray).x, share, kStep) << z;
  }
}

TEST(Transparency, faint_rays_are_not_followed) {
  // A mirror before the eye shows the white background, and nothing else is seen.
  for (const double reflective : {kFaintestRay, std::nextafter(kFaintestRay, 0.0)}) {
    for (const float opacity_of_another : {0.5F, 1.0F}) {
      Scene scene = scene_of_layers({{{0, 0, 0}, 1}, {{50, 0, 0}, 1, opacity_of_another}});
      scene.materials[0].ambient = 0;
      scene.materials[0].reflective = reflective;
      const bool followed = reflective == kFaintestRay || opacity_of_another == 1;
      EXPECT_EQ(light_along(scene, {0, 0, 10}, kAhead, 2).x, followed ? reflective : 0);
    }
  }
}

TEST(Transparency, layers_that_hardly_any_light_reaches_are_not_shaded) {
  // A black layer lets the smallest share through at which the next one is shaded, or less. The third gets too little
  // in both cases, and the background is seen in full.
  std::vector<std::int64_t> rays;
  for (const double share : {kFaintestRay, kFaintestRay / 2}) {
    Scene scene = scene_of_layers({{{0, 0, 0}, 1, static_cast<float>(1 - share), {0, 0, 0}},
                                   {{0, 0, -3}, 1, 0.5F, {1, 1, 1}},
                                   {{0, 0, -6}, 1, 0.5F, {1, 1, 1}}});
    const AmbientRays ambient({10, 32}, 1);
    const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
    const Transparency parts = parts_of(scene);
    Integrator integrator(scene, tracer, 1, true, &ambient, nullptr, &parts);
    Ray ray;
    ray.origin = {0, 0, 10};
    ray.direction = kAhead;
    const double light = integrator.radiance(ray).x;
    rays.push_back(integrator.rays().ambient);
    const double of_background = share / 4;
    if (share < kFaintestRay)
      EXPECT_EQ(light, of_background);
    else
      EXPECT_GT(light, of_background);
  }
  EXPECT_EQ(rays[0], rays[1] + 1);
}

TEST(Transparency, faint_layers_ask_fewer_directions_and_points) {
  EXPECT_EQ(faint_level(1), 0);
  EXPECT_EQ(faint_level(0.71), 0);
  EXPECT_EQ(faint_level(0.7), 1);
  EXPECT_EQ(faint_level(0.36), 1);
  EXPECT_EQ(faint_level(0.125), 3);
  EXPECT_EQ(faint_level(0), kFaintLevels - 1);
  EXPECT_EQ(used_at_level(64, 2, kFewestDirections), 16);
  EXPECT_EQ(used_at_level(64, 5, kFewestDirections), kFewestDirections);
  EXPECT_EQ(used_at_level(12, 4, kFewestLightPoints), kFewestLightPoints);
  EXPECT_EQ(used_at_level(3, 4, kFewestDirections), 2);
  EXPECT_EQ(used_at_level(1, 4, kFewestDirections), 1);

  // One layer of opacity 1/4 before nothing: a quarter of the rays of an opaque sphere.
  const AmbientRays ambient({10, 256}, 1);
  const LightPointSets points(256, 1);
  RenderCounts rays[2];
  for (const float opacity : {0.25F, 1.0F}) {
    Scene scene = scene_of_layers({{{0, 0, 0}, 1, opacity}, {{50, 0, 0}, 1, 0.5F}});
    scene.lights = {{{0, 0, 100}, {1, 1, 1}}};
    scene.lights[0].radius = 5;
    const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
    const Transparency parts = parts_of(scene);
    Integrator integrator(scene, tracer, 1, true, &ambient, &points, &parts);
    Ray ray;
    ray.origin = {0, 0, 10};
    ray.direction = kAhead;
    integrator.radiance(ray);
    rays[opacity == 1] = integrator.rays();
  }
  EXPECT_EQ(rays[1].shadow, 256);
  EXPECT_EQ(rays[0].shadow, 64);
  EXPECT_NEAR(static_cast<double>(rays[1].ambient), 128, 2);
  EXPECT_NEAR(static_cast<double>(rays[0].ambient), 32, 2);
}

TEST(Transparency, mirrors_in_layers_send_few_rays) {
  // Sixteen layers, and as many before each mirrored ray: 16 to the power of the generation, if all were followed.
  std::vector<Layer> balls;
  for (int i = 0; i < 16; ++i) balls.push_back({{0, 0, -3.0 * i}, 1, 0.5F});
  for (int i = 0; i < 16; ++i) balls.push_back({{0, 0, 20 + 3.0 * i}, 1, 0.5F});
  Scene scene = scene_of_layers(balls);
  scene.materials[0].reflective = 0.12;
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  const Transparency parts = parts_of(scene);
  Integrator integrator(scene, tracer, 8, true, nullptr, nullptr, &parts);
  Ray ray;
  ray.origin = {0, 0, 10};
  ray.direction = kAhead;
  integrator.radiance(ray);
  EXPECT_GT(integrator.rays().reflected, 4);
  EXPECT_LT(integrator.rays().reflected, 64);
}

TEST(Transparency, the_nearest_layer_comes_first) {
  const Scene scene = scene_of_layers(
      {{{0, 0, -4}, 1, 0.25F, {0, 1, 0}}, {{0, 0, 0}, 1, 0.5F, {1, 0, 0}}, {{0, 0, -8}, 1, 1, {0, 0, 1}}});
  // What is behind the red layer has the tint (1, 1/2, 1/2), and behind the green one (3/4, 1, 3/4) too.
  const Vec3d light = light_along(scene, {0, 0, 10}, kAhead);
  EXPECT_EQ(light.x, 0.5);
  EXPECT_EQ(light.y, (0.5 * 0.5) * 0.25);
  EXPECT_EQ(light.z, (0.5 * 0.75) * (0.5 * 0.75));
}

TEST(Transparency, the_hue_tints_what_gets_through_and_the_share_alone_weakens_it) {
  Material material;
  material.transmissive = 0.5;
  material.colour = {0.8, 0.4, 0};
  EXPECT_EQ(passing_tint(material), (Vec3d{1, 0.75, 0.5}));
  material.transmissive = 1;
  EXPECT_EQ(passing_tint(material), (Vec3d{1, 1, 1}));
  material.transmissive = 0;
  EXPECT_EQ(passing_tint(material), (Vec3d{1, 0.5, 0}));
  for (const double grey : {0.0, 0.3, 1.0}) {
    material.colour = {grey, grey, grey};
    EXPECT_EQ(passing_tint(material), (Vec3d{1, 1, 1})) << grey;
  }
}

TEST(Transparency, shadows_and_occlusion_have_the_tint) {
  // The ground under a red sphere of opacity 1/2.
  Scene scene = scene_of_layers({{{0, 3, 0}, 1, 0.5F, {1, 0, 0}}});
  scene.plane = thesis_plane();
  scene.plane->plane.point = {0, 0, 0};
  scene.plane->checker.reset();
  scene.plane->material = Material();
  scene.plane->material.diffuse = 1;
  scene.lights = {{{0, 100, 0}, {1, 1, 1}}};
  EXPECT_EQ(light_along(scene, {3, 3, 0}, {-1, -1, 0}), (Vec3d{0.5, 0.25, 0.25}));

  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  const Transparency parts = parts_of(scene);
  Surface surface{};
  surface.normal = {0, 1, 0};
  surface.id = kPlane;
  std::int64_t rays = 0;
  EXPECT_EQ(ambient_visibility(scene, {tracer, parts.to_light.get()}, surface, {{0, 1, 0}, {1, 1, 0}},
                               std::numeric_limits<double>::infinity(), rays),
            (Vec3d{0.75, 0.625, 0.625}));
  const LightPointSets points(64, 1);
  PointLight light{{0, 100, 0}, {1, 1, 1}, 0.5};
  const LightShare share = soft_light_share(light, {tracer, parts.to_light.get()}, surface, points.of_sample(0), rays);
  EXPECT_EQ(share.seen, (Vec3d{0.5, 0.25, 0.25}));
}

TEST(Transparency, a_mirrored_ray_keeps_the_tint_of_what_it_passed) {
  // A green layer before a mirror that shows the white background.
  Scene scene = scene_of_layers({{{0, 0, 5}, 1, 0.5F, {0, 1, 0}}, {{0, 0, 0}, 1, 1}});
  scene.materials[0].ambient = 0;
  scene.materials[0].reflective = 0.5;
  scene.camera.eye = {0, 0, 100};
  // The layer mirrors the background itself, and so does what is behind it, seen through it on the way.
  const Vec3d light = light_along(scene, {0, 0, 10}, kAhead, 2);
  EXPECT_EQ(light.y, 0.5 + 0.5 * 0.5 * 0.5);
  EXPECT_EQ(light.x, 0.5 + 0.5 * 0.5 * 0.5 * (0.5 * 0.5));
}

TEST(Transparency, full_and_no_opacity) {
  EXPECT_EQ(light_along(scene_of_layers({{{0, 0, 0}, 1, 1, {1, 0, 0}}}), {0, 0, 10}, kAhead).y, 0);
  const Vec3d clear = light_along(scene_of_layers({{{0, 0, 0}, 1, 0, {1, 0, 0}}}), {0, 0, 10}, kAhead);
  EXPECT_EQ(clear.x, 1);
  EXPECT_EQ(clear.y, 1);
}

TEST(Transparency, a_ray_that_starts_inside_crosses_the_sphere_on_its_way_out) {
  const Scene scene = scene_of_layers({{{0, 0, 0}, 2, 0.5F}, {{0, 0, -1}, 0.5, 1, {1, 1, 1}}});
  EXPECT_EQ(light_along(scene, {0, 0, 0}, {0, 0, 1}).x, 0.5);
  EXPECT_EQ(light_along(scene, {0, 0, 0}, kAhead).x, 1) << "it ends inside, too";
}

TEST(Transparency, shadows_and_occlusion_are_as_weak_as_the_sphere) {
  // A place under a sphere that hides the light.
  for (const float opacity : {0.0F, 0.25F, 0.5F, 1.0F}) {
    Scene scene = scene_of_layers({{{0, 3, 0}, 1, opacity}});
    scene.plane = thesis_plane();
    scene.plane->plane.point = {0, 0, 0};
    scene.plane->checker.reset();
    scene.plane->material = Material();
    scene.plane->material.diffuse = 1;
    scene.lights = {{{0, 100, 0}, {1, 1, 1}}};
    EXPECT_NEAR(light_along(scene, {3, 3, 0}, {-1, -1, 0}).x, 1 - double(opacity), kStep) << opacity;

    // The share that half of the directions lose.
    const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
    const Transparency parts = parts_of(scene);
    Surface surface{};
    surface.origin = {0, 0, 0};
    surface.normal = {0, 1, 0};
    surface.id = kPlane;
    std::int64_t rays = 0;
    const Vec3d visibility = ambient_visibility(scene, {tracer, parts.to_light.get()}, surface,
                                                {{0, 1, 0}, {0, 1, 0.001F}, {1, 1, 0}, {-1, 1, 0}},
                                                std::numeric_limits<double>::infinity(), rays);
    EXPECT_NEAR(visibility.x, (2 + 2 * (1 - double(opacity))) / 4, kStep) << opacity;
  }
}

TEST(Transparency, light_passes_glass_with_its_transmission) {
  Scene scene = scene_of_layers({{{0, 3, 0}, 1}});
  scene.materials[0].transmissive = 0.75;
  scene.materials[0].refraction_index = 1.5;
  scene.plane = thesis_plane();
  scene.plane->plane.point = {0, 0, 0};
  scene.plane->checker.reset();
  scene.plane->material = Material();
  scene.plane->material.diffuse = 1;
  scene.lights = {{{0, 100, 0}, {1, 1, 1}}};
  EXPECT_EQ(parts_of(scene).to_eye, nullptr);
  EXPECT_NEAR(light_along(scene, {3, 3, 0}, {-1, -1, 0}).x, 0.75, kStep);
  scene.picture.opacity_rule = OpacityRule::each_surface;
  EXPECT_EQ(light_along(scene, {3, 3, 0}, {-1, -1, 0}).x, 0);
}

TEST(Transparency, nothing_is_divided_where_all_is_opaque) {
  const Scene scene = scene_of_layers({{{0, 0, 0}}});
  EXPECT_EQ(parts_of(scene).to_eye, nullptr);
  EXPECT_EQ(parts_of(scene).to_light, nullptr);
}

TEST(Transparency, a_ray_leaves_all_spheres_that_are_equal) {
  // Both are one surface: a ray from the opaque one does not cross the transparent one.
  const Scene scene = scene_of_layers({{{0, 0, 0}, 1, 1}, {{0, 0, 0}, 1, 0.5F}, {{0, 0, 0}, 1, 1}});
  const Transparency parts = parts_of(scene);
  SplitMix64 random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d outward =
        normalized(Vec3d{random.next_double() - 0.5, random.next_double() - 0.5, random.next_double() - 0.5});
    Ray ray;
    ray.origin = to_float(outward);
    ray.direction = to_float(outward + 0.5 * Vec3d{outward.y, outward.z, outward.x});
    for (ray.leaves = 0; ray.leaves < 3; ++ray.leaves) EXPECT_EQ(parts.to_eye->share(ray).x, 1.0);
  }
}

// Against the definition, sphere by sphere, on hostile sets: touching, nested, equal, of no radius.
TEST(Transparency, crossings_are_those_of_all_spheres) {
  SplitMix64 random(11);
  for (int round = 0; round < 40; ++round) {
    const int count = 1 + static_cast<int>(random.next() % 200);
    const double unit = std::pow(10.0, static_cast<double>(random.next() % 9) * 5 - 20);
    std::vector<double> x, y, z, r, passing;
    for (int i = 0; i < count; ++i) {
      x.push_back(unit * static_cast<double>(random.next() % 5));
      y.push_back(unit * static_cast<double>(random.next() % 5));
      z.push_back(unit * random.next_double() * 5);
      r.push_back(unit * 0.25 * static_cast<double>(random.next() % 5));
      passing.push_back(random.next() % 3 == 0 ? 0 : random.next_double());
    }
    std::vector<std::int8_t> classes;
    if (round % 2 == 1)
      for (const double share : passing)
        classes.push_back(static_cast<std::int8_t>(random.next() % 4 == 0 ? -1 : opacity_class(share)));
    const SphereSet spheres = SphereSet::from_world(x, y, z, r).value();
    TransparentSpheres::Properties more;
    more.classes = classes;
    const auto divided = TransparentSpheres::divide(spheres, passing, Engine::wide, 1, more).value();
    for (int k = 0; k < 200; ++k) {
      Ray ray;
      ray.origin = to_float(unit * Vec3d{5 * random.next_double(), 2, 5 * random.next_double()});
      ray.direction = {float(random.next() % 3) - 1, float(random.next() % 3) - 1, 1};
      if (k % 3 == 0) ray.t_max = unit * 3 * random.next_double();
      if (k % 4 == 0) {
        ray.leaves = static_cast<std::int64_t>(random.next() % static_cast<unsigned>(count));
        ray.inside = k % 8 == 0;
      }
      const ScaledRay scaled(ray, spheres);
      std::vector<Crossing> expected;
      Hit opaque;
      for (std::int64_t id = 0; id < count; ++id) {
        const double t = sphere_hit(scaled, spheres.stored_centre(id), spheres.stored_radius(id));
        if (passing[static_cast<std::size_t>(id)] == 0)
          opaque.keep_nearer(t, id);
        else if (t < std::numeric_limits<double>::infinity())
          expected.push_back({t, id});
      }
      std::sort(expected.begin(), expected.end(),
                [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t < b.t : a.id < b.id; });
      const auto class_of = [&classes](std::int64_t id) {
        return classes.empty() ? -1 : int{classes[static_cast<std::size_t>(id)]};
      };
      std::vector<int> crossed;
      const auto is_of_crossed_class = [&](const Crossing& crossing) {
        const int its_class = class_of(crossing.id);
        if (its_class >= 0 && std::find(crossed.begin(), crossed.end(), its_class) != crossed.end()) return true;
        crossed.push_back(its_class);
        return false;
      };
      expected.erase(std::remove_if(expected.begin(), expected.end(), is_of_crossed_class), expected.end());
      std::vector<Crossing> found;
      divided->find_crossings(ray, found);
      ASSERT_EQ(found.size(), expected.size());
      OpticalDepth depth = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].t, expected[i].t);
        EXPECT_EQ(found[i].id, expected[i].id);
        if (class_of(found[i].id) < 0) depth = sum_of_depths(depth, optical_depth(divided->passing(found[i].id)));
      }
      double share = 1;
      for (int its_class = 0; its_class < kOpacityClasses; ++its_class)
        for (const Crossing& crossing : found)
          if (class_of(crossing.id) == its_class) share = share * divided->passing(crossing.id);
      share = opaque.found() ? 0 : share * transmittance(depth);
      EXPECT_EQ(divided->share(ray), (Vec3d{share, share, share}));
      EXPECT_EQ(divided->closest_opaque(ray).sphere_id, opaque.sphere_id);
      EXPECT_EQ(divided->closest_opaque(ray).t, opaque.t);
    }
  }
}

// Many rays at a time find what each finds alone, also before their start and behind it.
TEST(Transparency, crossings_of_many_rays_are_those_of_each) {
  SplitMix64 random(23);
  std::vector<double> x, y, z, r, passing;
  for (int i = 0; i < 300; ++i) {
    x.push_back(10 * random.next_double());
    y.push_back(10 * random.next_double());
    z.push_back(10 * random.next_double());
    r.push_back(0.7);
    passing.push_back(i % 3 == 0 ? 0 : 0.5);
  }
  const SphereSet spheres = SphereSet::from_world(x, y, z, r).value();
  const auto divided = TransparentSpheres::divide(spheres, passing, Engine::wide, 1).value();
  const auto one_by_one = TransparentSpheres::divide(spheres, passing, Engine::reference, 1).value();
  RayBatch rays;
  for (int i = 0; i < 500; ++i) {
    Ray ray;
    ray.origin = to_float(Vec3d{10 * random.next_double(), 10 * random.next_double(), 5});
    ray.direction = {float(random.next_double()) - 0.5F, float(random.next_double()) - 0.5F, 1};
    ray.t_min = i % 2 == 0 ? -20 * random.next_double() : 3 * random.next_double();
    ray.t_max = ray.t_min + 6 * random.next_double() - 0.5;
    if (i % 7 == 0) ray.t_max = ray.t_min;
    rays.push_back(ray);
  }
  std::vector<RayHit> found;
  divided->find_crossings(rays.span(), RayOrder::any, found);
  std::size_t next = 0;
  for (std::int64_t i = 0; i < rays.size(); ++i) {
    std::vector<Crossing> alone;
    one_by_one->find_crossings(rays.span().at(i), alone);
    for (const Crossing& crossing : alone) {
      ASSERT_LT(next, found.size());
      EXPECT_EQ(found[next].ray, i);
      EXPECT_EQ(found[next].t, crossing.t);
      EXPECT_EQ(found[next++].sphere_id, crossing.id);
    }
  }
  EXPECT_EQ(next, found.size());
  EXPECT_GT(next, 100U);
}

TEST(Transparency, a_transparent_picture_shows_what_gets_through) {
  // Two layers before nothing, and one before an opaque sphere.
  Scene scene = scene_of_layers({{{0, 0, 0}, 50, 0.5F, {1, 0, 0}}, {{0, 0, -200}, 80, 0.5F, {0, 1, 0}}});
  scene.background = {0.1, 0.2, 0.3};
  scene.camera.fov_deg = 1;
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = settings.height_px = 1;
  settings.transparent = true;
  const Tracer tracer = Tracer::build(scene.spheres, Engine::wide).value();
  const Film film = render(scene, tracer, settings).value().film;
  EXPECT_EQ(film.coverage[0], 0.75F);
  EXPECT_FLOAT_EQ(film.radiance[0].x, static_cast<float>(0.5 / 0.75));
  // The green sphere is seen through the red one.
  EXPECT_FLOAT_EQ(film.radiance[0].y, static_cast<float>(0.25 * 0.5 / 0.75));
  EXPECT_EQ(film.radiance[0].z, 0);
}

}  // namespace
}  // namespace bihive
