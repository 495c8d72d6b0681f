// Camera moves by the pointer, in worlds of any size.
// ctest: asan-long
#include "bihive/viewer/orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

constexpr PictureSizePx kSize{640, 360};
constexpr double kScales[] = {1e-20, 1, 1e20};

Camera camera_in(double scale) {
  return {scale * Vec3d{30, 20, 100}, scale * Vec3d{3, -4, 5}, {0, 1, 0}, 30};
}

double distance_of(const Camera& camera) {
  return length(camera.eye - camera.look_at);
}

// The sine of the angle between the view and up.
double off_the_pole(const Camera& camera) {
  return length(cross(normalized(camera.eye - camera.look_at), normalized(camera.up)));
}

// The picture position of a point of the world.
Vec3d seen(const Camera& camera, Vec3d world) {
  const PixelPlaces places(camera, kSize.width, kSize.height);
  const Vec3d point = places.from_eye(world);
  return {places.x_px(point), places.y_px(point), point.z};
}

TEST(Orbited, keeps_the_distance_and_what_is_looked_at) {
  SplitMix64 rng(1);
  for (const double scale : kScales) {
    Camera camera = camera_in(scale);
    const double distance = distance_of(camera);
    for (int i = 0; i < 300; ++i) {
      camera = orbited(camera, 200 * rng.next_double() - 100, 200 * rng.next_double() - 100, kSize);
      ASSERT_TRUE(check_camera(camera));
      ASSERT_NEAR(distance_of(camera) / distance, 1, 1e-12) << scale;
    }
    EXPECT_EQ(camera.look_at, camera_in(scale).look_at);
    EXPECT_EQ(camera.up, (Vec3d{0, 1, 0}));
  }
}

TEST(Orbited, the_scene_follows_the_pointer) {
  const Camera camera = camera_in(1);
  const Vec3d towards_the_eye = camera.look_at + 0.2 * (camera.eye - camera.look_at);
  const Vec3d before = seen(camera, towards_the_eye);
  const Vec3d right = seen(orbited(camera, 40, 0, kSize), towards_the_eye);
  EXPECT_GT(right.x, before.x + 5);
  const Vec3d down = seen(orbited(camera, 0, 40, kSize), towards_the_eye);
  EXPECT_GT(down.y, before.y + 5);
  EXPECT_NEAR(down.x, before.x, 1e-6);
}

TEST(Orbited, half_a_turn_along_the_shorter_side_and_back) {
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 30};
  Camera turned = camera;
  for (int i = 0; i < 6; ++i) turned = orbited(turned, 60, 0, kSize);
  EXPECT_NEAR(turned.eye.z, -10, 1e-9);
  for (int i = 0; i < 6; ++i) turned = orbited(turned, -60, 0, kSize);
  EXPECT_NEAR(length(turned.eye - camera.eye), 0, 1e-9);
}

TEST(Orbited, stops_before_the_pole_and_comes_back) {
  for (const double direction : {1.0, -1.0}) {
    Camera camera = camera_in(1);
    for (int i = 0; i < 50; ++i) camera = orbited(camera, 0, direction * 50, kSize);
    EXPECT_NEAR(off_the_pole(camera), std::sin(std::acos(-1.0) / 180), 1e-6);
    EXPECT_GT(direction * (camera.eye - camera.look_at).y, 0);
    // The picture's right side has not changed sides.
    const Vec3d right = PixelRays(camera, 10, 10).right();
    EXPECT_GT(dot(right, PixelRays(camera_in(1), 10, 10).right()), 0);
    camera = orbited(camera, 0, -direction * 100, kSize);
    EXPECT_GT(off_the_pole(camera), 0.5);
  }
  // A single huge move does not go over the pole either.
  EXPECT_GT(orbited(camera_in(1), 0, 1e6, kSize).eye.y, 0);
}

TEST(Orbited, a_camera_at_the_pole_stays_there_until_it_is_moved_away) {
  const Camera camera{{1e-4, 10, 0}, {0, 0, 0}, {0, 1, 0}, 30};
  const Camera up = orbited(camera, 0, 20, kSize);
  EXPECT_NEAR(length(up.eye - camera.eye), 0, 1e-6);
  EXPECT_GT(off_the_pole(orbited(camera, 0, -40, kSize)), 0.3);
}

