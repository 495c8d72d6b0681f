// Clips: what is cut away is absent for every ray, and caps close the cut.
#include "bihive/scene/clips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/render/scene_hit.h"
#include "bihive/render/shading.h"
#include "bihive/render/surface.h"
#include "bihive/render/tracer.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/looks.h"
#include "bihive/scene/scene_file.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;

struct Ball {
  double x, y, z, r;
};

Scene scene_of(const std::vector<Ball>& balls) {
  std::vector<double> x, y, z, r;
  for (const Ball& ball : balls) {
    x.push_back(ball.x);
    y.push_back(ball.y);
    z.push_back(ball.z);
    r.push_back(ball.r);
  }
  Scene scene;
  scene.spheres = SphereSet::from_world(x, y, z, r).value();
  return scene;
}

Scene clipped(const std::vector<Ball>& balls, const std::vector<Clip>& clips, const std::string& select = "all") {
  Scene scene = scene_of(balls);
  Look look{select, {}};
  for (const Clip& clip : clips) look.actions.emplace_back(AddClip{clip});
  EXPECT_TRUE(apply_looks(scene, {look}));
  return scene;
}

Ray ray_from(Vec3f origin, Vec3f direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  return ray;
}

constexpr PlaneClip kUpperHalf{{0, 0, 1}, 0};

TEST(Clips, TheCapOfAPlaneHasTheAreaOfItsCircle) {
  // A square of 2.5 units has 500 pixels a side. The border of the cap crosses at most 8 times its radius in pixels,
  // and by chance half of these count; so the area is right to a fraction of a pixel's width along the border.
  constexpr int kSide = 500;
  constexpr double kPixel = 2.5 / kSide;
  for (const double d : {-0.75, -0.2, 0.0, 0.3, 0.9}) {
    const Scene scene = clipped({{0, 0, 0, 1}}, {PlaneClip{{0, 0, 3}, 3 * d}});
    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    std::int64_t on_cap = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const auto place = [](int i) { return static_cast<float>((i + 0.5) * kPixel - 1.25); };
        const Ray ray = ray_from({place(x), place(y), 5}, {0, 0, -1});
        const SceneHit hit = scene_hit(scene, tracer, ray);
        if (!hit.found()) continue;
        if (surface_at(scene, ray, hit).normal == Vec3d{0, 0, 1} && std::abs(hit.t - (5 - d)) < 1e-14) ++on_cap;
      }
    const double area = static_cast<double>(on_cap) * kPixel * kPixel;
    const double rim = 2 * M_PI * std::sqrt(1 - d * d);
    EXPECT_NEAR(area, M_PI * (1 - d * d), 0.1 * rim * kPixel) << d;
  }
}

TEST(Clips, ABoxAndASphereLeaveTheirWalls) {
  // A ray along -z through the middle of a unit ball.
  const Ray ray = ray_from({0, 0, 5}, {0, 0, -1});
  const auto surface = [&](const Clip& clip) {
    const Scene scene = clipped({{0, 0, 0, 1}}, {clip});
    return surface_at(scene, ray, scene_hit(scene, Tracer::build(scene, Engine::wide).value(), ray));
  };
  const Surface floor = surface(BoxClip{{-0.5, -0.5, -0.25}, {0.5, 0.5, 9}});
  EXPECT_EQ(floor.origin.z, -0.25f);
  EXPECT_EQ(floor.normal, (Vec3d{0, 0, 1}));
  EXPECT_FALSE(floor.from_inside);
  const Surface bowl = surface(SphereClip{{0, 0, 1}, 1.5});
  EXPECT_EQ(bowl.origin.z, -0.5f);
  EXPECT_EQ(bowl.normal, (Vec3d{0, 0, 1}));
  // A hole inside: the ray meets the ball first, and a ray that starts in the hole meets the wall.
  const Scene hollow = clipped({{0, 0, 0, 1}}, {BoxClip{{-0.5, -0.5, -0.25}, {0.5, 0.5, 0.25}}});
  const Tracer tracer = Tracer::build(hollow, Engine::wide).value();
  EXPECT_EQ(tracer.closest_hit(ray).t, 4);
  EXPECT_EQ(tracer.closest_hit(ray_from({0, 0, 0}, {0, 0, -1})).t, 0.25);
}

