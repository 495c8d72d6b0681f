// ctest: asan-long
#include "bihive/scene/looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bihive/scene/load_scene.h"

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Five spheres on the x axis.
Scene row() {
  Result<LoadedScene> loaded =
      load_scene("x,y,z,r,charge,part\n0,0,0,1,-1,a\n1,0,0,1,,b\n2,0,0,1,0,a\n3,0,0,1,1,c\n4,0,0,2,3,b\n", "a.csv");
  EXPECT_TRUE(loaded.ok());
  return std::move(loaded->scene);
}

std::vector<double> xs(const Scene& scene) {
  std::vector<double> x;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) x.push_back(scene.spheres.centre(id).x);
  return x;
}

std::vector<double> radii(const Scene& scene) {
  std::vector<double> r;
  for (std::int64_t id = 0; id < scene.spheres.size(); ++id) r.push_back(scene.spheres.radius(id));
  return r;
}

void apply(Scene& scene, const std::vector<Look>& looks) {
  const auto counts = apply_looks(scene, looks);
  EXPECT_TRUE(counts.ok()) << counts.error().to_string();
}

TEST(Looks, NoneChangesNothing) {
  Scene scene = row();
  apply(scene, {});
  apply(scene, {{"all", {}}});
  EXPECT_THAT(xs(scene), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_TRUE(scene.spheres.attributes().colour.empty());
  EXPECT_TRUE(scene.id_in_input.empty());
}

TEST(Looks, HiddenSpheresLeaveAndTheRestKeepsItsIdsAndAttributes) {
  Scene scene = row();
  scene.materials.resize(5);
  scene.material_of_sphere = {0, 1, 2, 3, 4};
  apply(scene, {{"part b", {SetShown{false}}}});
  EXPECT_THAT(xs(scene), ElementsAre(0, 2, 3));
  EXPECT_THAT(scene.id_in_input, ElementsAre(0, 2, 3));
  EXPECT_THAT(scene.material_of_sphere, ElementsAre(0, 2, 3));
  EXPECT_THAT(scene.spheres.attributes().find_numbers("charge")->values, ElementsAre(-1, 0, 1));
  EXPECT_EQ(scene.spheres.attributes().find_texts("part")->of(2), "c");
  EXPECT_EQ(input_id(scene, 1), 2);
  EXPECT_EQ(input_id(scene, -2), -2);

  // Twice: ids are still those of the input.
  apply(scene, {{"x = 2", {SetShown{false}}}});
  EXPECT_THAT(scene.id_in_input, ElementsAre(0, 3));
}

TEST(Looks, ALaterActionReplacesAnEarlierOne) {
  Scene scene = row();
  apply(scene,
        {{"all", {SetShown{false}}}, {"x > 2", {SetShown{true}, SetOpacity{0.25}}}, {"x > 3", {SetOpacity{0.5}}}});
  EXPECT_THAT(xs(scene), ElementsAre(3, 4));
  EXPECT_THAT(scene.spheres.attributes().opacity, ElementsAre(0.25F, 0.5F));
}

TEST(Looks, EverySelectionSeesTheSpheresAsTheyWere) {
  Scene scene = row();
  const auto counts = apply_looks(
      scene, {{"r = 1", {ScaleRadius{2}, SetShown{false}}}, {"r = 2", {ScaleRadius{3}}}, {"r = 1", {SetShown{true}}}});
  ASSERT_TRUE(counts.ok());
  EXPECT_THAT(*counts, ElementsAre(4, 1, 4));
  EXPECT_THAT(radii(scene), ElementsAre(2, 2, 2, 2, 6));
}

TEST(Looks, FactorsMultiply) {
  Scene scene = row();
  apply(scene, {{"all", {ScaleRadius{0.5}}}, {"index 0", {ScaleRadius{3}, ScaleRadius{0.5}}}});
  EXPECT_THAT(radii(scene), ElementsAre(0.75, 0.5, 0.5, 0.5, 1));
  EXPECT_THAT(xs(scene), ElementsAre(0, 1, 2, 3, 4)) << "centres are the same numbers";
}

TEST(Looks, ArraysHaveAValueForEachSphere) {
  Scene scene = row();
  const std::vector<Vec3d> colours{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}, {0, 0, 0}};
  apply(scene, {{"x > 1",
                 {ScaleRadius{3}, SetRadii{{9, 8, 0.5, 0.25, 2}}, ScaleRadius{2}, SetOpacities{{0, 0, 0.25, 0.5, 1}},
                  SetColours{colours, true}}}});
  EXPECT_THAT(radii(scene), ElementsAre(1, 1, 1, 0.5, 4));
  EXPECT_THAT(scene.spheres.attributes().opacity, ElementsAre(1, 1, 0.25F, 0.5F, 1));
  EXPECT_EQ(scene.spheres.attributes().colour[3], (Vec3f{0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(scene.spheres.attributes().colour[2], (Vec3f{0, 0, 1}));

  // Colours of the screen are those of texts.
  Scene screen = row(), text = row();
  apply(screen, {{"all", {SetColours{colours, false}}}});
  apply(text, {{"x = 3", {SetColour{std::string("srgb(0.5,0.5,0.5)")}}}});
  EXPECT_EQ(screen.spheres.attributes().colour[3], text.spheres.attributes().colour[3]);

  for (const LookAction& wrong :
       {LookAction(SetRadii{{1, 1}}), LookAction(SetRadii{{1, 1, 1, 1, -1}}), LookAction(SetOpacities{{1, 1, 1, 1}}),
        LookAction(SetOpacities{{1, 1, 1, 1, 1.5}}), LookAction(SetColours{{{1, 1, 1}}, true}),
        LookAction(SetColours{std::vector<Vec3d>(5, Vec3d{0, 2, 0}), false})}) {
    Scene untouched = row();
    std::size_t look = 9, action = 9;
    EXPECT_FALSE(apply_looks(untouched, {{"all", {SetOpacity{0.5}, wrong}}}, &look, &action).ok());
    EXPECT_EQ(look, 0u);
    EXPECT_EQ(action, 1u);
    EXPECT_TRUE(untouched.spheres.attributes().opacity.empty());
  }
}

TEST(Looks, AColourLeavesTheOthersTheColourOfTheirMaterial) {
  Scene scene = row();
  scene.materials.front().colour = {0.5, 0.25, 0.125};
  apply(scene, {{"index 1", {SetColour{std::string("red")}}}, {"index 2", {SetColour{Vec3d{0, 0.5, 1}}}}});
  const std::vector<Vec3f>& colour = scene.spheres.attributes().colour;
  EXPECT_EQ(colour[0], (Vec3f{0.5F, 0.25F, 0.125F}));
  EXPECT_EQ(colour[1], (Vec3f{1, 0, 0}));
  EXPECT_EQ(colour[2], (Vec3f{0, 0.5F, 1}));
}

TEST(Looks, AMaterialKeepsTheColoursAndStaysInStep) {
  Scene scene = row();
  scene.materials.resize(2);
  scene.materials[1].colour = {1, 0, 0};
  scene.material_of_sphere = {0, 1, 0, 1, 0};
  Material shiny;
  shiny.specular = 0.75;
  apply(scene, {{"index 1 2 3", {SetMaterial{shiny}}}, {"index 2", {SetShown{false}}}});
  ASSERT_EQ(scene.spheres.size(), 4);
  const std::vector<Vec3d> colours{{1, 1, 1}, {1, 0, 0}, {1, 0, 0}, {1, 1, 1}};
  for (std::int64_t id = 0; id < 4; ++id) {
    EXPECT_EQ(material_of(scene, id).specular, id == 0 || id == 3 ? scene.materials[0].specular : 0.75) << id;
    EXPECT_EQ(material_of(scene, id).colour, colours[static_cast<std::size_t>(id)]) << id;
  }
}

TEST(Looks, ATextColourIsThatOfTheScreen) {
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    Scene scene = row();
    scene.picture.transfer = transfer;
    apply(scene, {{"all", {SetColour{std::string("#808080")}}}});
    EXPECT_EQ(byte_from_radiance(double(scene.spheres.attributes().colour[0].x), transfer), 0x80);
  }
}

TEST(Looks, ErrorsLeaveTheSceneAndNameTheLook) {
  const struct {
    std::vector<Look> looks;
    std::size_t failed;
    const char* message;
  } cases[] = {
      {{{"all", {SetOpacity{0.5}}}, {"x >", {}}}, 1, "expected a number"},
      {{{"nothing < 3", {}}}, 0, "there is no attribute 'nothing'"},
      {{{"all", {ColourBy{"chrage", {}, {}, false, {}}}}},
       0,
       "there is no attribute \"chrage\"; did you mean 'charge'?"},
      {{{"all", {SetColour{std::string("reddish")}}}}, 0, "expected a colour, found \"reddish\""},
      {{{"all", {SetOpacity{1.5}}}}, 0, "an opacity lies between 0 and 1"},
      {{{"all", {ScaleRadius{-1}}}}, 0, "a factor for radii"},
      {{{"all", {SetShown{false}}}}, 1, "every sphere is hidden"},
      {{{"all", {ScaleRadius{1e39}}}}, 1, "single precision"},
  };
  for (const auto& one : cases) {
    Scene scene = row();
    std::size_t failed = 99;
    const auto counts = apply_looks(scene, one.looks, &failed);
    ASSERT_FALSE(counts.ok()) << one.message;
    EXPECT_THAT(counts.error().to_string(), HasSubstr(one.message));
    EXPECT_EQ(failed, one.failed) << one.message;
    EXPECT_EQ(scene.spheres.size(), 5);
    EXPECT_EQ(scene.spheres.attributes().numbers.size(), 1u);
    EXPECT_TRUE(scene.spheres.attributes().opacity.empty());
    EXPECT_TRUE(scene.spheres.attributes().colour.empty());
  }
}

std::string document(const std::string& version, const std::string& looks) {
  return R"({"bihive_scene": )" + version + R"(, "looks": )" + looks +
         R"(, "spheres": [[0,0,0,1], [1,0,0,1], [2,0,0,1], {"centre": [3,0,0], "radius": 1, "colour": "blue"}]})";
}

TEST(Looks, OfASceneFile) {
  const std::string looks =
      R"([{"select": "x > 0", "colour": "red", "radius_scale": 2}, {"select": "index 1", "show": false},
          {"colour_by": {"attribute": "x", "map": "magma", "range": [0, 2], "log": false, "nan_colour": "pink"}, "opacity": 0.5}])";
  const Result<LoadedScene> loaded = load_scene(document("2", looks), "a.json");
  ASSERT_TRUE(loaded.ok()) << loaded.error().to_string();
  EXPECT_THAT(xs(loaded->scene), ElementsAre(0, 2, 3));
  EXPECT_THAT(radii(loaded->scene), ElementsAre(1, 2, 2));
  EXPECT_THAT(loaded->scene.spheres.attributes().opacity, ElementsAre(0.5F, 0.5F, 0.5F));
  EXPECT_EQ(loaded->scene.spheres.attributes().colour[1], map_colour(ColourMap::magma, 1, Transfer::srgb));

  // Kept for a caller who adds more.
  const Result<LoadedScene> kept = load_scene(document("2", looks), "a.json", {}, LooksOfFile::keep);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->scene.spheres.size(), 4);
  ASSERT_EQ(kept->looks.size(), 3u);
  EXPECT_EQ(kept->looks[1].select, "index 1");

  // Written with the looks done, in the first version of the format.
  const std::string written = scene_to_json(loaded->scene);
  EXPECT_THAT(written, HasSubstr("\"bihive_scene\": 1,"));
  EXPECT_EQ(load_scene(written, "b.json")->scene.spheres.size(), 3);
}

