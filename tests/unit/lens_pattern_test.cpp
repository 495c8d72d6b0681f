// The places on the lens, and the rays through them.
// ctest: asan-long
#include "bihive/scene/lens_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bihive/math/rng.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

TEST(LensPattern, one_sample_looks_through_the_middle) {
  const std::vector<CameraSample> samples = camera_samples(1);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].lens.x, 0);
  EXPECT_EQ(samples[0].lens.y, 0);
  EXPECT_EQ(samples[0].place.x, 0.5);
}

TEST(LensPattern, fills_the_disc_evenly) {
  for (const int n : {4, 9, 16, 64, 100, 1000}) {
    const std::vector<CameraSample> samples = camera_samples(n);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(n));
    Vec3d sum;
    double nearest = 4;
    std::set<int> rings;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const LensPlace lens = samples[i].lens;
      EXPECT_EQ(samples[i].place.x, sample_place(static_cast<int>(i), n).x);
      EXPECT_EQ(samples[i].place.y, sample_place(static_cast<int>(i), n).y);
      const double square = lens.x * lens.x + lens.y * lens.y;
      ASSERT_LT(square, 1);
      rings.insert(static_cast<int>(square * n));
      sum = sum + Vec3d{lens.x, lens.y, 0};
      for (std::size_t k = 0; k < i; ++k)
        nearest = std::min(nearest, std::hypot(lens.x - samples[k].lens.x, lens.y - samples[k].lens.y));
    }
    EXPECT_EQ(rings.size(), static_cast<std::size_t>(n)) << "one place in each ring of equal area";
    EXPECT_LT(length(sum) / n, 1.0 / n) << "the middle of all places is the middle of the lens";
    EXPECT_GT(nearest, 1.2 / std::sqrt(n)) << n;
  }
}

// The mean radius of the places on the left of a pixel is that of the places on the right.
TEST(LensPattern, the_sides_of_a_pixel_see_through_the_whole_lens) {
  for (const int n : {16, 64, 256}) {
    double squares[2] = {};
    for (const CameraSample& sample : camera_samples(n))
      squares[sample.place.x < 0.5 ? 0 : 1] += sample.lens.x * sample.lens.x + sample.lens.y * sample.lens.y;
    EXPECT_NEAR(squares[0] / (n / 2), 0.5, 0.1) << n;
    EXPECT_NEAR(squares[1] / (n / 2), 0.5, 0.1) << n;
  }
}

Camera lens_camera() {
  Camera camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70};
  camera.aperture = 0.5;
  camera.focus = 6;
  return camera;
}

TEST(LensRays, meet_in_the_plane_of_focus) {
  const Camera camera = lens_camera();
  const PixelRays rays(camera, 64, 48);
  for (double y = 0; y <= 48; y += 7.3)
    for (double x = 0; x <= 64; x += 5.9) {
      const Ray middle = rays.at(x, y);
      const Vec3d direction = to_double(middle.direction);
      const Vec3d sharp = camera.eye + (camera.focus / dot(direction, rays.forward())) * direction;
      for (const LensPlace place : {LensPlace{0, 0}, {1, 0}, {0, -1}, {0.6, 0.7}}) {
        const Ray ray = rays.at(x, y, place);
        const Vec3d from = to_double(ray.origin);
        EXPECT_NEAR(dot(from - camera.eye, rays.forward()), 0, 1e-6) << "the lens is a flat disc";
        EXPECT_NEAR(length(from - camera.eye), 0.5 * std::hypot(place.x, place.y), 1e-6);
        EXPECT_NEAR(length(to_double(ray.direction)), 1, 1e-7);
        EXPECT_NEAR(length(cross(sharp - from, to_double(ray.direction))), 0, 5e-6);
      }
    }
}

TEST(LensRays, without_a_lens_are_those_of_the_eye) {
  Camera camera = lens_camera();
  camera.aperture = 0;
  const PixelRays rays(camera, 64, 48);
  EXPECT_EQ(rays.at(3, 4, {1, 0}).origin, rays.at(3, 4).origin);
  EXPECT_EQ(rays.at(3, 4, {1, 0}).direction, rays.at(3, 4).direction);
}

TEST(LensCamera, is_checked) {
  EXPECT_TRUE(check_camera(lens_camera()));
  EXPECT_EQ(focus_distance(lens_camera()), 6);
  Camera camera = lens_camera();
  camera.focus = 0;
  EXPECT_NEAR(focus_distance(camera), 9, 1e-12);
  EXPECT_TRUE(check_camera(camera));
  for (const double bad : {-1.0, std::nan(""), 1e39}) {
    camera = lens_camera();
    camera.aperture = bad;
    EXPECT_FALSE(check_camera(camera)) << bad;
    camera = lens_camera();
    camera.focus = bad;
    EXPECT_FALSE(check_camera(camera)) << bad;
  }
  camera = lens_camera();
  camera.projection = Projection::orthographic;
  EXPECT_FALSE(check_camera(camera));
}

// One white ball on black at distance 20, in a picture of 40 pixels a unit there.
Film ball(double aperture, double focus, int samples) {
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<double>{0}, {0}, {0}, {0.25}).value();
  scene.materials[0] = Material{};
  scene.materials[0].colour = {1, 1, 1};
  scene.materials[0].ambient = 1;
  scene.materials[0].diffuse = scene.materials[0].specular = 0;
  scene.background = {0, 0, 0};
  scene.camera = {{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(0.15) * 180 / std::acos(-1.0)};
  scene.camera.aperture = aperture;
  scene.camera.focus = focus;
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = settings.height_px = 240;
  settings.samples_per_pixel = samples;
  return render(scene, Tracer::build(scene.spheres, Engine::automatic).value(), settings).value().film;
}

double sum_of(const Film& film) {
  double sum = 0;
  for (const Vec3f& pixel : film.radiance) sum += double(pixel.x);
  return sum;
}

TEST(DepthOfField, what_is_in_focus_is_sharp) {
  const Film sharp = ball(0, 0, 16), focused = ball(0.5, 0, 16);
  double difference = 0;
  for (std::size_t i = 0; i < sharp.radiance.size(); ++i)
    difference += std::abs(double(sharp.radiance[i].x) - double(focused.radiance[i].x));
  EXPECT_LT(difference / sum_of(sharp), 0.02);
}

// By the intercept theorem, what is at distance z blurs to a disc of radius aperture |z / focus - 1| there.
TEST(DepthOfField, the_blur_has_the_radius_of_optics) {
  const double aperture = 0.5, focus = 10;
  const Film film = ball(aperture, focus, 256);
  const double circle = aperture * (20 / focus - 1);  // 0.5 units: 20 pixels
  double farthest = 0, moment = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 240; ++x) {
      const auto light = double(film.at(x, y).x);
      const double distance = std::hypot(x + 0.5 - 120, y + 0.5 - 120) / 40;
      if (light > 0) farthest = std::max(farthest, distance);
      moment += light * distance * distance;
    }
  EXPECT_NEAR(farthest, 0.25 + circle, 0.03);
  // Of independent places on two discs, the squares of the mean distances are added: r^2 / 2 each.
  EXPECT_NEAR(moment / sum_of(film), (0.25 * 0.25 + circle * circle) / 2, 0.005);
  EXPECT_NEAR(sum_of(film) / sum_of(ball(0, 0, 16)), 1, 0.01) << "no light is lost";
}

}  // namespace
}  // namespace bihive
