#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "bihive/image/transfer.h"
#include "bihive/io/write_spheres.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;
using test::with;
using namespace std::string_literals;

const std::string kPoints =
    "ply\n"
    "format ascii 1.0\n"
    "comment made by hand\n"
    "element camera 1\n"
    "property list uchar float view\n"
    "element vertex 2\n"
    "property float x\n"
    "property float y\n"
    "property double z\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n"
    "property list uchar int faces\n"
    "property float radius\n"
    "property float quality\n"
    "element face 1\n"
    "property list uchar int vertex_indices\n"
    "end_header\n"
    "2 7 8\n"
    "1 2 3 1 0 0 2 5 6 0.5 0.25\n"
    "-1 -2 -3.5 0 1 0 0 1.5 7\n"
    "3 0 1 0\n";

// The same points in binary. Bytes in the order of the format.
std::string binary(bool big) {
  std::string text = with(kPoints, "ascii", big ? "binary_big_endian" : "binary_little_endian");
  text.resize(text.find("end_header\n") + 11);
  const auto put = [&](const auto& value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (big) bytes = std::string(bytes.rbegin(), bytes.rend());
    text += bytes;
  };
  const auto byte = [&](int value) { text += static_cast<char>(value); };
  byte(2), put(7.0F), put(8.0F);
  put(1.0F), put(2.0F), put(3.0), byte(1), byte(0), byte(0), byte(2), put(5), put(6), put(0.5F), put(0.25F);
  put(-1.0F), put(-2.0F), put(-3.5), byte(0), byte(1), byte(0), byte(0), put(1.5F), put(7.0F);
  byte(3), put(0), put(1), put(0);
  return text;
}

TEST(Ply, TakesPointsInTextAndBinary) {
  for (const std::string& text : {kPoints, binary(false), binary(true)}) {
    const SphereFile file = read_text(text, "a.ply");
    EXPECT_EQ(file.format, "PLY");
    ASSERT_EQ(file.spheres.size(), 2);
    EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{-1, -2, -3.5}));
    EXPECT_EQ(file.spheres.radius(1), 1.5);
    EXPECT_EQ(numbers_of(file, "quality"), (std::vector<double>{0.25, 7}));
    // Bytes are sRGB, however small they are.
    EXPECT_EQ(file.spheres.attributes().colour[0].x, static_cast<float>(linear_from_srgb(1.0 / 255)));
    bool said = false;
    for (const std::string& rule : file.rules)
      said = said || rule == "points alone are read; left out: 1 of 'camera', 1 of 'face'";
    EXPECT_TRUE(said);
    EXPECT_TRUE(file.warnings.empty());
  }
}

TEST(Ply, ReadsWhatConvertWrites) {
  const SphereFile file =
      read_text("x,y,z,radius,q,red,green,blue\n1,2,3,0.5,-1,0.25,0.5,1\n4,5,6,1,2,0,0,0\n", "a.csv");
  const SphereFile again = read_text(write_spheres(file.spheres, SphereFileFormat::ply).bytes, "a.ply");
  ASSERT_EQ(again.spheres.size(), 2);
  EXPECT_EQ(again.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(again.spheres.radius(0), 0.5);
  EXPECT_EQ(again.spheres.attributes().colour, file.spheres.attributes().colour);
  EXPECT_EQ(numbers_of(again, "q"), (std::vector<double>{-1, 2}));
}

TEST(Ply, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kPoints, "1 2 3 1", "1 b 3 1"), "a"), "a:20:3: expected a number for y but found 'b'");
  EXPECT_EQ(error_of(with(kPoints, "1 2 3 1", "1 nan 3 1"), "a"), "a:20: y is not finite: nan");
  EXPECT_EQ(error_of(with(kPoints, "0.5 0.25", "-0.5 0.25"), "a"), "a:20: radius is negative: -0.5");
  EXPECT_EQ(error_of(with(kPoints, "0.5 0.25", "0.5 0.25 9"), "a"),
            "a:20:28: expected the end of the line but found '9'");
  EXPECT_EQ(error_of(with(kPoints, "vertex 2", "vertex 4"), "a").rfind("a:22:8: expected a number for green", 0), 0u);
  EXPECT_EQ(error_of(with(kPoints, "vertex 2", "vertex 9000000000000"), "a").rfind("a:22:", 0), 0u);
  EXPECT_EQ(error_of(with(kPoints, "vertex 2", "vertex -2"), "a").rfind("a:6:16: expected the number of 'vertex'", 0),
            0u);
  EXPECT_EQ(error_of(with(kPoints, "element face", "element vertex"), "a"), "a:16:9: the element 'vertex' comes twice");
  EXPECT_EQ(
      error_of(with(kPoints, "property double z", "property double w"), "a").rfind("a:19: expected columns x, y", 0),
      0u);
  EXPECT_EQ(error_of(with(kPoints, "property double z", "property real z"), "a").rfind("a:9:10: expected a type", 0),
            0u);
  EXPECT_EQ(error_of(with(kPoints, "ascii", "text"), "a").rfind("a:2:8: expected ascii", 0), 0u);
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nend_header\n", "a").rfind("a:3: the header has no 'element vertex'", 0),
            0u);
  EXPECT_NE(error_of(kPoints, "a", at_frame(1)).find("there is no frame 1"), std::string::npos);
  std::string damaged = binary(false);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(damaged.data() + damaged.find("end_header\n") + 11 + 9, &nan, sizeof nan);
  EXPECT_EQ(error_of(damaged, "a"), "a: point 0 (from 0): x is not finite: nan");
  for (const std::string& text : {kPoints, binary(false)})
    for (std::size_t length = 0; length < text.size(); ++length)
      (void)read_spheres_from_memory(std::string_view(text).substr(0, length), "a.ply", {});
  EXPECT_EQ(error_of(with(binary(false), "vertex 2", "vertex 900000000000"), "a").find("a:18: the file ends too early"),
            0u);
}

TEST(Ply, AnOpacityThatIsNoneIsANumber) {
  // A Gaussian splat.
  const std::string splat =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "f_dc_0\nproperty float opacity\nproperty float scale_0\nend_header\n1 2 3 .1 0.5 -4\n4 5 6 .2 -2 -3\n";
  const SphereFile file = read_text(splat, "a.ply");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_TRUE(file.spheres.attributes().opacity.empty());
  EXPECT_EQ(numbers_of(file, "opacity"), (std::vector<double>{0.5, -2}));
  EXPECT_NE(std::find(file.rules.begin(), file.rules.end(),
                      "'opacity' is outside 0 to 1 (-2 in row 1, from 0), so it is a number and no opacity"),
            file.rules.end());
  EXPECT_EQ(read_text(with(splat, "-2", "0"), "a.ply").spheres.attributes().opacity.size(), 2u);
  // Chosen by the user it must be one.
  ReadOptions options;
  options.columns = {{"opacity", "opacity"}};
  EXPECT_NE(error_of(splat, "a.ply", options).find("opacity is outside 0 to 1: -2"), std::string::npos);
}

}  // namespace
}  // namespace bihive