TEST(Panned, what_is_looked_at_follows_the_pointer) {
  for (const double scale : kScales) {
    const Camera camera = camera_in(scale);
    const Camera moved = panned(camera, 31, -17, kSize);
    const Vec3d before = seen(camera, camera.look_at), after = seen(moved, camera.look_at);
    EXPECT_NEAR(after.x - before.x, 31, 0.01) << scale;
    EXPECT_NEAR(after.y - before.y, -17, 0.01) << scale;
    EXPECT_NEAR(distance_of(moved) / distance_of(camera), 1, 1e-12);
  }
}

TEST(Panned, stays_where_single_precision_ends) {
  Camera camera{{3.4e38, 0, 1e38}, {3.4e38, 0, 0}, {0, 1, 0}, 30};
  camera = panned(camera, -1000, 0, kSize);
  EXPECT_TRUE(check_camera(camera));
  EXPECT_EQ(camera.eye.x, 3.4e38);
}

TEST(Zoomed, keeps_the_point_under_the_pointer) {
  for (const double scale : kScales) {
    const Camera camera = camera_in(scale);
    const DistanceLimits limits = distance_limits(camera, scale * 50);
    for (const double factor : {1.1, 2.0, 0.5, 0.9}) {
      const Vec3d anchor = point_under(camera, 500, 80, kSize);
      const Vec3d before = seen(camera, anchor);
      EXPECT_NEAR(before.x, 500, 0.01);
      EXPECT_NEAR(before.y, 80, 0.01);
      const Camera moved = zoomed(camera, factor, anchor, limits);
      const Vec3d after = seen(moved, anchor);
      EXPECT_NEAR(after.x, 500, 0.01) << scale << " " << factor;
      EXPECT_NEAR(after.y, 80, 0.01);
      EXPECT_NEAR(before.z / after.z, factor, 1e-4);
      EXPECT_NEAR(distance_of(camera) / distance_of(moved), factor, 1e-9);
    }
  }
}

TEST(Orthographic, moves_follow_the_pointer_and_the_eye_keeps_its_distance) {
  for (const double scale : kScales) {
    const Camera camera = with_projection(camera_in(scale), Projection::orthographic);
    const DistanceLimits limits = distance_limits(camera, scale * 50);
    const Vec3d panned_to = seen(panned(camera, 31, -17, kSize), camera.look_at);
    EXPECT_NEAR(panned_to.x - seen(camera, camera.look_at).x, 31, 0.01) << scale;
    const Vec3d anchor = point_under(camera, 500, 80, kSize);
    for (const double factor : {2.0, 0.5}) {
      const Camera moved = zoomed(camera, factor, anchor, limits);
      const Vec3d after = seen(moved, anchor);
      EXPECT_NEAR(after.x, 500, 0.01) << scale << " " << factor;
      EXPECT_NEAR(after.y, 80, 0.01);
      EXPECT_NEAR(camera.shorter_side / moved.shorter_side, factor, 1e-12);
      EXPECT_NEAR(distance_of(moved) / distance_of(camera), 1, 1e-9);
    }
  }
}

TEST(Zoomed, ends_at_the_limits_and_comes_back) {
  for (const double scale : kScales) {
    Camera camera = camera_in(scale);
    const DistanceLimits limits = distance_limits(camera, scale * 50);
    for (int i = 0; i < 100; ++i) camera = zoomed(camera, 1.5, camera.look_at, limits);
    EXPECT_NEAR(distance_of(camera) / limits.nearest, 1, 1e-9);
    for (int i = 0; i < 200; ++i) camera = zoomed(camera, 0.7, camera.look_at, limits);
    EXPECT_NEAR(distance_of(camera) / limits.farthest, 1, 1e-9);
    EXPECT_TRUE(check_camera(camera));

    // From beyond a limit the camera goes no further, but may come back.
    const DistanceLimits narrow{2 * limits.farthest, 3 * limits.farthest};
    EXPECT_EQ(zoomed(camera, 2, camera.look_at, narrow).eye, camera.eye);
    EXPECT_GT(distance_of(zoomed(camera, 0.5, camera.look_at, narrow)), 1.9 * distance_of(camera));
  }
}

TEST(DistanceLimits, far_from_the_origin_the_eye_keeps_off_what_binary32_cannot_place) {
  const Camera camera{{1e6, 0, 10}, {1e6, 0, 0}, {0, 1, 0}, 30};
  const double step = std::numeric_limits<float>::epsilon() * 1e6;
  EXPECT_GT(distance_limits(camera, 1).nearest, 500 * step);
}

}  // namespace
}  // namespace bihive
