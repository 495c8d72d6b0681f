// The attributes of some spheres.
#include "bihive/geometry/sphere_attributes.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

TEST(SphereAttributes, part_keeps_every_column) {
  SphereAttributes whole;
  whole.element = {6, 7, 8};
  whole.type = {1, 2, 3};
  whole.colour = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  whole.opacity = {0.25F, 0.5F, 1};
  whole.outline_px = {1, 2, 3};
  whole.crease = {4, 5, 6};
  whole.clips = {1, 2, 4};
  whole.numbers = {{"charge", {-1, 0, 1}}};
  TextCollector names;
  for (const char* name : {"CA", "CB", "CA"}) names.add(name);
  whole.texts = {names.take("name")};
  const SphereAttributes part = whole.part({2, 0, 2});
  EXPECT_EQ(part.element, (std::vector<std::uint8_t>{8, 6, 8}));
  EXPECT_EQ(part.type, (std::vector<std::int32_t>{3, 1, 3}));
  EXPECT_EQ(part.colour, (std::vector<Vec3f>{{0, 0, 1}, {1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(part.opacity, (std::vector<float>{1, 0.25F, 1}));
  EXPECT_EQ(part.outline_px, (std::vector<float>{3, 1, 3}));
  EXPECT_EQ(part.crease, (std::vector<std::int32_t>{6, 4, 6}));
  EXPECT_EQ(part.clips, (std::vector<std::uint64_t>{4, 1, 4}));
  EXPECT_EQ(part.find_numbers("charge")->values, (std::vector<double>{1, -1, 1}));
  ASSERT_NE(part.find_texts("name"), nullptr);
  EXPECT_EQ(part.find_texts("name")->texts, (std::vector<std::string>{"CA"}));
  EXPECT_EQ(part.find_texts("name")->of(1), "CA");
  EXPECT_TRUE(whole.part({}).find_numbers("charge")->values.empty());
  EXPECT_TRUE(SphereAttributes{}.part({}).element.empty());
}

}  // namespace
}  // namespace bihive
