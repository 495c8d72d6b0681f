// Pixel rays and automatic framing.
// ctest: asan-long
#include "bihive/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/math/rng.h"
#include "bihive/scene/framing.h"

namespace bihive {
namespace {

TEST(PixelRays, centre_looks_ahead_and_the_angle_spans_the_shorter_side) {
  const Camera camera{{0, 0, 100}, {0, 0, 0}, {0, 1, 0}, 30};
  const PixelRays wide(camera, 200, 100);
  EXPECT_EQ(wide.at(100, 50).direction, (Vec3f{0, 0, -1}));
  EXPECT_EQ(wide.at(100, 50).origin, (Vec3f{0, 0, 100}));
  const Vec3d top = to_double(wide.at(100, 0).direction);
  EXPECT_NEAR(top.y / -top.z, std::tan(15 * std::acos(-1.0) / 180), 1e-6);
  const PixelRays tall(camera, 100, 200);
  const Vec3d right = to_double(tall.at(100, 100).direction);
  EXPECT_NEAR(right.x / -right.z, std::tan(15 * std::acos(-1.0) / 180), 1e-6);
  EXPECT_GT(right.x, 0) << "x grows to the right";
}

TEST(PixelRays, directions_have_length_1) {
  const PixelRays rays({{3, 1, 2}, {-4, 5, 6}, {0, 0, 1}, 100}, 64, 48);
  for (int y = 0; y < 48; y += 5)
    for (int x = 0; x < 64; x += 5) EXPECT_NEAR(length(to_double(rays.at(x, y).direction)), 1, 1e-7);
}

TEST(PixelPlaces, are_where_the_rays_go) {
  const Camera camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70};
  const PixelRays rays(camera, 64, 48);
  const PixelPlaces places(camera, 64, 48);
  for (double y = 0; y <= 48; y += 3.7)
    for (double x = 0; x <= 64; x += 4.1) {
      const Ray ray = rays.at(x, y);
      const Vec3d seen = places.from_eye(to_double(ray.origin) + 12.5 * to_double(ray.direction));
      EXPECT_NEAR(places.x_px(seen), x, 1e-4);
      EXPECT_NEAR(places.y_px(seen), y, 1e-4);
      EXPECT_GT(seen.z, 0);
    }
  EXPECT_LT(places.from_eye(camera.eye + (camera.eye - camera.look_at)).z, 0) << "behind the eye";
}

Camera orthographic_camera() {
  Camera camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70};
  camera.projection = Projection::orthographic;
  camera.shorter_side = 7;
  return camera;
}

TEST(PixelRays, orthographic_rays_are_parallel_bit_for_bit_and_start_on_one_plane) {
  const Camera camera = orthographic_camera();
  const PixelRays rays(camera, 64, 48);
  const Vec3d forward = normalized(camera.look_at - camera.eye);
  const Vec3f direction = rays.at(0, 0).direction;
  EXPECT_NEAR(length(to_double(direction) - forward), 0, 1e-7);
  for (double y = 0; y <= 48; y += 3.7)
    for (double x = 0; x <= 64; x += 4.1) {
      EXPECT_EQ(rays.at(x, y).direction, direction);
      EXPECT_NEAR(dot(to_double(rays.at(x, y).origin) - camera.eye, forward), 0, 2e-6);
    }
  EXPECT_NEAR(length(to_double(rays.at(32, 0).origin) - to_double(rays.at(32, 48).origin)), 7, 1e-5);
  EXPECT_NEAR(length(to_double(rays.at(8, 24).origin) - to_double(rays.at(56, 24).origin)), 7, 1e-5);
  EXPECT_EQ(rays.at(32, 24).origin, (Vec3f{3, 1, 2}));
}

