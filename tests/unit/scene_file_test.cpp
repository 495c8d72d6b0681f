// The scene file: the scene is as the file says, and errors are clear.

#include "bihive/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "bihive/scene/generators.h"
#include "bihive/scene/palette.h"

namespace bihive {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Result<LoadedScene> parse(const std::string& json, const ReadOptions& options = {}) {
  return parse_scene(json, "a.json", options);
}

// A document of one sphere with more keys.
std::string with(const std::string& more) {
  return R"({"bihive_scene": 1, "spheres": [[0, 0, 0, 1]], )" + more + "}";
}

std::string with_spheres(const std::string& spheres) {
  return R"({"bihive_scene": 1, "materials": [{"name": "red"}, {"name": "glass"}], "spheres": )" + spheres + "}";
}

std::string error_of(const std::string& json, const ReadOptions& options = {}) {
  const Result<LoadedScene> loaded = parse(json, options);
  return loaded ? "no error" : loaded.error().to_string();
}

// --- Documents and their scenes ---------------------------------------------------------------------------------

TEST(SceneFile, TheSmallestDocumentHasTheDefaultsOfAFile) {
  const Result<LoadedScene> loaded = parse(R"({"bihive_scene": 1, "spheres": [[1, 2, 3, 4]]})");
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  const Scene& scene = loaded->scene;
  EXPECT_EQ(scene.spheres.size(), 1);
  EXPECT_EQ(scene.spheres.centre(0), (Vec3d{1, 2, 3}));
  EXPECT_EQ(scene.spheres.radius(0), 4);
  EXPECT_FALSE(loaded->has_camera);
  EXPECT_FALSE(loaded->has_lights);
  EXPECT_FALSE(scene.plane);
  EXPECT_FALSE(scene.seed);
  EXPECT_EQ(scene.name, "a.json");
  EXPECT_EQ(scene.background, (Vec3d{1, 1, 1}));
  EXPECT_EQ(scene.picture.width_px, 1280);
  EXPECT_EQ(scene.picture.height_px, 720);
  EXPECT_EQ(scene.picture.samples_per_pixel, 4);
  EXPECT_EQ(scene.picture.recursion, 5);
  EXPECT_TRUE(scene.picture.shadows);
  EXPECT_EQ(scene.picture.transfer, Transfer::srgb);
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].diffuse, matte_material().diffuse);
  EXPECT_TRUE(loaded->warnings.empty());
}

TEST(SceneFile, EveryKeyArrives) {
  const Result<LoadedScene> loaded = parse(R"({
    "bihive_scene": 1, "name": "all", "seed": 18446744073709551615,
    "camera": {"eye": [1, 2, 3], "look_at": [4, 5, 7], "up": [0, 0, 2], "fov_deg": 45.5},
    "lights": [{"position": [7, 8, 9]}, {"position": [1, 1, 1], "colour": [2, 0.5, 0]}],
    "materials": [{"name": "red", "colour": [0.9, 0.3, 0.25], "ambient": 0.1, "diffuse": 0.2, "reflective": 0.3,
                   "specular": 0.4, "power": 50, "transmissive": 0.6, "refraction_index": 0.95}],
    "plane": {"point": [0, -20, 0], "normal": [0, 5, 0], "material": {"ambient": 0.125},
              "checker": {"size": 2.5, "second_colour": [0.25, 0.5, 0.75], "fade_distance": 100}},
    "background": [0.125, 0.25, 0.5],
    "picture": {"width_px": 10, "height_px": 20, "samples_per_pixel": 9, "recursion": 2, "shadows": false,
                "transfer": "none"},
    "spheres": [[0, 0, 0, 1]]})");
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  const Scene& scene = loaded->scene;
  EXPECT_EQ(scene.name, "all");
  EXPECT_EQ(scene.seed, 18446744073709551615u);
  EXPECT_TRUE(loaded->has_camera);
  EXPECT_EQ(scene.camera.eye, (Vec3d{1, 2, 3}));
  EXPECT_EQ(scene.camera.look_at, (Vec3d{4, 5, 7}));
  EXPECT_EQ(scene.camera.up, (Vec3d{0, 0, 2}));
  EXPECT_EQ(scene.camera.fov_deg, 45.5);
  EXPECT_TRUE(loaded->has_lights);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].position, (Vec3d{7, 8, 9}));
  EXPECT_EQ(scene.lights[0].colour, (Vec3d{1, 1, 1}));
  EXPECT_EQ(scene.lights[1].colour, (Vec3d{2, 0.5, 0}));
  const Material& red = scene.materials.at(0);
  EXPECT_EQ(red.colour, (Vec3d{0.9, 0.3, 0.25}));
  EXPECT_EQ(red.ambient, 0.1);
  EXPECT_EQ(red.diffuse, 0.2);
  EXPECT_EQ(red.reflective, 0.3);
  EXPECT_EQ(red.specular, 0.4);
  EXPECT_EQ(red.power, 50);
  EXPECT_EQ(red.transmissive, 0.6);
  EXPECT_EQ(red.refraction_index, 0.95);
  ASSERT_TRUE(scene.plane);
  EXPECT_EQ(scene.plane->plane.point, (Vec3d{0, -20, 0}));
  EXPECT_EQ(scene.plane->plane.normal, (Vec3d{0, 1, 0}));
  EXPECT_EQ(scene.plane->material.ambient, 0.125);
  EXPECT_EQ(scene.plane->material.diffuse, matte_material().diffuse);
  ASSERT_TRUE(scene.plane->checker);
  EXPECT_EQ(scene.plane->checker->size, 2.5);
  EXPECT_EQ(scene.plane->checker->second_colour, (Vec3d{0.25, 0.5, 0.75}));
  EXPECT_EQ(scene.plane->checker->fade_distance, 100);
  EXPECT_EQ(scene.background, (Vec3d{0.125, 0.25, 0.5}));
  EXPECT_EQ(scene.picture.width_px, 10);
  EXPECT_EQ(scene.picture.height_px, 20);
  EXPECT_EQ(scene.picture.samples_per_pixel, 9);
  EXPECT_EQ(scene.picture.recursion, 2);
  EXPECT_FALSE(scene.picture.shadows);
  EXPECT_EQ(scene.picture.transfer, Transfer::none);
}

