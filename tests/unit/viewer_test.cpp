// The model behind window and page, with the CPU engine.
#include "bihive/viewer/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/wide_angle.h"

namespace bihive {
namespace {

using testing::HasSubstr;

constexpr double kBudgetMs = 5;

// Frames until the picture is complete, and the report of each.
std::vector<FrameReport> settle(Viewer& viewer) {
  std::vector<FrameReport> reports;
  for (int i = 0; i < 100000; ++i) {
    const Result<FrameReport> report = viewer.frame(kBudgetMs);
    EXPECT_TRUE(report) << report.error().to_string();
    if (!report) break;
    reports.push_back(*report);
    if (report->settled) break;
  }
  return reports;
}

// The picture that `bihive render` makes of the scene.
Image rendered(const Viewer& viewer, Engine engine, const RenderSettings& settings) {
  Scene scene = viewer.scene();
  scene.camera = viewer.settings().camera;
  const Result<Tracer> tracer = Tracer::build(scene.spheres, engine);
  const Result<Rendered> rendered = render(scene, *tracer, settings);
  return image_from_film(rendered->film, settings.view, scene.picture.transfer);
}

RenderSettings settings_of(const Viewer& viewer, int width, int height) {
  const ViewerSettings& of_viewer = viewer.settings();
  RenderSettings settings = settings_from(of_viewer.picture.result());
  settings.width_px = width;
  settings.height_px = height;
  settings.view = of_viewer.view;
  return settings;
}

TEST(Viewer, without_a_scene_there_is_nothing_to_draw) {
  Viewer viewer;
  const Result<FrameReport> report = viewer.frame(kBudgetMs);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled);
  EXPECT_FALSE(report->drawn);
  EXPECT_TRUE(viewer.image().rgb.empty());
  EXPECT_FALSE(viewer.picture(10, 10, 1));
  EXPECT_THAT(viewer.statistics_json(), HasSubstr("error"));
  viewer.orbit(10, 10);
  viewer.zoom(2, 1, 1);
  viewer.look_from(ViewFrom::left);
  viewer.home();
}

TEST(Viewer, settles_at_the_picture_that_the_program_renders) {
  Viewer viewer;
  viewer.resize(160, 90);
  const Result<SceneFacts> facts = viewer.load_built_in("demo");
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->name, "demo");
  EXPECT_EQ(facts->format, "PDB");
  EXPECT_EQ(facts->spheres, 1631);
  EXPECT_FALSE(facts->rules.empty());

  const std::vector<FrameReport> reports = settle(viewer);
  double done = 0;
  for (const FrameReport& report : reports) {
    EXPECT_GE(report.done, done);
    done = report.done;
  }
  EXPECT_EQ(done, 1);
  EXPECT_EQ(reports.back().divisor, 1);
  EXPECT_GT(reports.back().mray_per_s, 0);
  EXPECT_TRUE(std::any_of(reports.begin(), reports.end(), [](const FrameReport& report) { return report.drawn; }));

  EXPECT_EQ(viewer.settings().picture.result().samples_per_pixel, 4);
  const Image expected = rendered(viewer, Engine::wide, settings_of(viewer, 160, 90));
  EXPECT_EQ(picture_hash(viewer.image()), picture_hash(expected));

  // Nothing more to do.
  const Result<FrameReport> after = viewer.frame(kBudgetMs);
  EXPECT_TRUE(after->settled);
  EXPECT_FALSE(after->drawn);
}

TEST(Viewer, every_view_is_the_renderers) {
  Viewer viewer;
  viewer.resize(96, 64);
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  EXPECT_EQ(viewer.settings().picture.result().samples_per_pixel, 1) << "the scene's own";
  EXPECT_FALSE(viewer.settings().picture.result().shadows);
  for (const View view : {View::recursion, View::traversal, View::normal, View::distance, View::id, View::tree}) {
    ViewerSettings settings = viewer.settings();
    settings.view = view;
    ASSERT_TRUE(viewer.set(settings));
    settle(viewer);
    const Image expected = rendered(viewer, Engine::reference, settings_of(viewer, 96, 64));
    EXPECT_EQ(picture_hash(viewer.image()), picture_hash(expected)) << static_cast<int>(view);
  }
}

