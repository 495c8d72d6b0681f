// Cells and copies in scene files, in cameras and in the viewer's model.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bihive/scene/framing_cell.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/scene_file.h"
#include "bihive/viewer/viewer.h"
#include "bihive/viewer/viewer_json.h"

namespace bihive {
namespace {

const std::string kDocument = R"({"bihive_scene": 2,
  "cell": {"vectors": [[4, 0, 0], [1, 4, 0], [0, 0, -5]], "origin": [-2, 0.125, 3]}, "replicate": [3, 1, 2],
  "picture": {"cell_lines": {"width_px": 3.5, "colour": [0.25, 0, 1]}},
  "spheres": [[0, 0, 0, 1], [2, 1, 1, 0.5]]})";

TEST(CellOfScene, ComesBackFromTheWrittenFile) {
  const LoadedScene loaded = parse_scene(kDocument, "a.json", {}).value();
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.spheres.cell(), (Cell{{-2, 0.125, 3}, {Vec3d{4, 0, 0}, Vec3d{1, 4, 0}, Vec3d{0, 0, -5}}}));
  EXPECT_EQ(scene.spheres.images().counts, (std::array<std::int32_t, 3>{3, 1, 2}));
  EXPECT_EQ(scene.spheres.total_size(), 12);
  ASSERT_TRUE(scene.picture.cell_lines.has_value());
  EXPECT_EQ(scene.picture.cell_lines->width_px, 3.5);

  const std::string written = scene_to_json(scene);
  const Scene again = parse_scene(written, "a.json", {}).value().scene;
  EXPECT_EQ(again.spheres.cell(), scene.spheres.cell());
  EXPECT_EQ(again.spheres.images().counts, scene.spheres.images().counts);
  EXPECT_EQ(again.spheres.centre(11), scene.spheres.centre(11));
  EXPECT_EQ(again.picture.cell_lines->colour, scene.picture.cell_lines->colour);
  EXPECT_EQ(scene_to_json(again), written);
}

TEST(CellOfScene, KeepsAlongWhichVectorsDistancesSeeImages) {
  const std::string slab = R"({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]],
    "cell": {"vectors": [[4, 0, 0], [0, 4, 0], [0, 0, 5]], "periodic": [true, true, false]}})";
  const Scene scene = parse_scene(slab, "a.json", {}).value().scene;
  EXPECT_EQ(scene.spheres.cell()->periodic, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(parse_scene(scene_to_json(scene), "a.json", {}).value().scene.spheres.cell(), scene.spheres.cell());

  ReadOptions options;
  options.periodic = false;
  EXPECT_EQ(parse_scene(slab, "a.json", options).value().scene.spheres.cell()->periodic, (std::array<bool, 3>{}));
}

TEST(CellOfScene, FaultsNameTheirPlace) {
  const auto error = [](const std::string& members) {
    return parse_scene(R"({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]], )" + members + "}", "a.json", {})
        .error()
        .to_string();
  };
  EXPECT_NE(error(R"("cell": {"vectors": [[1, 0, 0], [0, 1, 0]]})").find("/cell/vectors"), std::string::npos);
  EXPECT_NE(error(R"("replicate": [1, 2, 0])").find("/replicate/2"), std::string::npos);
  EXPECT_NE(error(R"("cell": {"vectors": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "periodic": [true, true]})")
                .find("/cell/periodic"),
            std::string::npos);
  EXPECT_NE(error(R"("replicate": [1, 2, 2])").find("no periodic cell to replicate by"), std::string::npos);
  EXPECT_NE(error(R"("wrapping": "yes")").find("/wrapping"), std::string::npos);
  EXPECT_NE(error(R"("picture": {"cell_lines": {"width_px": 17}})").find("/picture/cell_lines/width_px"),
            std::string::npos);
}

TEST(CellOfScene, TheCameraShowsIt) {
  const Scene scene = parse_scene(kDocument, "a.json", {}).value().scene;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = frame_with_cell(scene.spheres, side_of(ViewFrom::iso), {30, projection}, 300, 200);
    const PixelPlaces places(camera, 300, 200);
    for (int corner = 0; corner < 8; ++corner) {
      const Cell& cell = *scene.spheres.cell();
      const Vec3d at = cell.origin + ((corner & 1) != 0 ? 3.0 : 0) * cell.vectors[0] +
                       ((corner & 2) != 0 ? 1.0 : 0) * cell.vectors[1] +
                       ((corner & 4) != 0 ? 2.0 : 0) * cell.vectors[2];
      const Vec3d point = places.from_eye(at);
      EXPECT_GT(point.z, 0);
      EXPECT_GT(places.x_px(point), 300 * 0.03);
      EXPECT_LT(places.x_px(point), 300 * 0.97);
      EXPECT_GT(places.y_px(point), 200 * 0.03);
      EXPECT_LT(places.y_px(point), 200 * 0.97);
    }
  }
  SphereSet without = scene.spheres;
  without.cell().reset();
  EXPECT_EQ(frame_with_cell(without, side_of(ViewFrom::top), {}, 300, 200),
            frame_spheres(without, side_of(ViewFrom::top), {}, 300, 200));
}