TEST(SceneFile, TextColoursAreWhatTheScreenShows) {
  const auto background = [](const std::string& transfer) {
    return parse(with(R"("background": "#ff8000", "picture": {"transfer": ")" + transfer + "\"}"))->scene.background;
  };
  EXPECT_EQ(background("none"), (Vec3d{1, 128 / 255.0, 0}));
  EXPECT_EQ(background("srgb"), (Vec3d{1, linear_from_srgb(128 / 255.0), 0}));
  EXPECT_EQ(parse(with(R"("background": "blue")"))->scene.background, (Vec3d{0, 0, 1}));
}

TEST(SceneFile, SpheresTakeMaterialsByNameAndPosition) {
  const Result<LoadedScene> loaded = parse(with_spheres(
      R"([[0,0,0,1], [0,0,0,1,1], [0,0,0,1,"glass"], [0,0,0,1,"red"], {"centre": [5,6,7], "radius": 8, "material": 1}])"));
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_EQ(loaded->scene.material_of_sphere, (std::vector<std::int32_t>{0, 1, 1, 0, 1}));
  EXPECT_EQ(loaded->scene.spheres.centre(4), (Vec3d{5, 6, 7}));
  EXPECT_EQ(loaded->scene.spheres.radius(4), 8);
}

TEST(SceneFile, OwnColourAndOpacityLeaveTheOthersAlone) {
  const Result<LoadedScene> loaded = parse(R"({"bihive_scene": 1,
    "materials": [{"name": "a"}, {"name": "b", "colour": [0.25, 0.5, 0.75]}],
    "spheres": [{"centre": [0,0,0], "radius": 1, "colour": [0, 1, 0], "opacity": 0.5}, [1,1,1,1], [2,2,2,1,"b"]]})");
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  const SphereAttributes& attributes = loaded->scene.spheres.attributes();
  EXPECT_EQ(attributes.colour, (std::vector<Vec3f>{{0, 1, 0}, {1, 1, 1}, {0.25f, 0.5f, 0.75f}}));
  EXPECT_EQ(attributes.opacity, (std::vector<float>{0.5f, 1, 1}));
}

TEST(SceneFile, RadiusOptionsReachInlineSpheres) {
  ReadOptions options;
  options.radius = 3;
  options.radius_scale = 0.5;
  EXPECT_EQ(parse(with_spheres("[[0,0,0,1]]"), options)->scene.spheres.radius(0), 1.5);
  options.radius.reset();
  EXPECT_EQ(parse(with_spheres("[[0,0,0,1]]"), options)->scene.spheres.radius(0), 0.5);
}

// A folder with a molecule of two atoms in it.
class SceneFileWithMolecule : public testing::Test {
 protected:
  SceneFileWithMolecule() : folder_(testing::TempDir() + "scene_file_test_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ + "/two.xyz") << "2\ntwo atoms\nC 10 20 30\nO 12 20 30\n";
  }
  ~SceneFileWithMolecule() override { std::filesystem::remove_all(folder_); }

  Result<LoadedScene> load(const std::string& more, const ReadOptions& options = {},
                           const std::string& before = "") const {
    const std::string materials = R"("materials": [{"name": "plain"}, {"name": "red", "colour": "red"}], )";
    const std::string json =
        R"({"bihive_scene": 1, )" + before + materials + R"("spheres": {"file": "two.xyz")" + more + "}}";
    return parse_scene(json, folder_ + "/scene.json", options);
  }

 private:
  std::string folder_;
};

TEST_F(SceneFileWithMolecule, PathsStartFromTheDocument) {
  const Result<LoadedScene> loaded = load("");
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_EQ(loaded->scene.spheres.size(), 2);
  EXPECT_EQ(loaded->scene.spheres.centre(1), (Vec3d{12, 20, 30}));
  EXPECT_EQ(loaded->frames, 1);
  EXPECT_FALSE(loaded->rules.empty());
}

TEST_F(SceneFileWithMolecule, TheCallersWishesGoFirst) {
  EXPECT_EQ(load(R"(, "radius": 2, "radius_scale": 0.5)")->scene.spheres.radius(0), 1);
  ReadOptions options;
  options.radius = 8;
  options.radius_scale = 2;
  EXPECT_EQ(load(R"(, "radius": 2, "radius_scale": 0.5)", options)->scene.spheres.radius(0), 8);
  EXPECT_EQ(load(R"(, "recenter": true)")->scene.spheres.centre(1), (Vec3d{1, 0, 0}));
  EXPECT_FALSE(load(R"(, "frame": 1)"));
}

TEST(SceneFile, RecentringFromOutsideMovesEverythingAlong) {
  ReadOptions options;
  options.recenter = true;
  const Result<LoadedScene> loaded = parse(R"({"bihive_scene": 1, "spheres": [[10, 20, 30, 1], [12, 20, 30, 1]],
    "camera": {"eye": [11, 20, 40], "look_at": [11, 20, 30]}, "lights": [{"position": [0, 0, 0]}],
    "plane": {"point": [0, 15, 0], "normal": [0, 1, 0]}})",
                                           options);
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_EQ(loaded->recentred_by, (Vec3d{11, 20, 30}));
  EXPECT_EQ(loaded->scene.spheres.centre(0), (Vec3d{-1, 0, 0}));
  EXPECT_EQ(loaded->scene.camera.eye, (Vec3d{0, 0, 10}));
  EXPECT_EQ(loaded->scene.camera.look_at, (Vec3d{0, 0, 0}));
  EXPECT_EQ(loaded->scene.lights.at(0).position, (Vec3d{-11, -20, -30}));
  EXPECT_EQ(loaded->scene.plane->plane.point, (Vec3d{-11, -5, -30}));
}