TEST(Viewer, draws_with_the_tone_lens_and_adaptive_samples_of_a_scene_file) {
  const char* const format =
      R"({"bihive_scene": 2, "camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0]%s}, "picture": {%s}, "spheres": [[0, 0, 0, 1]]})";
  std::uint64_t hashes[4] = {};
  const std::string tone = R"("exposure": 1, "tone": "filmic")";
  const std::array<std::array<std::string, 2>, 4> parts{
      {{"", ""}, {"", tone}, {"", tone + R"(, "samples_per_pixel": "auto")"}, {R"(, "aperture": 2)", tone}}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::string text = format;
    text.replace(text.find("%s"), 2, parts[i][0]);
    text.replace(text.find("%s"), 2, parts[i][1]);
    Viewer viewer;
    viewer.resize(96, 64);
    ASSERT_TRUE(viewer.load(text, "a.json"));
    EXPECT_EQ(viewer.settings().camera.aperture, i == 3 ? 2 : 0);
    EXPECT_EQ(viewer.settings().picture.result().adaptive_samples, i == 2);
    EXPECT_EQ(viewer.settings().picture.result().tone.exposure_stops, i == 0 ? 0 : 1);
    settle(viewer);
    hashes[i] = picture_hash(viewer.image());
    EXPECT_EQ(hashes[i], picture_hash(rendered(viewer, Engine::wide, settings_of(viewer, 96, 64)))) << i;
  }
  for (std::size_t i = 1; i < parts.size(); ++i) EXPECT_NE(hashes[i], hashes[i - 1]) << i;
}

TEST(Viewer, moving_begins_anew_and_is_coarser_where_the_budget_is_small) {
  Viewer viewer;
  viewer.resize(640, 400);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  settle(viewer);
  const std::uint64_t before = picture_hash(viewer.image());

  // Each move is answered by a picture, however small the budget is. Its coarseness depends on the time that the
  // machine takes for any picture. Only pictures finer than a third are surely not made.
  viewer.orbit(40, 0);
  const Result<FrameReport> first = viewer.frame(1e-3);
  ASSERT_TRUE(first);
  EXPECT_GE(first->divisor, 4);
  EXPECT_FALSE(first->settled);
  int drawn = first->drawn ? 1 : 0;
  for (int i = 0; i < 1000 && drawn < 3; ++i) {
    viewer.orbit(1, 0);
    const Result<FrameReport> report = viewer.frame(1e-3);
    ASSERT_TRUE(report);
    drawn += report->drawn ? 1 : 0;
    if (drawn > 0) {
      EXPECT_LE(viewer.image().width, 160);
    }
  }
  EXPECT_EQ(drawn, 3);
  settle(viewer);
  EXPECT_EQ(viewer.image().width, 640);
  EXPECT_NE(picture_hash(viewer.image()), before);

  viewer.home();
  settle(viewer);
  EXPECT_EQ(picture_hash(viewer.image()), before);

  // A moved picture counts as a frame.
  viewer.orbit(1, 0);
  (void)viewer.frame(1000);
  viewer.orbit(1, 0);
  EXPECT_GT(viewer.frame(1000)->fps, 0);
}

