// ctest: asan-long
#include "bihive/scene/element_colours.h"

#include <gtest/gtest.h>

#include "bihive/image/colour_text.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/palette.h"

namespace bihive {
namespace {

Vec3f seen(const char* colour) {
  return to_float(*colour_from_text(colour, Transfer::srgb));
}

TEST(ElementColours, OfRasMol) {
  const auto cpk = element_colours_called("cpk");
  ASSERT_TRUE(cpk);
  EXPECT_EQ((*cpk)[1], seen("#ffffff"));
  EXPECT_EQ((*cpk)[6], seen("#c8c8c8"));
  EXPECT_EQ((*cpk)[7], seen("#8f8fff"));
  EXPECT_EQ((*cpk)[8], seen("#f00000"));
  EXPECT_EQ((*cpk)[26], seen("#ffa500"));
  EXPECT_EQ((*cpk)[118], seen("#ff1493")) << "not in the table";
  EXPECT_FALSE(element_colours_called("other"));
}

TEST(ElementColours, SpheresWithOtherColoursKeepThem) {
  Result<LoadedScene> loaded = load_scene("x,y,z,r,element\n0,0,0,1,C\n1,0,0,1,C\n2,0,0,1,O\n3,0,0,1,Q\n", "a.csv");
  ASSERT_TRUE(loaded.ok());
  Scene& scene = loaded->scene;
  scene.spheres.attributes().colour[1] = {0.5F, 0, 0};
  const auto colours = read_element_colours("C #00ff00\nx black\n", "colours.txt");
  ASSERT_TRUE(colours.ok());
  ASSERT_TRUE(recolour_elements(scene, *colours).ok());
  EXPECT_EQ(scene.spheres.attributes().colour[0], seen("#00ff00"));
  EXPECT_EQ(scene.spheres.attributes().colour[1], (Vec3f{0.5F, 0, 0}));
  EXPECT_EQ(scene.spheres.attributes().colour[2], element_colour(8));
  EXPECT_EQ(scene.spheres.attributes().colour[3], (Vec3f{0, 0, 0}));
}

TEST(ElementColours, AStyleThatColoursByChainGivesWay) {
  Result<LoadedScene> loaded = load_scene("x,y,z,r,element\n0,0,0,1,C\n1,0,0,1,O\n", "a.csv");
  ASSERT_TRUE(loaded.ok());
  Scene& scene = loaded->scene;
  scene.spheres.attributes().colour = {{0.1F, 0.2F, 0.3F}, {0.4F, 0.5F, 0.6F}};
  scene.coloured_by.front().attribute = "chain";
  ASSERT_TRUE(recolour_elements(scene, *element_colours_called("soft")).ok());
  EXPECT_EQ(scene.spheres.attributes().colour[0], element_colour(6, ElementScheme::soft));
  EXPECT_EQ(scene.spheres.attributes().colour[1], element_colour(8, ElementScheme::soft));
  EXPECT_EQ(scene.coloured_by.front().attribute, "element");
}

}  // namespace
}  // namespace bihive