TEST(PixelPlaces, are_where_parallel_rays_go) {
  const Camera camera = orthographic_camera();
  const PixelRays rays(camera, 64, 48);
  const PixelPlaces places(camera, 64, 48);
  for (double y = 0; y <= 48; y += 3.7)
    for (double x = 0; x <= 64; x += 4.1) {
      const Ray ray = rays.at(x, y);
      for (const double t : {0.5, 20.0}) {
        const Vec3d seen = places.from_eye(to_double(ray.origin) + t * to_double(ray.direction));
        EXPECT_NEAR(places.x_px(seen), x, 1e-4);
        EXPECT_NEAR(places.y_px(seen), y, 1e-4);
        EXPECT_NEAR(seen.z, t, 1e-5);
      }
    }
}

TEST(Camera, another_projection_keeps_the_size_at_look_at) {
  const Camera camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70};
  const Camera parallel = with_projection(camera, Projection::orthographic);
  const PixelPlaces before(camera, 64, 48), after(parallel, 64, 48);
  const Vec3d aside = normalized(cross(camera.look_at - camera.eye, camera.up));
  const Vec3d seen = camera.look_at + 2.5 * aside;
  EXPECT_NEAR(before.x_px(before.from_eye(seen)), after.x_px(after.from_eye(seen)), 1e-9);
  EXPECT_NEAR(with_projection(parallel, Projection::perspective).fov_deg, 70, 1e-12);
}

TEST(Camera, enlarged_changes_the_size_alone) {
  for (const Camera& camera : {Camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70}, orthographic_camera()}) {
    const Camera larger = enlarged(camera, 2.5);
    EXPECT_EQ(larger.eye, camera.eye);
    const PixelPlaces before(camera, 64, 48), after(larger, 64, 48);
    for (const Vec3d seen : {Vec3d{-2, 4, 5}, Vec3d{-9, 6, 9}, Vec3d{1, 4, 1}}) {
      const double x = before.x_px(before.from_eye(seen)) - 32;
      EXPECT_NEAR(after.x_px(after.from_eye(seen)) - 32, 2.5 * x, 1e-9);
    }
    EXPECT_EQ(enlarged(camera, 1), camera);
  }
}

TEST(CheckCamera, the_shorter_side_counts_for_orthographic_cameras_alone) {
  for (const double side : {0.0, -1.0, 1e39, std::numeric_limits<double>::quiet_NaN()}) {
    Camera camera = orthographic_camera();
    camera.shorter_side = side;
    EXPECT_FALSE(check_camera(camera)) << side;
    camera.projection = Projection::perspective;
    EXPECT_TRUE(check_camera(camera)) << side;
  }
}

TEST(CheckCamera, names_what_is_wrong) {
  const Camera good;
  EXPECT_TRUE(check_camera(good));
  Camera camera = good;
  camera.look_at = camera.eye;
  EXPECT_FALSE(check_camera(camera));
  camera = good;
  camera.up = {0, 0, 5};
  EXPECT_FALSE(check_camera(camera)) << "parallel to the view";
  camera = good;
  camera.up = {0, 0, 0};
  EXPECT_FALSE(check_camera(camera));
  for (const double fov : {0.0, 180.0, -3.0, std::numeric_limits<double>::quiet_NaN()}) {
    camera = good;
    camera.fov_deg = fov;
    EXPECT_FALSE(check_camera(camera)) << fov;
  }
  camera = good;
  camera.eye.x = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(check_camera(camera));
  camera.eye.x = 1e39;
  EXPECT_FALSE(check_camera(camera)) << "a ray's origin is binary32";
}

// Every sphere's silhouette must lie inside the picture, and one silhouette must come close to the border.
class Framing : public ::testing::TestWithParam<std::tuple<ViewFrom, double>> {};