TEST(Clips, WhatIsCutAwayThrowsNoShadow) {
  const Scene scene = clipped({{0, 0, 0, 1}}, {PlaneClip{{1, 0, 0}, 0}});
  for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
    const Tracer tracer = Tracer::build(scene, engine).value();
    EXPECT_TRUE(tracer.occluded(ray_from({-0.5f, 0, -3}, {0, 0, 1})));
    EXPECT_FALSE(tracer.occluded(ray_from({0.5f, 0, -3}, {0, 0, 1})));
    // A short segment inside the ball's place, across the cap.
    Ray across = ray_from({0.1f, 0, 0}, {-0.2f, 0, 0});
    across.t_max = 1;
    EXPECT_TRUE(tracer.occluded(across));
    across.t_max = 0.25;
    EXPECT_FALSE(tracer.occluded(across));
  }
}

TEST(Clips, ACapInTheOpenSeesAllOfItsSurroundings) {
  // Overlapping balls with one cap, which the plane cuts at every angle.
  for (const Vec3d normal : {Vec3d{0, 0, 1}, Vec3d{0.3, -0.7, 0.2}, Vec3d{1e-9, 5, 1}}) {
    const Scene scene = clipped({{0, 0, 0, 1}, {0.7, 0.1, 0.2, 1.1}, {-0.4, 0.3, 0.1, 0.8}}, {PlaneClip{normal, 0.01}});
    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    const Vec3d n = normalized(normal);
    const PlaneAxes axes = plane_axes(n);
    int caps = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3d start = 4.0 * n + (i % 20 * 0.1 - 1.0) * axes.u + (i / 20 * 0.1 - 1.0) * axes.v;
      const Ray ray = ray_from(to_float(start), to_float(-n));
      const SceneHit hit = scene_hit(scene, tracer, ray);
      if (!hit.found()) continue;
      const Surface surface = surface_at(scene, ray, hit);
      if (dot(surface.normal, n) < 1 - 1e-12) continue;
      ++caps;
      std::vector<Vec3f> directions;
      for (int k = 0; k < 64; ++k) {
        const double angle = 0.1 * k;
        directions.push_back(to_float(std::cos(angle) * axes.u + std::sin(angle) * axes.v + (0.001 + 0.02 * k) * n));
      }
      std::int64_t rays = 0;
      EXPECT_EQ(ambient_visibility(scene, tracer, surface, directions, 1e9, rays), (Vec3d{1, 1, 1}));
      EXPECT_EQ(rays, 64);
    }
    EXPECT_GT(caps, 100);
  }
}

TEST(Clips, WhereCapsOverlapTheSmallerIdWins) {
  for (const bool swapped : {false, true}) {
    std::vector<Ball> balls{{0, 0, 0, 1}, {0.5, 0, 0.125, 1.3}};
    if (swapped) std::swap(balls[0], balls[1]);
    const Scene scene = clipped(balls, {PlaneClip{{0.1, 0.2, 0.7}, 0.03}});
    for (const Engine engine : {Engine::wide, Engine::reference, Engine::brute}) {
      const Tracer tracer = Tracer::build(scene, engine).value();
      for (int i = 0; i < 20; ++i)
        EXPECT_EQ(tracer.closest_hit(ray_from({0.02f * static_cast<float>(i), 0.1f, 3}, {0, 0, -1})).sphere_id, 0);
    }
  }
}

TEST(Clips, AClipActsOnItsSelectionAlone) {
  const Scene scene = clipped({{0, 0, 0, 1}, {5, 0, 0, 1}}, {kUpperHalf}, "x > 2");
  const Tracer tracer = Tracer::build(scene, Engine::wide).value();
  EXPECT_EQ(tracer.closest_hit(ray_from({0, 0, 5}, {0, 0, -1})).t, 4);
  EXPECT_EQ(tracer.closest_hit(ray_from({5, 0, 5}, {0, 0, -1})).t, 5);
}

