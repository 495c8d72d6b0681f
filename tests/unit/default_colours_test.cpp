// ctest: asan-long
#include "bihive/scene/default_colours.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bihive/scene/load_scene.h"

namespace bihive {
namespace {

constexpr const char* kPlainPoints = "x,y,z,r\n0,0,-2,1\n1,0,0,1\n2,0,6,1\n";

Scene loaded(const std::string& text, const std::string& name, const Style* style) {
  Result<LoadedScene> made = load_scene(text, name, {}, LooksOfFile::apply, style);
  EXPECT_TRUE(made.ok());
  return std::move(made->scene);
}

TEST(DefaultColours, points_without_kind_are_coloured_by_z) {
  for (const std::string& name : style_names()) {
    const Result<Style> style = style_named(name);
    ASSERT_TRUE(style.ok());
    const Scene scene = loaded(kPlainPoints, "a.csv", &*style);
    const std::vector<Vec3f>& colours = scene.spheres.attributes().colour;
    if (name == "plain" || name == "density") {
      EXPECT_TRUE(colours.empty());
      EXPECT_TRUE(scene.coloured_by.empty());
      continue;
    }
    ASSERT_EQ(colours.size(), 3u) << name;
    EXPECT_EQ(colours[0], map_colour(ColourMap::viridis, 0, Transfer::srgb)) << name;
    EXPECT_EQ(colours[1], map_colour(ColourMap::viridis, 0.25, Transfer::srgb)) << name;
    EXPECT_EQ(colours[2], map_colour(ColourMap::viridis, 1, Transfer::srgb)) << name;
    ASSERT_EQ(scene.coloured_by.size(), 1u);
    EXPECT_EQ(scene.coloured_by[0].attribute, "z");
  }
  EXPECT_TRUE(loaded(kPlainPoints, "a.csv", nullptr).spheres.attributes().colour.empty());
}

TEST(DefaultColours, elements_types_and_own_colours_go_first) {
  const Result<Style> style = style_named("default");
  ASSERT_TRUE(style.ok());
  const Scene types = loaded("x,y,z,r,type\n0,0,0,1,1\n1,0,5,1,2\n", "a.csv", &*style);
  EXPECT_EQ(types.coloured_by.at(0).attribute, "type");
  const Scene atoms = loaded("2\n\nC 0 0 0\nO 0 0 5\n", "a.xyz", &*style);
  EXPECT_EQ(atoms.coloured_by.at(0).attribute, "element");
  const Scene own = loaded("x,y,z,r,red,green,blue\n0,0,0,1,1,0,0\n1,0,5,1,0,1,0\n", "a.csv", &*style);
  EXPECT_TRUE(own.coloured_by.empty());
  EXPECT_EQ(own.spheres.attributes().colour.size(), 2u);
}

TEST(DefaultColours, a_style_may_take_another_attribute_or_none) {
  const auto style =
      parse_style(R"({"bihive_style": 1, "colour_by": {"attribute": "charge", "map": "magma"}})", "a.json");
  ASSERT_TRUE(style.ok()) << style.error().to_string();
  const Scene charged = loaded("x,y,z,r,charge\n0,0,0,1,-1\n1,0,5,1,1\n", "a.csv", &*style);
  EXPECT_EQ(charged.spheres.attributes().colour.at(1), map_colour(ColourMap::magma, 1, Transfer::srgb));
  EXPECT_TRUE(loaded(kPlainPoints, "a.csv", &*style).spheres.attributes().colour.empty()) << "there is no charge";
}

// A PDB file of `atoms` carbon atoms, of which the first ones have chain A.
std::string pdb_of(int atoms, int of_chain_a) {
  std::string text;
  for (int i = 0; i < atoms; ++i)
    text +=
        fmt::format("ATOM  {:5d}  CA  ALA {}{:4d}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n", i % 99999 + 1,
                    i < of_chain_a ? 'A' : 'B', i % 9999, 4.0 * (i % 100), 4.0 * (i / 100 % 100), 4.0 * (i / 10000));
  return text + "END\n";
}

TEST(DefaultColours, large_molecules_are_coloured_by_chain) {
  const auto coloured_by = [](const char* style, int atoms, int of_chain_a) {
    const Scene scene = loaded(pdb_of(atoms, of_chain_a), "a.pdb", &*style_named(style));
    EXPECT_EQ(scene.spheres.size(), atoms);
    EXPECT_EQ(scene.coloured_by.size(), 1u);
    return scene.coloured_by.at(0).attribute;
  };
  EXPECT_EQ(coloured_by("default", 20000, 10000), "element");
  EXPECT_EQ(coloured_by("default", 20001, 10000), "chain");
  EXPECT_EQ(coloured_by("plain", 20001, 10000), "element");
  EXPECT_EQ(coloured_by("illustrative", 100, 75), "chain");
  EXPECT_EQ(coloured_by("illustrative", 100, 76), "element") << "one chain has more than three quarters";
  EXPECT_EQ(coloured_by("illustrative", 100, 100), "element") << "there is one chain";

  const Scene scene = loaded(pdb_of(100, 50), "a.pdb", &*style_named("illustrative"));
  const std::vector<Vec3f>& colours = scene.spheres.attributes().colour;
  EXPECT_EQ(colours.front(), colours.at(49));
  EXPECT_NE(colours.at(49), colours.at(50));
}

TEST(DefaultColours, scene_files_keep_theirs) {
  const Scene scene = loaded(R"({"bihive_scene": 1, "spheres": [[0, 0, 0, 1], [0, 0, 4, 1]]})", "a.json", nullptr);
  EXPECT_TRUE(scene.spheres.attributes().colour.empty());
}

}  // namespace
}  // namespace bihive