TEST(Viewer, an_error_leaves_everything_as_it_was) {
  Viewer viewer;
  viewer.resize(64, 48);
  ASSERT_TRUE(viewer.load_built_in("scenario2"));
  settle(viewer);
  const std::uint64_t before = picture_hash(viewer.image());

  EXPECT_THAT(viewer.load_built_in("scenario9").error().to_string(), HasSubstr("there are demo, scenario1"));
  EXPECT_THAT(viewer.load("ATOM nonsense", "broken.pdb").error().to_string(), HasSubstr("broken.pdb"));
  EXPECT_FALSE(viewer.load(Scene{}, {}, false, false));
  ScenarioParameters parameters;
  parameters.count = 0;
  EXPECT_FALSE(viewer.load_built_in("scenario1", parameters));

  const ViewerSettings good = viewer.settings();
  const auto refused = [&](auto change) {
    ViewerSettings settings = good;
    change(settings);
    const Status status = viewer.set(settings);
    EXPECT_FALSE(status);
    return status ? "" : status.error().to_string();
  };
  EXPECT_THAT(refused([](ViewerSettings& s) { s.picture.user.set("samples_per_pixel", 65); }), HasSubstr("samples"));
  EXPECT_THAT(refused([](ViewerSettings& s) { s.max_prims = 0; }), HasSubstr("max_prims"));
  EXPECT_THAT(refused([](ViewerSettings& s) { s.camera.eye = s.camera.look_at; }), HasSubstr("same point"));
  EXPECT_THAT(refused([](ViewerSettings& s) { s.engine = ViewerEngine::gpu; }), HasSubstr("no graphics processor"));

  EXPECT_EQ(viewer.facts().name, "scenario2");
  EXPECT_TRUE(viewer.frame(kBudgetMs)->settled) << "nothing was started anew";
  EXPECT_EQ(picture_hash(viewer.image()), before);
}

TEST(Viewer, parameters_of_the_tree_show_in_its_statistics) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load_built_in("scenario1"));
  EXPECT_THAT(viewer.statistics_json(), HasSubstr("\"max_prims\": 8"));
  ViewerSettings settings = viewer.settings();
  settings.max_prims = 1;
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_THAT(viewer.statistics_json(), HasSubstr("\"inner_nodes\": 4095"));
  ASSERT_TRUE(viewer.load_built_in("scenario2"));
  EXPECT_EQ(viewer.settings().max_prims, 1) << "stays for the next scene";
}

