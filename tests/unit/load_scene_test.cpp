// From a name or bytes to a scene.
#include "bihive/scene/load_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bihive {
namespace {

using testing::HasSubstr;

TEST(BuiltInScene, all_of_them_load) {
  for (const auto& [name, title, kind] : kBuiltInScenes) {
    SCOPED_TRACE(title);
    const Result<LoadedScene> loaded = built_in_scene(name);
    ASSERT_TRUE(loaded) << name;
    EXPECT_EQ(loaded->scene.name, name);
    EXPECT_GT(loaded->scene.spheres.size(), 0);
    const bool of_thesis = kind != BuiltInKind::file;
    EXPECT_EQ(loaded->format, of_thesis ? "built-in" : "PDB");
    EXPECT_EQ(loaded->has_camera, of_thesis);
    EXPECT_EQ(loaded->has_lights, of_thesis);
  }
}

TEST(BuiltInScene, takes_its_parameters) {
  ScenarioParameters parameters;
  parameters.count = 64;
  parameters.seed = 5;
  const Result<LoadedScene> loaded = built_in_scene("scenario1", parameters);
  EXPECT_EQ(loaded->scene.spheres.size(), 64);
  EXPECT_EQ(loaded->scene.seed, 5u);
  ReadOptions options;
  options.radius = 0.25;
  EXPECT_NEAR(built_in_scene("demo", {}, options)->scene.spheres.radius(0), 0.25, 1e-7);
}

TEST(BuiltInScene, an_unknown_name_or_parameter_is_an_error) {
  EXPECT_THAT(built_in_scene("scenario4").error().to_string(), HasSubstr("there are demo, scenario1"));
  ScenarioParameters parameters;
  parameters.radius = 30;
  EXPECT_THAT(built_in_scene("scenario1", parameters).error().to_string(), HasSubstr("scenario1: "));
}

TEST(LoadScene, takes_scene_files_and_spheres) {
  const Result<LoadedScene> scene =
      load_scene(R"({"bihive_scene": 1, "spheres": [[0, 0, 0, 1], [2, 0, 0, 1]]})", "two.json");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->format, "scene file");
  EXPECT_EQ(scene->scene.spheres.size(), 2);
  EXPECT_FALSE(scene->has_camera);
  const Result<LoadedScene> table = load_scene("x,y,z,r\n0,0,0,1\n", "one.csv");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->format, "CSV");
  EXPECT_EQ(table->scene.name, "one.csv");
  EXPECT_THAT(load_scene("", "nothing.pdb").error().to_string(), HasSubstr("nothing.pdb"));
}

}  // namespace
}  // namespace bihive