TEST(SceneFile, CoarseRoundingIsWarnedOf) {
  const Result<LoadedScene> loaded = parse(with_spheres("[[0, 0, 0, 0.001], [1234567.1, 0, 0, 0.001]]"));
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_THAT(loaded->warnings[0], HasSubstr("the radii are too small for the extent"));
}

TEST_F(SceneFileWithMolecule, TheDocumentsOwnRecentringLeavesItsCamera) {
  const std::string camera = R"("camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0]}, )";
  ReadOptions options;
  EXPECT_EQ(load(R"(, "recenter": true)", options, camera)->scene.camera.eye, (Vec3d{0, 0, 9}));
  options.recenter = true;
  EXPECT_EQ(load(R"(, "recenter": true)", options, camera)->scene.camera.eye, (Vec3d{0, 0, 9}));
  EXPECT_EQ(load("", options, camera)->scene.camera.eye, (Vec3d{-11, -20, -21}));
}

TEST_F(SceneFileWithMolecule, AStatedColourGoesBeforeTheElements) {
  const Result<LoadedScene> by_element = load(R"(, "material": "plain")");
  ASSERT_EQ(by_element->scene.spheres.attributes().colour.size(), 2u);
  EXPECT_EQ(by_element->scene.spheres.attributes().colour[1], element_colour(8));
  const Result<LoadedScene> red = load(R"(, "material": "red")");
  EXPECT_TRUE(red->scene.spheres.attributes().colour.empty());
  EXPECT_EQ(red->scene.material_of_sphere, (std::vector<std::int32_t>{1, 1}));
}

TEST(SceneFile, EmptyLightsAreLights) {
  const Result<LoadedScene> loaded = parse(with(R"("lights": [])"));
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->has_lights);
  EXPECT_TRUE(loaded->scene.lights.empty());
}

TEST(SceneFile, NormalsOfAnyLengthBecomeUnits) {
  for (const char* normal : {"[0, 1e-38, 0]", "[0, 3e38, 0]", "[0, 17, 0]"})
    EXPECT_EQ(
        parse(with(R"("plane": {"point": [0,0,0], "normal": )" + std::string(normal) + "}"))->scene.plane->plane.normal,
        (Vec3d{0, 1, 0}))
        << normal;
}

TEST(SceneFile, LooksLikeAScene) {
  EXPECT_TRUE(looks_like_scene("{}"));
  EXPECT_TRUE(looks_like_scene(" \r\n\t{"));
  EXPECT_TRUE(looks_like_scene("\xEF\xBB\xBF {"));
  EXPECT_FALSE(looks_like_scene(""));
  EXPECT_FALSE(looks_like_scene("[{}]"));
  EXPECT_FALSE(looks_like_scene("1 2 3 {"));
}

// --- Errors -----------------------------------------------------------------------------------------------------