TEST(Viewer, zoom_keeps_the_sphere_under_the_pointer) {
  for (const double scale : {1e-20, 1.0, 1e20}) {
    Scene scene;
    const std::vector<double> x{0, 3 * scale}, y{0, 0.5 * scale}, z{0, 2 * scale}, r{scale, 0.5 * scale};
    scene.spheres = *SphereSet::from_world(x, y, z, r);
    Viewer viewer;
    viewer.resize(200, 100);
    ASSERT_TRUE(viewer.load(scene, {"two", "made", 2, 1, {}, {}}, false, false));
    const auto place = [&] {
      const PixelPlaces places(viewer.settings().camera, 200, 100);
      const Vec3d point = places.from_eye({3 * scale, 0.5 * scale, 2.5 * scale});
      return Vec3d{places.x_px(point), places.y_px(point), point.z};
    };
    const Vec3d before = place();
    viewer.zoom(1.5, before.x, before.y);
    EXPECT_NEAR(place().x, before.x, 0.05) << scale;
    EXPECT_NEAR(place().y, before.y, 0.05);
    EXPECT_NEAR(before.z / place().z, 1.5, 0.01);
    const Camera camera = viewer.settings().camera;
    viewer.zoom(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    viewer.zoom(-1, 0, 0);
    viewer.zoom(std::numeric_limits<double>::infinity(), 0, 0);
    EXPECT_EQ(viewer.settings().camera.eye, camera.eye);
  }
}

TEST(Viewer, a_camera_that_shows_all_does_so_at_any_size) {
  Viewer viewer;
  viewer.resize(100, 100);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  viewer.look_from(ViewFrom::left);
  const Vec3d square = viewer.settings().camera.eye;
  viewer.resize(100, 300);
  const Camera expected =
      frame_spheres(viewer.scene().spheres, ViewFrom::left, angle_for_picture(30, 100, 300), 100, 300);
  EXPECT_EQ(viewer.settings().camera.eye, expected.eye);
  EXPECT_NE(expected.eye, square);

  // A camera moved by hand stays at its place.
  viewer.orbit(5, 5);
  const Vec3d moved = viewer.settings().camera.eye;
  viewer.resize(300, 100);
  EXPECT_EQ(viewer.settings().camera.eye, moved);
}

TEST(Viewer, an_orthographic_scene_stays_orthographic) {
  Viewer viewer;
  viewer.resize(100, 60);
  Scene scene = four_spheres_scene();
  scene.camera = with_projection(scene.camera, Projection::orthographic);
  ASSERT_TRUE(viewer.load(scene, {"four", "made", 4, 1, {}, {}}, true, true));
  EXPECT_EQ(viewer.settings().camera, scene.camera);
  viewer.look_from(ViewFrom::left);
  const Camera left = viewer.settings().camera;
  EXPECT_EQ(left.projection, Projection::orthographic);
  EXPECT_EQ(left, frame_spheres(scene.spheres, side_of(ViewFrom::left),
                                {scene.camera.fov_deg, Projection::orthographic}, 100, 60));
  viewer.zoom(2, 50, 30);
  EXPECT_NEAR(viewer.settings().camera.shorter_side, left.shorter_side / 2, 1e-9);
  viewer.orbit(9, 5);
  EXPECT_EQ(viewer.settings().camera.projection, Projection::orthographic);
}

TEST(Viewer, another_projection_still_shows_all) {
  Viewer viewer;
  viewer.resize(100, 60);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  const Camera before = viewer.settings().camera;
  const auto project = [&](Projection projection) {
    ViewerSettings settings = viewer.settings();
    settings.camera = with_projection(settings.camera, projection);
    ASSERT_TRUE(viewer.set(settings));
  };
  const auto whole = [&](ViewFrom side) {
    return frame_spheres(viewer.scene().spheres, side_of(side), {before.fov_deg, Projection::orthographic}, 100, 60);
  };
  project(Projection::orthographic);
  EXPECT_EQ(viewer.settings().camera, whole(ViewFrom::front));
  viewer.look_from(ViewFrom::top);
  EXPECT_EQ(viewer.settings().camera, whole(ViewFrom::top));
  viewer.orbit(10, 0);
  viewer.home();
  EXPECT_EQ(viewer.settings().camera, whole(ViewFrom::front));
  project(Projection::perspective);
  EXPECT_EQ(viewer.settings().camera, before);

  // A camera that was moved by hand keeps its place.
  viewer.orbit(10, 0);
  const Camera moved = viewer.settings().camera;
  project(Projection::orthographic);
  EXPECT_EQ(viewer.settings().camera, with_projection(moved, Projection::orthographic));
}

TEST(Viewer, a_picture_to_be_saved_has_any_size_and_does_not_disturb) {
  Viewer viewer;
  viewer.resize(64, 36);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  settle(viewer);
  const std::uint64_t before = picture_hash(viewer.image());
  const Result<PngPixels> picture = viewer.picture(128, 72, 1);
  ASSERT_TRUE(picture);
  RenderSettings settings = settings_of(viewer, 128, 72);
  settings.samples_per_pixel = 1;
  EXPECT_EQ(picture_hash(*picture), picture_hash(rendered(viewer, Engine::wide, settings)));
  EXPECT_EQ(picture_hash(viewer.image()), before);
  settle(viewer);
  EXPECT_EQ(picture_hash(viewer.image()), before);

  // Also in the middle of a picture.
  viewer.orbit(10, 0);
  (void)viewer.frame(1e-3);
  ASSERT_TRUE(viewer.picture(20, 10, 1));
  settle(viewer);
  EXPECT_EQ(picture_hash(viewer.image()), picture_hash(rendered(viewer, Engine::wide, settings_of(viewer, 64, 36))));
}

TEST(Viewer, a_picture_to_be_saved_comes_in_steps) {
  Viewer viewer;
  viewer.resize(64, 36);
  EXPECT_FALSE(viewer.begin_picture(20, 10, 1));
  ASSERT_TRUE(viewer.load_built_in("demo"));
  settle(viewer);
  EXPECT_FALSE(viewer.advance_picture(1));
  const Result<PngPixels> whole = viewer.picture(300, 200, 1);
  ASSERT_TRUE(whole);

  // Moves in the meantime do not change it.
  ASSERT_TRUE(viewer.begin_picture(300, 200, 1));
  EXPECT_FALSE(viewer.take_picture()) << "it is not finished";
  double before = 0;
  int steps = 0;
  for (; before < 1; ++steps) {
    const Result<double> done = viewer.advance_picture(1e-3);
    ASSERT_TRUE(done) << done.error().to_string();
    ASSERT_GT(*done, before);
    before = *done;
    viewer.orbit(3, 1);
  }
  EXPECT_GT(steps, 3);
  const Result<PngPixels> in_steps = viewer.take_picture();
  ASSERT_TRUE(in_steps);
  EXPECT_EQ(picture_hash(*in_steps), picture_hash(*whole));
  EXPECT_FALSE(viewer.take_picture()) << "once";

  // Drawing something else drops it.
  const auto expect_dropped = [&](const char* by, const auto& act) {
    ASSERT_TRUE(viewer.begin_picture(300, 200, 1)) << by;
    ASSERT_TRUE(viewer.advance_picture(1e-3)) << by;
    act();
    EXPECT_FALSE(viewer.advance_picture(1)) << by;
  };
  expect_dropped("drop_picture", [&] { viewer.drop_picture(); });
  expect_dropped("frame", [&] { ASSERT_TRUE(viewer.frame(1)); });
  expect_dropped("set", [&] {
    ViewerSettings settings = viewer.settings();
    settings.max_prims = 2;
    ASSERT_TRUE(viewer.set(settings));
  });
  expect_dropped("set_look", [&] {
    ViewerLook look = viewer.look();
    look.style = "flat";
    ASSERT_TRUE(viewer.set_look(look));
  });

  // What is refused changes nothing.
  const auto expect_kept = [&](const char* in_spite_of, const auto& refused) {
    ASSERT_TRUE(viewer.begin_picture(300, 200, 1)) << in_spite_of;
    ASSERT_TRUE(viewer.advance_picture(1e-3)) << in_spite_of;
    EXPECT_FALSE(refused()) << in_spite_of;
    EXPECT_TRUE(viewer.advance_picture(1)) << in_spite_of;
  };
  const auto set = [&](const auto& change) {
    ViewerSettings settings = viewer.settings();
    change(settings);
    return static_cast<bool>(viewer.set(settings));
  };
  expect_kept("range", [&] { return set([](ViewerSettings& s) { s.picture.user.set("samples_per_pixel", 99); }); });
  expect_kept("wish", [&] { return set([](ViewerSettings& s) { s.picture.user.set("scale_bar", true); }); });
  expect_kept("engine", [&] { return set([](ViewerSettings& s) { s.engine = ViewerEngine::gpu; }); });
  expect_kept("focus", [&] { return set([](ViewerSettings& s) { s.focus_on = "resname NOT"; }); });
  expect_kept("look", [&] {
    ViewerLook look = viewer.look();
    look.rows = {{"all", "hide", ""}};
    return static_cast<bool>(viewer.set_look(look));
  });
  expect_kept("load", [&] { return static_cast<bool>(viewer.load("ATOM nonsense", "broken.pdb")); });
  expect_dropped("load", [&] { ASSERT_TRUE(viewer.load_built_in("four-spheres")); });
  settle(viewer);
  EXPECT_EQ(picture_hash(viewer.image()), picture_hash(rendered(viewer, Engine::wide, settings_of(viewer, 64, 36))));
}

TEST(Viewer, what_does_not_fit_into_memory_is_refused_and_the_scene_stays) {
  Viewer viewer;
  viewer.resize(64, 36);
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  settle(viewer);
  const std::uint64_t before = picture_hash(viewer.image());

  ASSERT_EQ(setenv("BIHIVE_MEMORY", "20000", 1), 0);
  const auto expect_refused = [](const auto& result, const char* what) {
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr(what));
    EXPECT_THAT(result.error().message, HasSubstr("of memory, and BIHIVE_MEMORY allows 20 kB"));
  };
  expect_refused(viewer.load_built_in("demo"), "the tree of 1,631 spheres would take about");
  expect_refused(viewer.load_built_in("scenario1"), "this many spheres would take about");
  expect_refused(viewer.picture(100, 100, 1), "so large a picture would take about 180 kB");
  EXPECT_EQ(viewer.facts().name, "four-spheres");

  // Memory for the drawn tree (186 kB while it is built), but not for the other one (242 kB).
  Viewer small;
  ViewerSettings settings = small.settings();
  settings.view = View::traversal;
  ASSERT_TRUE(small.set(settings));
  ASSERT_EQ(setenv("BIHIVE_MEMORY", "200000", 1), 0);
  EXPECT_TRUE(small.load_built_in("demo"));
  EXPECT_THAT(small.statistics_json(), HasSubstr("the tree of 1,631 spheres would take about"));
  ASSERT_EQ(unsetenv("BIHIVE_MEMORY"), 0);

  viewer.orbit(1, 1);
  viewer.home();
  settle(viewer);
  EXPECT_EQ(picture_hash(viewer.image()), before);
}

