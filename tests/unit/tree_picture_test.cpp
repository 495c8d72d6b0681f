// The drawing of the tree.
// ctest: asan-long
#include "bihive/render/tree_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bihive/bih/child_boxes.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/render/picture/tree_colours.h"
#include "bihive/scene/generators.h"
#include "support/thread_time.h"

namespace bihive {
namespace {

namespace colours = tree_colours;

SphereSet set_of(const std::vector<std::array<double, 4>>& spheres) {
  std::vector<double> x, y, z, r;
  for (const auto& sphere : spheres) {
    x.push_back(sphere[0]);
    y.push_back(sphere[1]);
    z.push_back(sphere[2]);
    r.push_back(sphere[3]);
  }
  return SphereSet::from_world(x, y, z, r).value();
}

Scene scene_of(SphereSet spheres) {
  Scene scene;
  scene.spheres = std::move(spheres);
  return scene;
}

Canvas bars_of(const SphereSet& spheres, const BuildParameters& parameters, int width, int height) {
  Canvas canvas(width, height);
  draw_tree_bars(canvas, {0, 0, double(width), double(height)}, build_reference_tree(spheres, parameters));
  return canvas;
}

void expect_colour(Canvas& canvas, int x, int y, Vec3d colour) {
  const Vec3d found = to_double(canvas.at(x, y));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], colour[i], 1e-6) << "(" << x << ", " << y << ") channel " << i;
}

// The number of pixels with this colour.
int pixels_of(Canvas& canvas, Vec3d colour) {
  int pixels = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      if (length(to_double(canvas.at(x, y)) - colour) < 1e-5) ++pixels;
  return pixels;
}

Film film_of(const Scene& scene, const BuildParameters& parameters, int width, int height, int threads = 0) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference, parameters).value();
  RenderSettings settings;
  settings.width_px = width;
  settings.height_px = height;
  settings.view = View::tree;
  settings.threads = threads;
  return std::move(render(scene, tracer, settings).value().film);
}

TEST(Bars, the_grid_of_64) {
  // Seven levels, 64 leaves; rows of a tenth of the height of at least eight.
  const SphereSet spheres = scenario_spheres(Scenario::grid, {64, 1, 1}).value();
  Canvas canvas = bars_of(spheres, {1, kUnlimited}, 640, 80);
  for (int leaf = 0; leaf < 64; ++leaf) {
    for (const int x : {10 * leaf, 10 * leaf + 8}) expect_colour(canvas, x, 64, colours::of_depth(7, 7));
    expect_colour(canvas, 10 * leaf + 9, 64, colours::kPaper);
  }
  expect_colour(canvas, 100, 69, colours::kPaper);
  expect_colour(canvas, 100, 75, colours::kPaper);

  // The root's gap: 40/3 - 2 - 2/3 of its box's 40 in the middle of its bar of 639 pixels.
  const double gap = (38.0 / 3 - 2) / 40;
  expect_colour(canvas, 0, 4, colours::of_depth(1, 7) * 0.45);
  for (const double share : {0.5 - gap / 2 + 0.01, 0.5, 0.5 + gap / 2 - 0.01})
    expect_colour(canvas, static_cast<int>(639 * share), 4, colours::kGap);
  for (const double share : {0.5 - gap / 2 - 0.01, 0.5 + gap / 2 + 0.01})
    expect_colour(canvas, static_cast<int>(639 * share), 4, colours::of_depth(1, 7) * 0.45);
}

TEST(Bars, one_leaf_is_one_bar) {
  const SphereSet spheres = scenario_spheres(Scenario::grid, {64, 1, 1}).value();
  Canvas canvas = bars_of(spheres, {kUnlimited, kUnlimited}, 64, 80);
  EXPECT_EQ(pixels_of(canvas, colours::of_depth(1, 1)), 63 * 9);
  EXPECT_EQ(pixels_of(canvas, colours::kPaper), 64 * 80 - 63 * 9);
}

TEST(Bars, an_overlap_is_red_in_proportion) {
  // Boxes from 0 to 6 and from 4 to 10: the overlap takes two tenths.
  Canvas canvas = bars_of(set_of({{3, 0, 0, 3}, {7, 0, 0, 3}}), {1, kUnlimited}, 101, 80);
  for (int x = 0; x < 100; ++x)
    expect_colour(canvas, x, 4, x >= 40 && x < 60 ? colours::kOverlap : colours::of_depth(1, 2) * 0.45);
}