TEST(Clips, ASphereInsideIsGoneAndTheCameraDoesNotLookForIt) {
  const Scene scene = clipped({{0, 0, 0, 1}, {0, 0, 50, 1}}, {PlaneClip{{0, 0, 1}, 10}});
  EXPECT_EQ(RemainingSpheres(scene).set().size(), 1);
  const Scene cut = clipped({{0, 0, 0, 1}, {0, 0, 50, 1}}, {kUpperHalf}, "index 0");
  EXPECT_EQ(&RemainingSpheres(cut).set(), &cut.spheres) << "none is gone, so none is copied";
  const Scene whole = scene_of({{0, 0, 0, 1}});
  EXPECT_EQ(&RemainingSpheres(whole).set(), &whole.spheres);
  EXPECT_FALSE(Tracer::build(scene, Engine::wide).value().occluded(ray_from({3, 0, 50}, {-1, 0, 0})));
}

TEST(Clips, ATransparentSphereIsCrossedOnce) {
  Scene scene = clipped({{0, 0, 0, 1}, {0, 0, 0, 0.5}}, {BoxClip{{-9, -9, -0.25}, {9, 9, 0.25}}}, "r > 0.7");
  scene.spheres.attributes().opacity = {0.25f, 1};
  const Transparency parts = Transparency::of(scene, OpacityRule::once, Engine::wide, 1).value();
  std::vector<Crossing> crossings;
  parts.to_eye->find_crossings(ray_from({0.75f, 0, 5}, {0, 0, -1}), crossings);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(crossings[0].t, 5 - std::sqrt(1 - 0.75 * 0.75), 1e-12);
  EXPECT_NEAR(parts.to_light->share(ray_from({0.75f, 0, 5}, {0, 0, -1})).x, 0.75, 2e-7);  // fixed point
  EXPECT_EQ(parts.to_light->share(ray_from({0.9f, -5, 0}, {0, 1, 0})).x, 1);
  EXPECT_EQ(parts.to_light->share(ray_from({0.1f, -5, 0}, {0, 1, 0})).x, 0);
}

TEST(Clips, ARayThroughACutGlassBallLeavesThroughItsOtherSide) {
  const Scene scene = clipped({{0, 0, 0, 1}}, {kUpperHalf});
  const Tracer tracer = Tracer::build(scene, Engine::wide).value();
  Ray in = ray_from({0.3f, 0, 0}, {0.1f, 0, -1});
  in.leaves = 0;
  in.inside = true;
  EXPECT_GT(tracer.closest_hit(in).t, 0.9);
  // From the round side upward it leaves by the cap, and outward it meets nothing.
  Ray up = ray_from({0, 0, -1}, {0, 0, 1});
  up.leaves = 0;
  up.inside = true;
  EXPECT_EQ(tracer.closest_hit(up).t, 1);
  up.inside = false;
  EXPECT_FALSE(tracer.closest_hit(up).found());
}

TEST(ClipText, IsReadOrRefused) {
  EXPECT_EQ(clip_from_text("plane:0,-2,1e3,4.5").value(), Clip(PlaneClip{{0, -2, 1000}, 4.5}));
  EXPECT_EQ(clip_from_text("box:1,2,3,-1,5,0").value(), Clip(BoxClip{{-1, 2, 0}, {1, 5, 3}}));
  EXPECT_EQ(clip_from_text("sphere:1,2,3,4").value(), Clip(SphereClip{{1, 2, 3}, 4}));
  for (const char* bad : {"", "plane", "plane:", "plane:1,2,3", "plane:1,2,3,4,5", "plane:0,0,0,1", "plane:1,2,x,3",
                          "plane:nan,0,0,1", "plane:1,0,0,inf", "box:0,0,0,1,1,0", "box:0,0,0,1,1", "sphere:0,0,0,0",
                          "sphere:0,0,0,-1", "cone:1,2,3,4", "plane 1,2,3,4"})
    EXPECT_FALSE(clip_from_text(bad)) << bad;
  EXPECT_THAT(clip_from_text("cone:1").error().message, HasSubstr("plane:NX,NY,NZ,D, box:"));
  EXPECT_THAT(clip_from_text("box:0,0,0,1,0,1").error().message, HasSubstr("not along y"));
}