TEST(SlicedPicture, is_the_same_picture_as_in_one_go) {
  const Result<LoadedScene> demo = built_in_scene("scenario3");
  ASSERT_TRUE(demo);
  for (const Engine engine : {Engine::wide, Engine::reference})
    for (const View view : {View::shaded, View::distance}) {
      const Result<Tracer> tracer = Tracer::build(demo->scene.spheres, engine);
      RenderSettings settings = settings_from(demo->scene.picture);
      settings.width_px = 200;
      settings.height_px = 130;
      settings.view = view;
      Result<SlicedPicture> sliced = SlicedPicture::begin(demo->scene, *tracer, settings);
      ASSERT_TRUE(sliced);
      double done = 0;
      int slices = 0;
      while (!sliced->finished()) {
        sliced->advance(0);
        EXPECT_GT(sliced->done(), done);
        done = sliced->done();
        ++slices;
      }
      EXPECT_EQ(done, 1);
      EXPECT_GT(slices, 1);
      const Rendered in_slices = sliced->take();
      const Result<Rendered> at_once = render(demo->scene, *tracer, settings);
      EXPECT_EQ(in_slices.film.radiance, at_once->film.radiance);
      EXPECT_EQ(in_slices.rays.primary, at_once->rays.primary);
      EXPECT_EQ(in_slices.rays.reflected, at_once->rays.reflected);
    }
}