TEST(Bars, clip_one_sided_and_forced_nodes_have_their_colours) {
  // Two groups of spheres far apart along x, the left one flat in y: a clip node cuts the left group's box.
  Canvas clip =
      bars_of(set_of({{0, -1, 0, 1}, {4, 1, 0, 1}, {100, -20, 0, 1}, {100, 20, 0, 1}}), {1, kUnlimited}, 200, 160);
  EXPECT_GT(pixels_of(clip, colours::kClip), 0);
  EXPECT_GT(pixels_of(clip, colours::kClip * 0.4), 0);

  // Spheres in only one half of the box of a larger sphere.
  const SphereSet two = scenario_spheres(Scenario::corners, {256, 1, 1}).value();
  Canvas one_sided = bars_of(two, {8, kUnlimited}, 400, 160);
  EXPECT_GT(pixels_of(one_sided, colours::kEmpty * 0.4), 0);

  // Equal spheres cannot be parted.
  Canvas forced = bars_of(set_of({{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}), {1, kUnlimited}, 30, 80);
  EXPECT_EQ(pixels_of(forced, colours::kForced), 29 * 9);
}

TEST(Bars, finer_than_a_pixel_they_are_averaged) {
  // 4096 leaves over 64 pixels: each pixel of the last row is filled by 64 of them.
  const SphereSet spheres = scenario_spheres(Scenario::grid, {4096, 1, 1}).value();
  Canvas canvas = bars_of(spheres, {1, kUnlimited}, 64, 130);
  for (int x = 0; x < 64; ++x) {
    const Vec3d found = to_double(canvas.at(x, 124));
    EXPECT_LT(length(found - colours::of_depth(13, 13)), 1e-4) << x;
  }
}

TEST(ChildBoxes, are_cut_by_the_planes) {
  Node node;
  node.kind = NodeKind::split;
  node.split_axis = 1;
  node.left_clip = 2;
  node.right_clip = 3;
  const Aabb box{{0, 0, 0}, {9, 9, 9}};
  EXPECT_EQ(child_boxes(node, box).first.hi, (Vec3f{9, 2, 9}));
  EXPECT_EQ(child_boxes(node, box).first.lo, box.lo);
  EXPECT_EQ(child_boxes(node, box).second.lo, (Vec3f{0, 3, 0}));
  EXPECT_EQ(child_boxes(node, box).second.hi, box.hi);
  node.kind = NodeKind::clip;
  EXPECT_EQ(child_boxes(node, box).first.lo, (Vec3f{0, 2, 0}));
  EXPECT_EQ(child_boxes(node, box).first.hi, (Vec3f{9, 3, 9}));
  node.kind = NodeKind::one_left;
  EXPECT_EQ(child_boxes(node, box).first.hi, (Vec3f{9, 2, 9}));
  EXPECT_EQ(child_boxes(node, box).first.lo, box.lo);
  node.kind = NodeKind::one_right;
  EXPECT_EQ(child_boxes(node, box).first.lo, (Vec3f{0, 3, 0}));
  EXPECT_EQ(child_boxes(node, box).first.hi, box.hi);
}

// The colour at the picture position of a point in the world.
Vec3d colour_at(Canvas& canvas, const Camera& camera, Vec3d world) {
  const PixelPlaces places(camera, canvas.width(), canvas.height());
  const Vec3d seen = places.from_eye(world);
  return to_double(canvas.at(static_cast<int>(places.x_px(seen)), static_cast<int>(places.y_px(seen))));
}

Canvas boxes_of(const SphereSet& spheres, const Camera& camera, const BuildParameters& parameters) {
  Canvas canvas(200, 150);
  const Tree tree = build_reference_tree(spheres, parameters);
  draw_tree_boxes(canvas, {0, 0, 200, 150}, tree, spheres.inverse_scale(), camera);
  return canvas;
}

TEST(Boxes, a_gap_is_green_where_it_is_seen_and_an_overlap_red) {
  const Camera camera{{5, 0, 40}, {5, 0, 0}, {0, 1, 0}, 30};
  Canvas gap = boxes_of(set_of({{0, 0, 0, 1}, {10, 0, 0, 1}}), camera, {1, kUnlimited});
  const Vec3d green = colour_at(gap, camera, {5, 0, 0});
  EXPECT_GT(green.y, 0.05);
  EXPECT_LT(green.x, 0.5 * green.y);
  EXPECT_LT(green.z, 0.5 * green.y);
  const Vec3d leaf = colour_at(gap, camera, {0, 0, 1});
  EXPECT_GT(leaf.z, leaf.y) << "violet";
  EXPECT_EQ(colour_at(gap, camera, {5, 3, 0}), Vec3d{}) << "outside of every box";

  Canvas overlap = boxes_of(set_of({{3, 0, 0, 3}, {7, 0, 0, 3}}), camera, {1, kUnlimited});
  const Vec3d red = colour_at(overlap, camera, {5, 0, 0});
  EXPECT_GT(red.x, red.y + 0.05);
  EXPECT_GT(red.x, red.z);
}

TEST(Boxes, the_outline_runs_along_the_root_s_box) {
  const Camera camera{{0, 0, 40}, {0, 0, 0}, {0, 1, 0}, 30};
  const SphereSet spheres = set_of({{0, 0, 0, 5}});
  Canvas canvas = boxes_of(spheres, camera, {1, kUnlimited});
  for (const double along : {-4.0, 0.0, 4.0}) {
    EXPECT_GT(length(colour_at(canvas, camera, {along, 5, 5})), 0.3) << along;
    EXPECT_GT(length(colour_at(canvas, camera, {-5, along, 5})), 0.3) << along;
  }
}

TEST(TreePicture, parts_lie_side_by_side_or_one_above_the_other) {
  const TreePictureLayout wide = tree_picture_layout(800, 400);
  EXPECT_EQ(wide.boxes.y1, 400);
  EXPECT_LT(wide.boxes.x1, wide.bars.x0);
  EXPECT_EQ(wide.bars.x1, 800);
  const TreePictureLayout high = tree_picture_layout(400, 800);
  EXPECT_EQ(high.boxes.x1, 400);
  EXPECT_LT(high.boxes.y1, high.bars.y0);
  EXPECT_EQ(high.bars.y1, 800);
  for (const int width : {1, 2, 3, 17})
    for (const int height : {1, 2, 3, 17}) {
      const TreePictureLayout layout = tree_picture_layout(width, height);
      EXPECT_GE(layout.boxes.width(), 1);
      EXPECT_GE(layout.boxes.height(), 1);
      EXPECT_LE(layout.boxes.x1, width);
      EXPECT_LE(layout.bars.y1, height);
    }
}

TEST(TreePicture, a_framed_camera_shows_the_whole_box) {
  Scene scene = scene_of(scenario_spheres(Scenario::corners, {500, 1, 1}).value());
  for (const ViewFrom side : {ViewFrom::front, ViewFrom::iso, ViewFrom::top}) {
    scene.camera = frame_tree(scene.spheres, side, 30, 300, 400);
    const CanvasArea boxes = tree_picture_layout(300, 400).boxes;
    const Film film = film_of(scene, {8, kUnlimited}, 300, 400);
    double inside = 0;
    for (int y = 0; y < int(boxes.y1); ++y)
      for (int x = 0; x < 300; ++x) {
        const double ink = length(to_double(film.at(x, y)));
        if (x < 3 || x >= 297 || y < 3 || y >= int(boxes.y1) - 3)
          EXPECT_EQ(ink, 0) << x << ", " << y;
        else
          inside += ink;
      }
    EXPECT_GT(inside, 1000);
  }
}

TEST(TreePicture, odd_places_of_the_camera_and_odd_sets) {
  // Inside the boxes, looking away from them, and far away; sets of nothing, a point, one sphere; small pictures.
  Scene scene = scene_of(scenario_spheres(Scenario::mixed, {300, 1, 1}).value());
  for (const Camera& camera :
       {Camera{{1, 2, 3}, {0, 0, -50}, {0, 1, 0}, 90}, Camera{{0, 0, 100}, {0, 0, 200}, {0, 1, 0}, 30},
        Camera{{0, 0, 1e30}, {0, 0, 0}, {0, 1, 0}, 1}, Camera{{20, 20, 20}, {0, 0, 0}, {0, 1, 0}, 179}}) {
    scene.camera = camera;
    const Film film = film_of(scene, {1, kUnlimited}, 90, 60);
    for (const Vec3f& pixel : film.radiance) ASSERT_TRUE(is_finite(pixel));
  }
  for (const auto& spheres : std::vector<std::vector<std::array<double, 4>>>{
           {}, {{1, 2, 3, 0}}, {{1, 2, 3, 4}}, {{0, 0, 0, 1e-30}, {1e30, 1, 1, 1e29}}}) {
    Scene small = scene_of(set_of(spheres));
    small.camera = frame_tree(small.spheres, ViewFrom::front, 30, 40, 30);
    for (const int size : {1, 2, 40})
      for (const Vec3f& pixel : film_of(small, {1, kUnlimited}, size, size).radiance) ASSERT_TRUE(is_finite(pixel));
  }
}

TEST(TreePicture, needs_a_tree) {
  const Scene scene = scene_of(set_of({{0, 0, 0, 1}}));
  const Tracer tracer = Tracer::build(scene.spheres, Engine::brute).value();
  RenderSettings settings;
  settings.view = View::tree;
  EXPECT_FALSE(render(scene, tracer, settings));
}

TEST(TreePicture, a_million_spheres_in_time_and_the_same_for_any_number_of_threads) {
  Scene scene = scene_of(scenario_spheres(Scenario::mixed, {1000000, 0.05F, 1}).value());
  scene.camera = frame_tree(scene.spheres, ViewFrom::iso, 30, 640, 360);
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference, {1, kUnlimited}).value();
  RenderSettings settings;
  settings.width_px = 640;
  settings.height_px = 360;
  settings.view = View::tree;
  std::uint64_t hash = 0;
  for (const int threads : {1, 3}) {
    settings.threads = threads;
    const double start_ms = test::process_time_ms();
    const Rendered rendered = std::move(render(scene, tracer, settings).value());
    EXPECT_LT(test::process_time_ms() - start_ms, 20000) << "about a second on one core";
    const std::uint64_t found = picture_hash(image_from_film(rendered.film, View::tree, Transfer::srgb));
    if (hash != 0) {
      EXPECT_EQ(found, hash);
    }
    hash = found;
  }
}

}  // namespace
}  // namespace bihive