TEST(ClipLooks, EqualClipsAreOneAndHiddenSpheresTakeTheirsAlong) {
  Scene scene = scene_of({{0, 0, 0, 1}, {5, 0, 0, 1}, {9, 0, 0, 1}});
  const SphereClip ball{{9, 0, 0}, 0.5};
  ASSERT_TRUE(apply_looks(scene, {{"x < 1", {AddClip{kUpperHalf}}},
                                  {"x > 1", {AddClip{kUpperHalf}, AddClip{ball}}},
                                  {"x = 0", {SetShown{false}}}}));
  ASSERT_EQ(scene.clips.size(), 2u);
  EXPECT_EQ(scene.spheres.attributes().clips, (std::vector<std::uint64_t>{3, 3}));
}

TEST(ClipLooks, NothingMustNotBeLeft) {
  Scene scene = scene_of({{0, 0, 5, 1}});
  EXPECT_THAT(apply_looks(scene, {{"all", {AddClip{kUpperHalf}}}}).error().message, HasSubstr("cut away"));
  EXPECT_TRUE(scene.clips.empty());
  Look many{"all", {}};
  for (int i = 0; i <= kMostClips; ++i) many.actions.emplace_back(AddClip{PlaneClip{{0, 0, 1}, 10.0 + i}});
  EXPECT_THAT(apply_looks(scene, {many}).error().message, HasSubstr("64"));
}

TEST(ClipFile, ClipsComeBack) {
  Scene scene = clipped(
      {{0, 0, 0, 1}, {0, 0, -3, 1}},
      {PlaneClip{{0.1, 1e-30, -3}, 0.25}, BoxClip{{-1, -2, -3}, {0.5, 1.0 / 3, 9}}, SphereClip{{0.1, 0.2, 0.3}, 0.7}},
      "z = 0");
  scene.name = "a.json";
  const std::string text = scene_to_json(scene);
  const Result<LoadedScene> back = parse_scene(text, "a.json", {});
  ASSERT_TRUE(back) << back.error().to_string();
  EXPECT_EQ(back->scene.clips, scene.clips);
  EXPECT_EQ(back->scene.spheres.attributes().clips, (std::vector<std::uint64_t>{7, 0}));
  EXPECT_EQ(scene_to_json(back->scene), text);
}

TEST(ClipFile, LooksTakeClipsAndErrorsNameThePlace) {
  const auto loaded = parse_scene(
      R"({"bihive_scene": 2, "spheres": [[0,0,0,1]], "looks": [{"clip": [{"plane": {"normal": [0,0,1], "offset": 0}}]}]})",
      "a.json", {});
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_EQ(loaded->scene.clips, std::vector<Clip>{kUpperHalf});
  const auto error = [](const std::string& rest) {
    return parse_scene(R"({"bihive_scene": 2, )" + rest + "}", "a.json", {}).error().to_string();
  };
  EXPECT_THAT(error(R"("spheres": [[0,0,0,1]], "clips": [{"cone": 1}])"), HasSubstr("/clips/0"));
  EXPECT_THAT(error(R"("spheres": [[0,0,0,1]], "clips": [{"sphere": {"centre": [0,0,0], "radius": 0}}])"),
              HasSubstr("/clips/0/sphere/radius: expected a number above 0"));
  EXPECT_THAT(error(R"("spheres": [[0,0,0,1]], "clips": [{"plane": {"normal": [0,0,0], "offset": 0}}])"),
              HasSubstr("/clips/0: the normal"));
  EXPECT_THAT(error(R"("spheres": [{"centre": [0,0,0], "radius": 1, "clips": [0]}])"),
              HasSubstr("/spheres/0/clips: there is no clip 0"));
  EXPECT_THAT(parse_scene(R"({"bihive_scene": 1, "spheres": [[0,0,0,1]], "clips": []})", "a.json", {}).error().message,
              HasSubstr("expected no such key in version 1"));
}

TEST(ClipFile, RecentredClipsMoveWithTheSpheres) {
  ReadOptions options;
  options.recenter = true;
  const auto loaded = parse_scene(
      R"({"bihive_scene": 2, "clips": [{"plane": {"normal": [0,0,2], "offset": 10}}], "spheres": [{"centre": [0,0,5], "radius": 1, "clips": [0]}]})",
      "a.json", options);
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_EQ(loaded->scene.clips, (std::vector<Clip>{PlaneClip{{0, 0, 2}, 0}}));
}

}  // namespace
}  // namespace bihive