// How far the spheres stay from the border of the picture, at least, in pixels; below 0 some are cropped.
double least_border_px(const Viewer& viewer, int width, int height) {
  const Camera& camera = viewer.settings().camera;
  const PixelPlaces places(camera, width, height);
  const bool parallel = camera.projection == Projection::orthographic;
  const double px_at_1 = parallel ? std::min(width, height) / camera.shorter_side
                                  : std::min(width, height) / (2 * std::tan(camera.fov_deg * std::acos(-1.0) / 360));
  double least = width;
  const SphereSet& spheres = viewer.scene().spheres;
  for (std::int64_t id = 0; id < spheres.total_size(); ++id) {
    const Vec3d seen = places.from_eye(spheres.centre(id));
    const double radius = spheres.radius(id) * (parallel ? px_at_1 : px_at_1 / seen.z);
    EXPECT_GT(seen.z, spheres.radius(id)) << "in front of the eye";
    const double x = places.x_px(seen), y = places.y_px(seen);
    least = std::min({least, x - radius, width - x - radius, y - radius, height - y - radius});
  }
  return least;
}

TEST(Viewer, a_long_set_stays_in_the_picture_while_it_turns) {
  // A rod along the view: from the front it is a small disc.
  std::string rod = "x,y,z,r\n";
  for (int i = -50; i <= 50; ++i) rod += "0,0," + std::to_string(i) + ",1\n";
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Viewer viewer;
    viewer.resize(160, 90);
    ASSERT_TRUE(viewer.load(rod, "rod.csv"));
    ViewerSettings settings = viewer.settings();
    settings.camera = with_projection(settings.camera, projection);
    ASSERT_TRUE(viewer.set(settings));
    const Camera first = viewer.settings().camera;
    EXPECT_GT(least_border_px(viewer, 160, 90), 0);
    for (int i = 0; i < 18; ++i) {
      viewer.orbit(10, i % 3 - 1);
      EXPECT_GT(least_border_px(viewer, 160, 90), 0) << i;
    }
    // Half a turn later the camera is as near as before: a turn alone takes nobody away.
    EXPECT_NEAR(
        length(viewer.settings().camera.eye - viewer.settings().camera.look_at) / length(first.eye - first.look_at), 1,
        0.3);

    // A hand that comes nearer wants that.
    viewer.orbit(40, 0);
    viewer.zoom(8, 80, 45);
    const Camera near = viewer.settings().camera;
    viewer.orbit(5, 0);
    EXPECT_NEAR(length(viewer.settings().camera.eye - viewer.settings().camera.look_at),
                length(near.eye - near.look_at), 1e-9);
    EXPECT_EQ(viewer.settings().camera.shorter_side, near.shorter_side);
  }
}

