// Turns around what the camera looks at.
// ctest: asan-long
#include "bihive/scene/turn.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

constexpr double kNear = 1e-12;

void expect_close(Vec3d a, Vec3d b) {
  EXPECT_NEAR(length(a - b), 0, kNear) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Turn, none_changes_no_bit) {
  for (const ViewFrom from : {ViewFrom::front, ViewFrom::left, ViewFrom::top}) {
    const Side side = side_of(from);
    EXPECT_EQ(turned(side, {}).back, side.back);
    EXPECT_EQ(turned(side, {}).up, side.up);
    EXPECT_EQ(turned(side, {360, -360, 360}).back, side.back);
  }
}

TEST(Turn, quarters_lead_from_side_to_side) {
  const auto expect_side = [](ViewFrom from, const Turn& turn, ViewFrom to) {
    EXPECT_EQ(turned(side_of(from), turn).back, side_of(to).back);
  };
  expect_side(ViewFrom::front, {90, 0}, ViewFrom::right);
  expect_side(ViewFrom::front, {-90, 0}, ViewFrom::left);
  expect_side(ViewFrom::front, {180, 0}, ViewFrom::back);
  expect_side(ViewFrom::front, {0, 90}, ViewFrom::top);
  expect_side(ViewFrom::front, {0, -90}, ViewFrom::bottom);
  EXPECT_EQ(turned(side_of(ViewFrom::front), {0, 90}).up, side_of(ViewFrom::top).up);
  EXPECT_EQ(turned(side_of(ViewFrom::front), {30, 0}).up, (Vec3d{0, 1, 0}));
  const Side over = turned(side_of(ViewFrom::front), {0, 180});
  expect_close(over.back, {0, 0, -1});
  expect_close(over.up, {0, -1, 0});
}

TEST(Turn, roll_turns_the_picture_counter_clockwise) {
  // What is on the right comes to the top.
  const Camera camera = turned(Camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 30}, {0, 0, 90});
  const PixelPlaces places(camera, 100, 100);
  const Vec3d seen = places.from_eye({1, 0, 0});
  EXPECT_NEAR(places.x_px(seen), 50, 1e-9);
  EXPECT_LT(places.y_px(seen), 40);
}

TEST(Turn, a_camera_keeps_its_distance_and_what_it_looks_at) {
  const Camera camera{{3, 1, 2}, {-4, 5, 6}, {0, 0.2, 1}, 70};
  const Camera moved = turned(camera, {33, -21, 140});
  EXPECT_TRUE(check_camera(moved));
  EXPECT_EQ(moved.look_at, camera.look_at);
  EXPECT_EQ(moved.fov_deg, 70);
  EXPECT_NEAR(length(moved.eye - moved.look_at), length(camera.eye - camera.look_at), kNear);
  EXPECT_NEAR(dot(moved.up, moved.eye - moved.look_at), 0, 1e-11);
  // Back again, in the other order.
  const Camera again = turned(turned(turned(moved, {0, 0, -140}), {0, 21}), {-33, 0});
  expect_close(again.eye, camera.eye);
}

}  // namespace
}  // namespace bihive