TEST(SceneFileErrors, NameThePathAndWhatWasExpected) {
  const std::pair<const char*, const char*> cases[] = {
      {R"("materials": [{"name": "a", "power": -3}])",
       "a.json: /materials/0/power: expected a number above 0, found -3"},
      {R"("materials": [{"name": "a"}, {"name": "b", "colour": [0, 2, 0]}])",
       "a.json: /materials/1/colour/1: expected a number from 0 to 1, found 2"},
      {R"("materials": [{"name": "a", "colour": "reddish"}])",
       "a.json: /materials/0/colour: expected \"#rrggbb\" or one of "},
      {R"("materials": [{"name": "a", "colour": [0, 1]}])",
       "a.json: /materials/0/colour: expected three numbers [r, g, b] from 0 to 1, found an array of 2"},
      {R"("materials": [{"name": "a", "colour": 7}])", "a.json: /materials/0/colour: expected a colour: [r, g, b] "},
      {R"("materials": [])", "a.json: /materials: expected an array of at least one material, found an array of 0"},
      {R"("materials": [{}])", "a.json: /materials/0: the key \"name\" is missing"},
      {R"("camera": {"eye": [0, 0, 1]})", "a.json: /camera: the key \"look_at\" is missing"},
      {R"("camera": {"eye": [0, 0, 1], "look_at": [0, 0, "0"]})",
       "a.json: /camera/look_at/2: expected a number between -3.4e38 and 3.4e38, found \"0\""},
      {R"("camera": {"eye": [0, 0, 1], "look_at": [0, 0, 0], "fov_deg": 180})",
       "a.json: /camera/fov_deg: expected a number above 0 and below 180, found 180"},
      {R"("picture": {"width_px": 0})", "a.json: /picture/width_px: expected a whole number from 1 to 65535, found 0"},
      {R"("picture": {"width_px": 2.5})",
       "a.json: /picture/width_px: expected a whole number from 1 to 65535, found 2.5"},
      {R"("picture": {"recursion": 17})", "a.json: /picture/recursion: expected a whole number from 1 to 16, found 17"},
      {R"("picture": {"transfer": "gamma"})", "a.json: /picture/transfer: expected one of srgb, none, found \"gamma\""},
      {R"("picture": {"shadows": 1})", "a.json: /picture/shadows: expected true or false, found 1"},
      {R"("lights": {"position": [0, 0, 0]})", "a.json: /lights: expected an array of lights, found an object"},
      {R"("lights": [{"position": [0, 0, 0], "colour": [0, 0, -1]}])",
       "a.json: /lights/0/colour/2: expected a number of at least 0, found -1"},
      {R"("seed": -1)", "a.json: /seed: expected a whole number from 0 to 18446744073709551615, found -1"},
      {R"("seed": 18446744073709551616)",
       "a.json: /seed: expected a whole number from 0 to 18446744073709551615, found "},
      {R"("background": null)", "a.json: /background: expected a colour"},
      {R"("plane": {"point": [0, 0, 0], "normal": [0, 1, 0], "checker": {"size": 0, "second_colour": "red"}})",
       "a.json: /plane/checker/size: expected a number above 0, found 0"},
  };
  for (const auto& [more, message] : cases) EXPECT_THAT(error_of(with(more)), StartsWith(message));
}

TEST(SceneFileErrors, OfSpheres) {
  const std::pair<const char*, const char*> cases[] = {
      {"[]", "/spheres: expected an array of at least one sphere, found an array of 0"},
      {"7", "/spheres: expected an array of at least one sphere, or an object that names a file, found 7"},
      {"[[0, 0, 0, 1], [0, 0, 0]]",
       "/spheres/1: expected [x, y, z, radius] or [x, y, z, radius, material], found an array of 3"},
      {"[[0, 0, 0, 1, 0, 0]]",
       "/spheres/0: expected [x, y, z, radius] or [x, y, z, radius, material], found an array of 6"},
      {"[[0, 0, 0, -1]]", "/spheres/0/3: expected a number from 0 to 3.4e38, found -1"},
      {"[[0, 0, 1e39, 1]]", "/spheres/0/2: expected a number between -3.4e38 and 3.4e38, found 1e+39"},
      {"[[0, 0, null, 1]]", "/spheres/0/2: expected a number between -3.4e38 and 3.4e38, found null"},
      {"[[0, 0, 0, 1, 2]]", "/spheres/0/4: expected a material's position from 0 to 1, found 2"},
      {"[[0, 0, 0, 1, -1]]", "/spheres/0/4: expected a material's position from 0, found -1"},
      {"[[0, 0, 0, 1, \"blue\"]]", "/spheres/0/4: no material is called \"blue\"; known materials: glass, red"},
      {R"([{"centre": [0, 0, 0]}])", "/spheres/0: the key \"radius\" is missing"},
      {R"([{"centre": [0, 0, 0], "radius": 1, "opacity": 1.5}])",
       "/spheres/0/opacity: expected a number from 0 to 1, found 1.5"},
      {R"([{"centre": [0, 0, 0], "radius": 1, "material": "x"}])", "/spheres/0/material: no material is called \"x\""},
      {R"({})", "/spheres: the key \"file\" is missing"},
      {R"({"file": ""})", "/spheres/file: expected a path of at least one character, found \"\""},
      {R"({"file": "no such file.xyz"})", "/spheres/file: no such file.xyz: "},
      {R"({"file": "a.pdb", "frame": -1})", "/spheres/frame: expected a whole number from 0 to "},
  };
  for (const auto& [spheres, message] : cases)
    EXPECT_THAT(error_of(with_spheres(spheres)), StartsWith("a.json: " + std::string(message)));
}