TEST(Viewer, a_cut_that_moves_leaves_the_camera) {
  Viewer viewer;
  viewer.resize(300, 200);
  ASSERT_TRUE(viewer.load_built_in("demo", {}, {}));
  const Camera whole = viewer.settings().camera;
  const auto cut = [&](std::optional<double> above_middle) {
    ViewerLook look = viewer.look();
    look.rows.clear();
    if (above_middle)
      look.rows.push_back({"", "clip", "plane:0,1,0," + std::to_string(whole.look_at.y + *above_middle)});
    ASSERT_TRUE(viewer.set_look(look));
  };
  const auto same_camera = [&](const Camera& camera) { return viewer.settings().camera == camera; };

  // Before anything is seen it frames what is left, as the program does.
  cut(0);
  const Camera half = viewer.settings().camera;
  EXPECT_FALSE(same_camera(whole));
  ASSERT_TRUE(viewer.frame(kBudgetMs));
  cut(std::nullopt);
  EXPECT_GT(length(viewer.settings().camera.eye - half.look_at), length(half.eye - half.look_at)) << "shows all of it";

  viewer.home();
  EXPECT_TRUE(same_camera(whole));
  for (const double above_middle : {5, -5, 0}) {
    cut(std::nullopt);
    EXPECT_TRUE(same_camera(whole));
    cut(above_middle);
    EXPECT_TRUE(same_camera(whole)) << above_middle;
  }
  viewer.resize(301, 200);
  EXPECT_TRUE(same_camera(whole));
  viewer.home();
  viewer.resize(300, 200);
  EXPECT_TRUE(same_camera(half)) << "what is left, where the user asks for it";
}

