// Keys of the legend that say the same.
#include "bihive/scene/legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bihive/scene/load_scene.h"

namespace bihive {
namespace {

using ::testing::ElementsAre;

Scene with_looks(const std::vector<Look>& looks) {
  const Style style = style_named("default").value();
  Scene scene = load_scene("4\n\nO 0 0 0\nH 1 0 0\nC 2 0 0\nN 3 0 0\n", "a.xyz", {}, LooksOfFile::apply, &style)->scene;
  EXPECT_TRUE(apply_looks(scene, looks).ok());
  return scene;
}

std::vector<std::string> names_of_entries(const LegendKey& key) {
  std::vector<std::string> names;
  for (const LegendEntry& entry : key.entries) names.push_back(entry.name);
  return names;
}

TEST(Legend, one_attribute_with_equal_colours_has_one_key) {
  const Scene scene = with_looks({{"index 2:4", {*colour_by_from_text("element")}}});
  ASSERT_EQ(scene.coloured_by.size(), 2u);
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].title, "element");
  EXPECT_THAT(names_of_entries(keys[0]), ElementsAre("H", "C", "N", "O"));
}

TEST(Legend, other_colours_titles_and_scales_have_keys_of_their_own) {
  ColourBy titled = *colour_by_from_text("element");
  titled.title = "of the ligand";
  EXPECT_EQ(legend_of(with_looks({{"index 2:4", {titled}}})).size(), 2u);
  const ColourBy by_x = *colour_by_from_text("x"), by_magma = *colour_by_from_text("x:magma");
  EXPECT_EQ(legend_of(with_looks({{"index 0:2", {by_x}}, {"index 2:4", {by_magma}}})).size(), 2u);
}

}  // namespace
}  // namespace bihive