TEST(SceneFileErrors, UnknownKeysListTheKnownOnes) {
  EXPECT_EQ(error_of(with(R"("lights": [{"position": [0,0,0], "color": "red"}])")),
            "a.json: /lights/0: unknown key \"color\"; known keys: colour, position, radius");
  EXPECT_THAT(error_of(with(R"("sphere": 1)")), StartsWith("a.json: /: unknown key \"sphere\"; known keys: "));
}

TEST(SceneFileErrors, BeyondTheSchema) {
  EXPECT_THAT(error_of(with(R"("camera": {"eye": [1, 2, 3], "look_at": [1, 2, 3]})")), StartsWith("a.json: /camera: "));
  EXPECT_THAT(error_of(with(R"("camera": {"eye": [0, 9, 0], "look_at": [0, 0, 0]})")), StartsWith("a.json: /camera: "));
  EXPECT_THAT(error_of(with(R"("plane": {"point": [0,0,0], "normal": [0,0,0]})")),
              StartsWith("a.json: /plane/normal: "));
  EXPECT_THAT(error_of(with(R"("materials": [{"name": "a"}, {"name": "a"}])")),
              StartsWith("a.json: /materials/1/name: "));
  EXPECT_THAT(error_of(with(R"("materials": [{"name": "a", "transmissive": 0.5, "refraction_index": 0}])")),
              StartsWith("a.json: /materials/0/refraction_index: expected a number above 0"));
  ReadOptions options;
  options.frame = 1;
  EXPECT_THAT(error_of(with_spheres("[[0,0,0,1]]"), options), HasSubstr("there is no frame 1"));
}

TEST(SceneFileErrors, BrokenJsonHasAPlace) {
  EXPECT_THAT(error_of("{\n  \"bihive_scene\": 1,\n  spheres: []}"), StartsWith("a.json:3:3: not valid JSON: "));
  EXPECT_THAT(error_of(""), StartsWith("a.json:1:1: not valid JSON: "));
  EXPECT_THAT(error_of("{\"bihive_scene\": 1, \"spheres\": [[0, 0, 0, 1e999]]}"), StartsWith("a.json:1:"));
  EXPECT_THAT(error_of("{\"name\": \"\xff\"}"), StartsWith("a.json:1:"));
}

TEST(SceneFileErrors, BytesThatAreNoTextStayOutOfMessages) {
  EXPECT_THAT(error_of("{\"name\": \xff}"), testing::EndsWith("last read: '\"name\": ?'"));
  EXPECT_THAT(error_of("{\"na\x7f\": 1}"), HasSubstr("unknown key \"na?\""));
}

TEST(SceneFileErrors, TheVersionMustBeKnown) {
  EXPECT_EQ(error_of(R"({"spheres": [[0,0,0,1]]})"), "a.json: /: the key \"bihive_scene\" is missing");
  EXPECT_EQ(error_of(R"({"bihive_scene": 3, "spheres": [[0,0,0,1]]})"),
            "a.json: /bihive_scene: expected 1 or 2, found 3");
  EXPECT_THAT(error_of("[]"), StartsWith("a.json: /: expected a bihive scene"));
}

TEST(SceneFileErrors, AKeyMayOccurOnce) {
  EXPECT_EQ(error_of(R"({"bihive_scene": 1, "spheres": [[0,0,0,1]], "spheres": [[1,1,1,1]]})"),
            "a.json: the key \"spheres\" occurs twice in one object");
}

TEST(SceneFileErrors, CutAnywhereIsAnErrorInOneLine) {
  const std::string whole = scene_to_json(four_spheres_scene());
  ASSERT_TRUE(parse(whole));
  const std::size_t end = whole.find_last_of('}');
  for (std::size_t size = 0; size <= end; ++size) {
    const Result<LoadedScene> loaded = parse(whole.substr(0, size));
    ASSERT_FALSE(loaded) << size;
    EXPECT_THAT(loaded.error().message, StartsWith("not valid JSON: "));
    EXPECT_GT(loaded.error().line, 0);
    EXPECT_EQ(loaded.error().to_string().find('\n'), std::string::npos);
  }
}

TEST(SceneFileErrors, DeepNestingIsHarmless) {
  const auto nested = [](std::size_t depth) {
    return error_of(with("\"background\": " + std::string(depth, '[') + std::string(depth, ']')));
  };
  EXPECT_THAT(nested(60), StartsWith("a.json: /background: expected"));
  EXPECT_THAT(nested(100000), HasSubstr("arrays and objects lie more than 64 deep in each other"));
}

