// Drawing by covered area.
// ctest: asan-long
#include "bihive/image/canvas.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

constexpr Vec3d kWhite{1, 1, 1};

double sum_of(Canvas& canvas) {
  double sum = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) sum += double(canvas.at(x, y).x);
  return sum;
}

TEST(Canvas, rectangles_add_the_share_that_they_cover) {
  Canvas canvas(4, 3);
  canvas.add_rectangle({0.5, 1, 2.25, 1.5}, {1, 0.5, 0});
  EXPECT_EQ(canvas.at(0, 1), (Vec3f{0.25F, 0.125F, 0}));
  EXPECT_EQ(canvas.at(1, 1), (Vec3f{0.5F, 0.25F, 0}));
  EXPECT_EQ(canvas.at(2, 1), (Vec3f{0.125F, 0.0625F, 0}));
  EXPECT_EQ(canvas.at(3, 1), (Vec3f{}));
  EXPECT_EQ(canvas.at(1, 0), (Vec3f{}));
  EXPECT_EQ(canvas.at(1, 2), (Vec3f{}));
}

TEST(Canvas, rectangles_side_by_side_leave_no_seam) {
  Canvas canvas(10, 1);
  for (int i = 0; i < 1000; ++i) canvas.add_rectangle({i * 0.01, 0, (i + 1) * 0.01, 1}, kWhite);
  for (int x = 0; x < 10; ++x) EXPECT_NEAR(canvas.at(x, 0).x, 1, 1e-4) << x;
}

TEST(Canvas, what_lies_outside_is_cut_off) {
  Canvas canvas(5, 4);
  canvas.add_rectangle({-7, -1e30, 1, 1e30}, kWhite);
  EXPECT_EQ(sum_of(canvas), 4);
  canvas.clip_to(2, 1, 4, 3);
  const CanvasPoint everywhere[4] = {{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}};
  canvas.blend_polygon(everywhere, 4, kWhite, 1);
  canvas.add_rectangle({-7, -7, 9, 9}, kWhite);
  EXPECT_EQ(canvas.at(2, 1), (Vec3f{2, 2, 2}));
  EXPECT_EQ(canvas.at(3, 2), (Vec3f{2, 2, 2}));
  EXPECT_EQ(sum_of(canvas), 4 + 2 * 4);
}

TEST(Canvas, polygons_cover_their_area_either_way_round) {
  const CanvasPoint triangle[3] = {{1.3, 2}, {17.8, 5}, {6.1, 14}};
  const CanvasPoint reversed[3] = {triangle[2], triangle[1], triangle[0]};
  const double area = 0.5 * ((17.8 - 1.3) * (14 - 2) - (6.1 - 1.3) * (5 - 2));
  Canvas one(20, 16), other(20, 16);
  one.blend_polygon(triangle, 3, kWhite, 1);
  other.blend_polygon(reversed, 3, kWhite, 1);
  EXPECT_NEAR(sum_of(one), area, 0.01 * area);
  EXPECT_EQ(one.take_pixels(), other.take_pixels());
}

TEST(Canvas, blending_mixes_with_what_is_there) {
  Canvas canvas(2, 2);
  canvas.add_rectangle({0, 0, 2, 2}, {0.5, 0.5, 0.5});
  const CanvasPoint left[4] = {{0, 0}, {1, 0}, {1, 2}, {0, 2}};
  canvas.blend_polygon(left, 4, {1, 0, 0}, 0.25);
  EXPECT_EQ(canvas.at(0, 1), (Vec3f{0.625F, 0.375F, 0.375F}));
  EXPECT_EQ(canvas.at(1, 1), (Vec3f{0.5F, 0.5F, 0.5F}));
}

TEST(Canvas, lines_have_their_width_and_square_ends) {
  Canvas canvas(10, 10);
  canvas.blend_line({2, 3.5}, {7, 3.5}, 1, kWhite, 1);
  for (int x = 0; x < 10; ++x) EXPECT_EQ(canvas.at(x, 3).x, x >= 2 && x < 7 ? 1 : 0) << x;
  EXPECT_EQ(sum_of(canvas), 5);
  canvas.blend_line({5, 5}, {5, 5}, 3, kWhite, 1);
  EXPECT_EQ(sum_of(canvas), 5) << "a line without length";
}

}  // namespace
}  // namespace bihive