TEST_P(Framing, whole_set_in_view_and_as_large_as_it_fits) {
  const auto [from, unit] = GetParam();
  SplitMix64 random(7);
  std::vector<double> x, y, z, r;
  for (int i = 0; i < 100; ++i) {
    x.push_back(unit * (random.next_double() * 3 + 50));
    y.push_back(unit * random.next_double());
    z.push_back(unit * random.next_double() * 2);
    r.push_back(unit * random.next_double() * 0.2);
  }
  const SphereSet set = SphereSet::from_world(x, y, z, r).value();
  const Camera camera = frame_spheres(set, from, 30, 320, 200);
  ASSERT_TRUE(check_camera(camera));

  const Vec3d forward = normalized(camera.look_at - camera.eye);
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  const double tangent = std::tan(15 * std::acos(-1.0) / 180);
  double used = 0;
  for (std::int64_t id = 0; id < set.size(); ++id) {
    const Vec3d c = set.centre(id) - camera.eye;
    const double depth = dot(c, forward);
    ASSERT_GT(depth, set.radius(id));
    // The angle of a sphere's silhouette on either side, in the plane of the axis and the view.
    for (const auto& [axis, limit] : {std::pair{right, tangent * 320 / 200}, std::pair{up, tangent}}) {
      const double flat = std::hypot(depth, dot(c, axis));
      const double edge = std::tan(std::atan2(std::abs(dot(c, axis)), depth) + std::asin(set.radius(id) / flat));
      ASSERT_LE(edge, limit) << id;
      used = std::max(used, edge / limit);
    }
  }
  EXPECT_GT(used, 0.9) << "no border is reached";
}

TEST_P(Framing, orthographic_fits_the_silhouettes_and_starts_in_front) {
  const auto [from, unit] = GetParam();
  SplitMix64 random(8);
  std::vector<double> x, y, z, r;
  for (int i = 0; i < 100; ++i) {
    x.push_back(unit * (random.next_double() * 3 + 50));
    y.push_back(unit * random.next_double());
    z.push_back(unit * random.next_double() * 2);
    r.push_back(unit * random.next_double() * 0.2);
  }
  const SphereSet set = SphereSet::from_world(x, y, z, r).value();
  for (const double fov : {1.0, 30.0, 179.0}) {
    const Camera camera = frame_spheres(set, side_of(from), {fov, Projection::orthographic}, 320, 200);
    ASSERT_TRUE(check_camera(camera));
    const PixelPlaces places(camera, 320, 200);
    double border = 160;
    for (std::int64_t id = 0; id < set.size(); ++id) {
      const Vec3d seen = places.from_eye(set.centre(id));
      const double radius_px = set.radius(id) / camera.shorter_side * 200;
      border = std::min({border, places.x_px(seen) - radius_px, 320 - places.x_px(seen) - radius_px});
      border = std::min({border, places.y_px(seen) - radius_px, 200 - places.y_px(seen) - radius_px});
      // No origin may lie in a sphere, though it is rounded.
      for (const double share : {0.0, 0.3, 0.7, 1.0}) {
        const Vec3d origin = to_double(PixelRays(camera, 320, 200).at(320 * share, 200 * share).origin);
        ASSERT_GT(dot(set.centre(id) - origin, normalized(camera.look_at - camera.eye)), set.radius(id));
      }
    }
    // The margin is 4 % of the side that bounds the set.
    EXPECT_GT(border, 0.04 * 200 - 0.01);
    EXPECT_LT(border, 0.04 * 320 + 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(sides, Framing,
                         ::testing::Combine(::testing::Values(ViewFrom::front, ViewFrom::back, ViewFrom::left,
                                                              ViewFrom::right, ViewFrom::top, ViewFrom::bottom,
                                                              ViewFrom::iso),
                                            ::testing::Values(1.0, 1e-20, 1e20)));

TEST(Framing, single_points_and_empty_sets_are_seen_from_somewhere) {
  EXPECT_TRUE(check_camera(frame_spheres({}, ViewFrom::iso, 30, 4, 3)));
  const SphereSet point = SphereSet::from_world(std::vector<double>{5}, {6}, {7}, {0}).value();
  const Camera camera = frame_spheres(point, ViewFrom::front, 30, 4, 3);
  EXPECT_TRUE(check_camera(camera));
  EXPECT_EQ(camera.look_at, (Vec3d{5, 6, 7}));
}

TEST(Light, is_above_left_and_behind) {
  const PointLight light = light_behind({{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 30});
  EXPECT_LT(light.position.x, 0);
  EXPECT_GT(light.position.y, 0);
  EXPECT_GT(light.position.z, 10);
}

}  // namespace
}  // namespace bihive