// --- There and back ---------------------------------------------------------------------------------------------

void expect_equal(const Material& a, const Material& b) {
  EXPECT_EQ(a.colour, b.colour);
  EXPECT_EQ(a.ambient, b.ambient);
  EXPECT_EQ(a.diffuse, b.diffuse);
  EXPECT_EQ(a.reflective, b.reflective);
  EXPECT_EQ(a.specular, b.specular);
  EXPECT_EQ(a.power, b.power);
  EXPECT_EQ(a.transmissive, b.transmissive);
  EXPECT_EQ(a.refraction_index, b.refraction_index);
  EXPECT_EQ(a.tint, b.tint);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.glow, b.glow);
}

void expect_equal(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.camera.eye, b.camera.eye);
  EXPECT_EQ(a.camera.look_at, b.camera.look_at);
  EXPECT_EQ(a.camera.up, b.camera.up);
  EXPECT_EQ(a.camera.fov_deg, b.camera.fov_deg);
  EXPECT_EQ(a.camera.projection, b.camera.projection);
  EXPECT_EQ(a.camera.aperture, b.camera.aperture);
  EXPECT_EQ(a.camera.focus, b.camera.focus);
  EXPECT_TRUE(a.camera.shorter_side == b.camera.shorter_side || a.camera.projection == Projection::perspective);
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.ambient_light, b.ambient_light);
  EXPECT_EQ(a.picture.light_points, b.picture.light_points);
  ASSERT_EQ(a.picture.outline.has_value(), b.picture.outline.has_value());
  if (a.picture.outline) {
    EXPECT_EQ(a.picture.outline->width_px, b.picture.outline->width_px);
    EXPECT_EQ(a.picture.outline->step, b.picture.outline->step);
    EXPECT_EQ(a.picture.outline->colour, b.picture.outline->colour);
  }
  ASSERT_EQ(a.picture.fog.has_value(), b.picture.fog.has_value());
  if (a.picture.fog) {
    EXPECT_EQ(a.picture.fog->start, b.picture.fog->start);
    EXPECT_EQ(a.picture.fog->end, b.picture.fog->end);
    EXPECT_EQ(a.picture.fog->strength, b.picture.fog->strength);
  }
  EXPECT_EQ(a.picture.width_px, b.picture.width_px);
  EXPECT_EQ(a.picture.height_px, b.picture.height_px);
  EXPECT_EQ(a.picture.samples_per_pixel, b.picture.samples_per_pixel);
  EXPECT_EQ(a.picture.recursion, b.picture.recursion);
  EXPECT_EQ(a.picture.shadows, b.picture.shadows);
  EXPECT_EQ(a.picture.transfer, b.picture.transfer);
  EXPECT_EQ(a.picture.transparent, b.picture.transparent);
  EXPECT_EQ(a.picture.adaptive_samples, b.picture.adaptive_samples);
  EXPECT_EQ(a.picture.tone.exposure_stops, b.picture.tone.exposure_stops);
  EXPECT_EQ(a.picture.tone.curve, b.picture.tone.curve);
  ASSERT_EQ(a.picture.ambient_occlusion.has_value(), b.picture.ambient_occlusion.has_value());
  if (a.picture.ambient_occlusion) {
    EXPECT_EQ(a.picture.ambient_occlusion->distance, b.picture.ambient_occlusion->distance);
    EXPECT_EQ(a.picture.ambient_occlusion->directions, b.picture.ambient_occlusion->directions);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].position, b.lights[i].position);
    EXPECT_EQ(a.lights[i].colour, b.lights[i].colour);
    EXPECT_EQ(a.lights[i].radius, b.lights[i].radius);
  }
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) expect_equal(a.materials[i], b.materials[i]);
  ASSERT_EQ(a.plane.has_value(), b.plane.has_value());
  if (a.plane) {
    EXPECT_EQ(a.plane->plane.point, b.plane->plane.point);
    EXPECT_EQ(a.plane->plane.normal, b.plane->plane.normal);
    expect_equal(a.plane->material, b.plane->material);
    ASSERT_EQ(a.plane->checker.has_value(), b.plane->checker.has_value());
    if (a.plane->checker) {
      EXPECT_EQ(a.plane->checker->size, b.plane->checker->size);
      EXPECT_EQ(a.plane->checker->second_colour, b.plane->checker->second_colour);
      EXPECT_EQ(a.plane->checker->fade_distance, b.plane->checker->fade_distance);
    }
  }
  EXPECT_EQ(a.spheres.scale_exponent(), b.spheres.scale_exponent());
  EXPECT_EQ(a.spheres.x(), b.spheres.x());
  EXPECT_EQ(a.spheres.y(), b.spheres.y());
  EXPECT_EQ(a.spheres.z(), b.spheres.z());
  EXPECT_EQ(a.spheres.r(), b.spheres.r());
  EXPECT_EQ(a.spheres.attributes().colour, b.spheres.attributes().colour);
  EXPECT_EQ(a.spheres.attributes().opacity, b.spheres.attributes().opacity);
  EXPECT_EQ(a.spheres.attributes().outline_px, b.spheres.attributes().outline_px);
  EXPECT_EQ(a.spheres.attributes().crease, b.spheres.attributes().crease);
  EXPECT_EQ(a.material_of_sphere, b.material_of_sphere);
}