TEST(ViewerCopies, AreSettings) {
  ViewerSettings settings;
  settings.picture.user.set("cell", true);
  settings.replicate = {2, 3, 1};
  const std::string json = settings_to_json(settings);
  EXPECT_NE(json.find(R"("cell":true)"), std::string::npos) << json;
  EXPECT_EQ(settings_from_json(json).value().replicate, settings.replicate);
  EXPECT_TRUE(settings_from_json(json).value().picture.result().cell_lines.has_value());
  EXPECT_FALSE(settings_from_json(R"({"replicate": null})", settings).value().replicate.has_value());
  for (const char* bad : {R"({"replicate": [1, 2]})", R"({"replicate": [1, 2, 0]})", R"({"replicate": 3})"})
    EXPECT_NE(settings_from_json(bad).error().to_string().find("/replicate"), std::string::npos) << bad;
}

TEST(ViewerCell, IsTheScenesUntilTheUserChanges) {
  Viewer viewer;
  viewer.resize(90, 60);
  ASSERT_TRUE(viewer.load(kDocument, "a.json").ok());
  EXPECT_TRUE(viewer.facts().has_cell);
  EXPECT_EQ(viewer.facts().copies, (std::array<std::int32_t, 3>{3, 1, 2}));
  ViewerSettings settings = viewer.settings();
  EXPECT_TRUE(settings.picture.result().cell_lines.has_value());
  EXPECT_EQ(render_settings(settings, 90, 60, 1).cell_lines->width_px, 3.5);
  const std::uint64_t with = picture_hash(viewer.picture(90, 60, 1).value());
  settings.picture.user.set("cell", false);
  ASSERT_TRUE(viewer.set(settings).ok());
  EXPECT_FALSE(render_settings(viewer.settings(), 90, 60, 1).cell_lines.has_value());
  EXPECT_NE(picture_hash(viewer.picture(90, 60, 1).value()), with);

  // The next scene brings its own.
  ASSERT_TRUE(viewer.load("x,y,z,r\n0,0,0,1\n", "a.csv").ok());
  EXPECT_FALSE(viewer.settings().picture.result().cell_lines.has_value());
  EXPECT_FALSE(viewer.facts().has_cell);
}

TEST(ViewerCell, StaysInThePictureWhileItTurns) {
  Viewer viewer;
  viewer.resize(160, 90);
  ReadOptions options;
  options.cell_vectors = {Vec3d{9, 0, 0}, Vec3d{0, 9, 0}, Vec3d{0, 0, 30}};
  ASSERT_TRUE(viewer.load("x,y,z,r\n0,0,0,1\n", "a.csv", options).ok());
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("cell", true);
  ASSERT_TRUE(viewer.set(settings).ok());
  for (int i = 0; i < 8; ++i) {
    const PixelPlaces places(viewer.settings().camera, 160, 90);
    for (const Vec3d corner : cell_corners(viewer.scene().spheres)) {
      const Vec3d seen = places.from_eye(corner);
      EXPECT_GT(seen.z, 0) << i;
      EXPECT_GT(places.x_px(seen), 0) << i;
      EXPECT_LT(places.x_px(seen), 160) << i;
      EXPECT_GT(places.y_px(seen), 0) << i;
      EXPECT_LT(places.y_px(seen), 90) << i;
    }
    viewer.orbit(15, 4);
  }
}

TEST(ViewerCopies, AreDrawnAndTakenBack) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load(kDocument, "a.json").ok());
  const std::int64_t own = viewer.scene().spheres.total_size();
  EXPECT_EQ(own, 12);
  ViewerSettings settings = viewer.settings();
  settings.replicate = {1, 2, 1};
  settings.picture.user.set("cell", true);
  ASSERT_TRUE(viewer.set(settings).ok());
  EXPECT_EQ(viewer.scene().spheres.total_size(), 4);
  const Result<PngPixels> two = viewer.picture(32, 24, 1);
  ASSERT_TRUE(two.ok());
  settings.view = View::traversal;
  EXPECT_FALSE(viewer.set(settings).ok());
  settings = viewer.settings();
  settings.replicate.reset();
  ASSERT_TRUE(viewer.set(settings).ok());
  EXPECT_EQ(viewer.scene().spheres.total_size(), own);

  // A set without a cell has no copies.
  ASSERT_TRUE(viewer.load("x,y,z,r\n0,0,0,1\n", "a.csv").ok());
  EXPECT_FALSE(viewer.settings().replicate.has_value());
  settings = viewer.settings();
  settings.replicate = {2, 1, 1};
  EXPECT_FALSE(viewer.set(settings).ok());
  EXPECT_EQ(viewer.scene().spheres.total_size(), 1);
}

}  // namespace
}  // namespace bihive
