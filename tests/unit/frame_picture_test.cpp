// The camera that shows a whole scene beside its labels.
// ctest: asan-long
#include "bihive/render/frame_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bihive/math/elementary.h"
#include "bihive/math/rng.h"
#include "bihive/render/draw_labels.h"

namespace bihive {
namespace {

struct PlacePx {
  double x, y;
};

// Where a point is seen.
PlacePx seen(Vec3d point, const Camera& camera, const RenderSettings& settings) {
  const Vec3d forward = normalized(camera.look_at - camera.eye);
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  const Vec3d place = point - camera.eye;
  const double shorter = std::min(settings.width_px, settings.height_px);
  const double px = camera.projection == Projection::orthographic
                        ? camera.shorter_side / shorter
                        : 2 * tan_deg(camera.fov_deg / 2) / shorter * dot(place, forward);
  return {0.5 * settings.width_px + dot(place, right) / px, 0.5 * settings.height_px - dot(place, up) / px};
}

// Points on all spheres, in directions that lie evenly.
std::vector<Vec3d> points_on(const SphereSet& spheres) {
  constexpr int kPoints = 400;
  std::vector<Vec3d> points;
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    for (int i = 0; i < kPoints; ++i) {
      const double z = 1 - (2.0 * i + 1) / kPoints;
      const double ring = std::sqrt(1 - z * z);
      const double angle = 2.399963229728653 * i;
      points.push_back(spheres.centre(id) +
                       spheres.radius(id) * Vec3d{ring * std::cos(angle), ring * std::sin(angle), z});
    }
  return points;
}

Scene scene_of(const std::vector<Vec3d>& centres, double radius) {
  std::vector<double> x, y, z;
  for (const Vec3d centre : centres) {
    x.push_back(centre.x);
    y.push_back(centre.y);
    z.push_back(centre.z);
  }
  Scene scene;
  scene.spheres = SphereSet::from_world(x, y, z, std::vector<double>(x.size(), radius)).value();
  return scene;
}

// Spheres that fill a box to its corners.
Scene full_box(std::uint64_t seed) {
  SplitMix64 random(seed);
  const double depth = 1 + 30 * random.next_double();
  std::vector<Vec3d> centres;
  for (int i = 0; i < 200; ++i)
    centres.push_back({40 * random.next_double(), 20 * random.next_double(), depth * random.next_double()});
  for (const double x : {0, 40})
    for (const double y : {0, 20}) centres.push_back({double(x), double(y), depth});
  Scene scene = scene_of(centres, 0.8);
  ColourBy by;
  by.attribute = "z";
  by.map = ColourMap::viridis;
  by.range = {-1, 1};
  scene.coloured_by.push_back(by);
  scene.spheres.attributes().colour.assign(static_cast<std::size_t>(scene.spheres.size()), {0.5F, 0.5F, 0.5F});
  return scene;
}

RenderSettings all_labels(int width_px, int height_px, Projection projection) {
  RenderSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.labels.legend = true;
  settings.labels.axes = true;
  settings.labels.title = "A box of spheres";
  settings.labels.scale_bar = projection == Projection::orthographic;
  return settings;
}

TEST(FramePicture, WithoutLabelsItIsTheCameraOfTheSpheres) {
  const Scene scene = full_box(1);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    RenderSettings settings;
    const Lens lens{30, projection};
    const Camera expected = frame_spheres(scene.spheres, side_of(ViewFrom::iso), lens, 1280, 720);
    const Camera camera = frame_picture(scene, side_of(ViewFrom::iso), lens, settings);
    EXPECT_EQ(camera.eye, expected.eye);
    EXPECT_EQ(camera.look_at, expected.look_at);
    EXPECT_EQ(camera.shorter_side, expected.shorter_side);
  }
}

TEST(FramePicture, NoLabelCoversASphere) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scene scene = full_box(seed);
    const std::vector<Vec3d> points = points_on(scene.spheres);
    for (const auto& [width, height] : {std::pair{640, 360}, std::pair{360, 640}, std::pair{300, 300}})
      for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const ViewFrom from : {ViewFrom::front, ViewFrom::iso}) {
          const RenderSettings settings = all_labels(width, height, projection);
          const Camera camera = frame_picture(scene, side_of(from), {30, projection}, settings);
          const LabelAreas areas = label_areas(scene, camera, settings);
          ASSERT_TRUE(areas.title && areas.legend && areas.axes);
          ASSERT_EQ(areas.scale_bar.has_value(), projection == Projection::orthographic);
          for (const Vec3d point : points) {
            const PlacePx place = seen(point, camera, settings);
            EXPECT_TRUE(place.x > 0 && place.x < width && place.y > 0 && place.y < height);
            for (const auto& area : {areas.title, areas.legend, areas.scale_bar, areas.axes}) {
              if (!area) continue;
              ASSERT_FALSE(place.x > area->x0 && place.x < area->x1 && place.y > area->y0 && place.y < area->y1)
                  << "seed " << seed << ", " << width << " x " << height << ": a sphere at " << place.x << ", "
                  << place.y;
            }
          }
        }
  }
}

TEST(FramePicture, LabelsThatCoverNothingTakeNoRoom) {
  // One ball leaves the corners free, and the right side of a wide picture.
  const Scene ball = scene_of({{0, 0, 0}}, 1);
  RenderSettings settings = all_labels(900, 360, Projection::orthographic);
  settings.labels.title.clear();
  settings.labels.legend = false;
  const Lens lens{30, Projection::orthographic};
  const Camera with = frame_picture(ball, side_of(ViewFrom::front), lens, settings);
  const Camera without = frame_spheres(ball.spheres, side_of(ViewFrom::front), lens, 900, 360);
  EXPECT_EQ(with.shorter_side, without.shorter_side);
  EXPECT_EQ(with.eye, without.eye);

  // A title lies over it.
  settings.labels.title = "A ball";
  const Camera below = frame_picture(ball, side_of(ViewFrom::front), lens, settings);
  EXPECT_GT(below.shorter_side, without.shorter_side);
  EXPECT_GT(below.look_at.y, without.look_at.y);
}

TEST(FramePicture, InsetsKeepTheSetInTheFreePart) {
  const Scene scene = full_box(7);
  const std::vector<Vec3d> points = points_on(scene.spheres);
  RenderSettings settings;
  settings.width_px = 500;
  settings.height_px = 400;
  const Insets insets{0.1, 0.35, 0.2, 0};
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = frame_spheres(scene.spheres, side_of(ViewFrom::iso), {30, projection}, 500, 400, insets);
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const Vec3d point : points) {
      const PlacePx place = seen(point, camera, settings);
      left = std::min(left, place.x);
      right = std::max(right, place.x);
      top = std::min(top, place.y);
      bottom = std::max(bottom, place.y);
    }
    // Points on spheres come near to the silhouettes; one of the two directions is filled.
    EXPECT_GE(left, 50 - 1e-6);
    EXPECT_LE(right, 325 + 1e-6);
    EXPECT_GE(top, 80 - 1e-6);
    EXPECT_LE(bottom, 384 + 1e-6);
    EXPECT_TRUE((left < 51 && right > 324) || (top < 81 && bottom > 383));
  }
}

}  // namespace
}  // namespace bihive