void expect_there_and_back(const Scene& scene) {
  const Result<LoadedScene> loaded = parse_scene(scene_to_json(scene), scene.name, {});
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_TRUE(loaded->has_camera);
  EXPECT_TRUE(loaded->has_lights);
  expect_equal(loaded->scene, scene);
}

TEST(SceneFileWriting, FourSpheresComeBack) {
  expect_there_and_back(four_spheres_scene());
}

TEST(SceneFileWriting, PlanesOfShadowsComeBackInVersion2) {
  Scene scene = four_spheres_scene();
  scene.plane->shadows_only = true;
  EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
  const Result<LoadedScene> loaded = parse_scene(scene_to_json(scene), "a.json", {});
  ASSERT_TRUE(loaded.ok()) << loaded.error().to_string();
  EXPECT_TRUE(loaded->scene.plane->shadows_only);
  expect_there_and_back(scene);
}

TEST(SceneFileWriting, AmbientOcclusionComesBackInVersion2) {
  Scene scene = four_spheres_scene();
  EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 1,"));
  scene.picture.ambient_occlusion = {0.1, 77};
  EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
  expect_there_and_back(scene);
  scene.picture.ambient_occlusion = AmbientOcclusion{};
  expect_there_and_back(scene);
}

TEST(SceneFileWriting, EachPartOfALookComesBackInVersion2) {
  const std::vector<std::function<void(Scene&)>> changes{
      [](Scene& scene) {
        scene.lights.push_back({{1, 2, 3}, {1, 0.5, 2}, 0.1});
      },
      [](Scene& scene) {
        scene.ambient_light = {0.1, 2, 1};
      },
      [](Scene& scene) { scene.materials[0].tint = 0.3; },
      [](Scene& scene) { scene.materials[0].bands = 3; },
      [](Scene& scene) { scene.plane->material.glow = 0.7; },
      [](Scene& scene) { scene.picture.light_points = 3; },
      [](Scene& scene) {
        scene.picture.outline = Outline{1.5, 0.1, {0.1, 0.2, 0.3}};
      },
      [](Scene& scene) { scene.spheres.attributes().outline_px = {-1, 0, 1.5F, 16, -1, 2, 3, 4}; },
      [](Scene& scene) { scene.spheres.attributes().crease = {0, 1, 2, 3, 0, 0, 5, 1}; },
      [](Scene& scene) {
        scene.picture.fog = Fog{-0.1, 0.7, 0.3};
      }};
  for (const auto& change : changes) {
    Scene scene = *scenario_scene(Scenario::grid, {8, 0.3f, 1});
    EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 1,"));
    change(scene);
    EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
    expect_there_and_back(scene);
  }
}

TEST(SceneFileWriting, AnOrthographicCameraComesBackInVersion2) {
  Scene scene = four_spheres_scene();
  scene.camera.projection = Projection::orthographic;
  scene.camera.shorter_side = 0.1;
  EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
  expect_there_and_back(scene);
}

TEST(SceneFileWriting, ATransparentPictureComesBackInVersion2) {
  Scene scene = four_spheres_scene();
  scene.picture.transparent = true;
  EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
  expect_there_and_back(scene);
}

TEST(SceneFileWriting, ToneLensAndAdaptiveSamplesComeBackInVersion2) {
  const std::vector<std::function<void(Scene&)>> changes{
      [](Scene& scene) { scene.picture.tone.exposure_stops = -0.3; },
      [](Scene& scene) { scene.picture.tone.curve = ToneCurve::filmic; },
      [](Scene& scene) { scene.camera.aperture = 0.7; },
      [](Scene& scene) {
        scene.camera.aperture = 0.1;
        scene.camera.focus = 12.3;
      },
      [](Scene& scene) {
        scene.picture.adaptive_samples = true;
        scene.picture.samples_per_pixel = 4;
      }};
  for (const auto& change : changes) {
    Scene scene = four_spheres_scene();
    change(scene);
    EXPECT_THAT(scene_to_json(scene), HasSubstr("\"bihive_scene\": 2,"));
    expect_there_and_back(scene);
  }
}

TEST(SceneFile, OrthographicWithoutAShorterSideShowsWhatTheAngleShows) {
  const auto loaded = parse(R"({"bihive_scene": 2, "camera": {"eye": [0, 0, 10], "look_at": [0, 0, 0], "fov_deg": 90,
                             "projection": "orthographic"}, "spheres": [[0,0,0,1]]})");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->scene.camera.projection, Projection::orthographic);
  EXPECT_NEAR(loaded->scene.camera.shorter_side, 20, 1e-12);
}