TEST(Looks, FaultsOfASceneFileNameTheirPlace) {
  const auto error_of = [](const std::string& version, const std::string& looks) {
    const Result<LoadedScene> loaded = load_scene(document(version, looks), "a.json");
    EXPECT_FALSE(loaded.ok()) << looks;
    return loaded.ok() ? "" : loaded.error().to_string();
  };
  EXPECT_THAT(error_of("1", "[]"), HasSubstr("a.json: /looks: expected no such key in version 1 of the format"));
  EXPECT_THAT(error_of("2", R"([{}, {"select": "x > "}])"),
              HasSubstr("a.json: /looks/1/select: column 5: expected a number"));
  EXPECT_THAT(error_of("2", R"([{"colour_by": {"attribute": "q"}}])"),
              HasSubstr("/looks/0: there is no attribute \"q\""));
  EXPECT_THAT(error_of("2", R"([{"hide": true}])"),
              HasSubstr("/looks/0: unknown key \"hide\"; known keys: clip, colour, colour_by"));
  EXPECT_THAT(error_of("2", R"([{"opacity": 2}])"), HasSubstr("/looks/0/opacity: expected a number from 0 to 1"));
  EXPECT_THAT(error_of("2", R"([{"colour_by": {"attribute": "x", "map": "jet"}}])"),
              HasSubstr("expected one of viridis"));
  EXPECT_THAT(error_of("2", R"([{"colour_by": {"attribute": "x", "range": [2, 2]}}])"),
              HasSubstr("begins below its end"));
  EXPECT_THAT(error_of("2", R"([{"show": false}])"), HasSubstr("every sphere is hidden"));
}

}  // namespace
}  // namespace bihive