TEST(Viewer, copies_stay_in_the_picture_while_they_turn) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Viewer viewer;
    viewer.resize(160, 90);
    ReadOptions options;
    options.cell_vectors = {Vec3d{2, 0, 0}, Vec3d{0.5, 2, 0}, Vec3d{0, 0, 5}};
    options.replicate = {2, 1, 12};
    ASSERT_TRUE(viewer.load("x,y,z,r\n0,0,0,1\n1,1,1,0.5\n", "pair.csv", options));
    ViewerSettings settings = viewer.settings();
    settings.camera = with_projection(settings.camera, projection);
    ASSERT_TRUE(viewer.set(settings));
    for (int i = 0; i < 12; ++i) {
      viewer.orbit(12, 5);
      EXPECT_GT(least_border_px(viewer, 160, 90), 0) << i;
    }
  }
}

TEST(Viewer, home_brings_the_scenes_own_angle_back) {
  Viewer viewer;
  viewer.resize(96, 64);
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  const double own = viewer.settings().camera.fov_deg;
  ViewerSettings settings = viewer.settings();
  settings.camera.fov_deg = own + 20;
  ASSERT_TRUE(viewer.set(settings));
  viewer.home();
  EXPECT_EQ(viewer.settings().camera.fov_deg, own);
  viewer.look_from(ViewFrom::left);
  EXPECT_EQ(viewer.settings().camera.fov_deg, own);
}

TEST(Viewer, a_wide_picture_has_the_programs_angle_unless_the_user_chose_one) {
  const auto angle_of = [](const Viewer& viewer) { return viewer.settings().camera.fov_deg; };
  Viewer viewer;
  viewer.resize(900, 300);
  ASSERT_TRUE(viewer.load_built_in("demo", {}, {}));
  const double wide = angle_for_picture(30, 900, 300);
  EXPECT_LT(wide, 22);
  EXPECT_EQ(angle_of(viewer), wide);
  viewer.resize(300, 300);
  EXPECT_EQ(angle_of(viewer), 30);
  viewer.resize(300, 900);
  EXPECT_EQ(angle_of(viewer), wide);
  ViewerLook look = viewer.look();
  look.style = "studio";
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(angle_of(viewer), wide);
  viewer.home();
  EXPECT_EQ(angle_of(viewer), wide);

  ViewerSettings settings = viewer.settings();
  settings.camera.fov_deg = 40;
  ASSERT_TRUE(viewer.set(settings));
  viewer.resize(900, 300);
  EXPECT_EQ(angle_of(viewer), 40);
  viewer.look_from(ViewFrom::left);
  EXPECT_EQ(angle_of(viewer), 40);
}

TEST(Viewer, another_angle_still_shows_the_whole_set) {
  Viewer viewer;
  viewer.resize(96, 64);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  const Camera before = viewer.settings().camera;
  ViewerSettings settings = viewer.settings();
  settings.camera.fov_deg = 60;
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_LT(length(viewer.settings().camera.eye - viewer.settings().camera.look_at),
            length(before.eye - before.look_at));
  EXPECT_EQ(viewer.settings().camera.fov_deg, 60);
  EXPECT_GT(least_border_px(viewer, 96, 64), 0);
  viewer.look_from(ViewFrom::left);
  EXPECT_EQ(viewer.settings().camera.fov_deg, 60) << "the user's";

  // To and fro between the projections.
  settings = viewer.settings();
  const Camera left = settings.camera;
  settings.camera = with_projection(settings.camera, Projection::orthographic);
  ASSERT_TRUE(viewer.set(settings));
  settings.camera = with_projection(viewer.settings().camera, Projection::perspective);
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_EQ(viewer.settings().camera, left);

  // Near in parallel rays, the angle of perspective becomes small; another side gets the chosen one again.
  settings = viewer.settings();
  settings.camera = with_projection(settings.camera, Projection::orthographic);
  ASSERT_TRUE(viewer.set(settings));
  viewer.zoom(10, 48, 32);
  settings = viewer.settings();
  settings.camera = with_projection(settings.camera, Projection::perspective);
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_LT(viewer.settings().camera.fov_deg, 30);
  viewer.look_from(ViewFrom::left);
  EXPECT_EQ(viewer.settings().camera, left);
}

}  // namespace
}  // namespace bihive