TEST(SceneFileErrors, ABadProjection) {
  const auto with_camera = [](int version, const std::string& keys) {
    return error_of("{\"bihive_scene\": " + std::to_string(version) +
                    R"(, "camera": {"eye": [0, 0, 10], "look_at": [0, 0, 0], )" + keys +
                    R"(}, "spheres": [[0,0,0,1]]})");
  };
  EXPECT_THAT(with_camera(1, R"("projection": "orthographic")"),
              StartsWith("a.json: /camera/projection: expected no such key in version 1 of the format"));
  EXPECT_THAT(with_camera(2, R"("projection": "fisheye")"),
              StartsWith("a.json: /camera/projection: expected \"perspective\" or \"orthographic\", found"));
  EXPECT_THAT(with_camera(2, R"("projection": "orthographic", "shorter_side": 0)"),
              StartsWith("a.json: /camera/shorter_side: expected a number above 0"));
  EXPECT_THAT(with_camera(2, R"("shorter_side": 3)"),
              StartsWith("a.json: /camera/shorter_side: expected no such key without the projection orthographic"));
}

TEST(SceneFileErrors, ANewKeyNeedsItsVersion) {
  for (const char* text :
       {R"("lights": [{"position": [0, 0, 0], "radius": 1}])", R"("ambient_light": [1, 1, 1])",
        R"("materials": [{"name": "a", "tint": 1}])", R"("picture": {"outline": {}})", R"("picture": {"fog": {}})",
        R"("picture": {"light_points": 2})", R"("picture": {"exposure": 1})", R"("picture": {"tone": "none"})",
        R"("picture": {"samples_per_pixel": "auto"})",
        R"("camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0], "aperture": 0})",
        R"("camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0], "focus": 1})"})
    EXPECT_THAT(error_of(std::string(R"({"bihive_scene": 1, "spheres": [[0,0,0,1]], )") + text + "}"),
                HasSubstr("expected no such key in version 1 of the format"));
  for (const char* key : {"outline", "crease"})
    EXPECT_THAT(error_of(std::string(R"({"bihive_scene": 1, "spheres": [{"centre": [0,0,0], "radius": 1, ")") + key +
                         R"(": 1}]})"),
                StartsWith(std::string("a.json: /spheres/0/") + key + ": expected no such key in version 1"));
  EXPECT_THAT(error_of(R"({"bihive_scene": 1, "picture": {"transparent": false}, "spheres": [[0,0,0,1]]})"),
              StartsWith("a.json: /picture/transparent: expected no such key in version 1 of the format"));
  EXPECT_THAT(error_of(R"({"bihive_scene": 1, "picture": {"ambient_occlusion": {}}, "spheres": [[0,0,0,1]]})"),
              StartsWith("a.json: /picture/ambient_occlusion: expected no such key in version 1 of the format"));
  EXPECT_THAT(
      error_of(R"({"bihive_scene": 2, "picture": {"ambient_occlusion": {"distance": 0}}, "spheres": [[0,0,0,1]]})"),
      StartsWith("a.json: /picture/ambient_occlusion/distance: expected a number above 0"));
}

TEST(SceneFileWriting, ScenariosComeBack) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed})
    expect_there_and_back(*scenario_scene(scenario, {1000, 0.3f, 18446744073709551615u}));
}

TEST(SceneFileWriting, HardNumbersComeBack) {
  Scene scene = four_spheres_scene();
  scene.material_of_sphere.clear();
  scene.name = "\"quoted\"\n\tand \xC3\xA9";
  scene.camera.eye = {0.1, 1e-300, -1.0 / 3};
  scene.spheres =
      *SphereSet::from_world(std::vector<double>{1e-45, 0.1f, -0.0, 16777217},
                             {3.4028234663852886e38, 1e-38, 1e30, 123456.789}, {1, 2, 3, -4}, {0, 1e-44, 1e10, 5});
  scene.spheres.attributes().colour = {{0.1f, 0.2f, 0.3f}, {1, 1, 1}, {0, 0, 0}, {1e-10f, 0.5f, 1}};
  scene.spheres.attributes().opacity = {0.1f, 1, 0, 0.3f};
  expect_there_and_back(scene);
}

TEST(SceneFileWriting, WorldsOfAnySizeComeBack) {
  for (const double unit : {1e-30, 1e-20, 1e-10, 1e10, 1e20, 1e30}) {
    Scene scene = four_spheres_scene();
    scene.material_of_sphere.clear();
    scene.spheres = *SphereSet::from_world(std::vector<double>{0.7 * unit, -0.3 * unit}, {0.1 * unit, 1e-9 * unit},
                                           {unit, unit / 3}, {unit / 7, 1e-6 * unit});
    expect_there_and_back(scene);
  }
}

TEST(SceneFileWriting, NumbersAreShort) {
  EXPECT_THAT(scene_to_json(*scenario_scene(Scenario::grid, {8, 0.1f, 1})), HasSubstr(", 0.1]"));
}

}  // namespace
}  // namespace bihive
