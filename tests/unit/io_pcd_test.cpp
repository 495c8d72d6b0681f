#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "bihive/image/transfer.h"
#include "bihive/io/formats/points/lzf.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;
using test::with;
using namespace std::string_literals;

const std::string kHeader =
    "# .PCD v0.7 - Point Cloud Data file format\n"
    "VERSION 0.7\n"
    "FIELDS x y z rgb normal _\n"
    "SIZE 4 4 8 4 4 1\n"
    "TYPE F F F U F U\n"
    "COUNT 1 1 1 1 2 2\n"
    "WIDTH 3\n"
    "HEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\n"
    "POINTS 3\n";
const std::string kText = kHeader +
                          "DATA ascii\n"
                          "1 2 3 16711935 0.5 0.25 0 0\n"
                          "nan nan nan 0 0 0 0 0\n"
                          "-1 -2 -3.5 255 7 8 0 0\n";

template <class T>
std::string bytes(std::initializer_list<T> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T)};
}

std::string point(float x, float y, double z, unsigned rgb, float a, float b) {
  return bytes<float>({x, y}) + bytes<double>({z}) + bytes<unsigned>({rgb}) + bytes<float>({a, b}) + "\0\0"s;
}

std::string binary() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return kHeader + "DATA binary\n" + point(1, 2, 3, 16711935, 0.5, 0.25) + point(nan, nan, 0, 0, 0, 0) +
         point(-1, -2, -3.5, 255, 7, 8);
}

// Field by field, as literals of up to 32 bytes.
std::string packed() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string plain = bytes<float>({1, nan, -1}) + bytes<float>({2, nan, -2}) + bytes<double>({3, 0, -3.5}) +
                            bytes<unsigned>({16711935, 0, 255}) + bytes<float>({0.5, 0.25, 0, 0, 7, 8}) +
                            std::string(6, '\0');
  std::string lzf;
  const std::size_t literals = plain.size() - 6;
  for (std::size_t at = 0; at < literals; at += 32) {
    const std::size_t length = std::min<std::size_t>(32, literals - at);
    lzf += static_cast<char>(length - 1);
    lzf += plain.substr(at, length);
  }
  // The six zeros: one as a literal, five copied from one byte before.
  lzf += "\0\0"s + static_cast<char>(3 << 5) + "\0"s;
  return kHeader + "DATA binary_compressed\n" +
         bytes<unsigned>({static_cast<unsigned>(lzf.size()), static_cast<unsigned>(plain.size())}) + lzf;
}

TEST(Pcd, TakesPointsInTextBinaryAndPacked) {
  for (const std::string& text : {kText, binary(), packed()}) {
    const SphereFile file = read_text(text, "a.pcd");
    EXPECT_EQ(file.format, "PCD");
    ASSERT_EQ(file.spheres.size(), 2) << "a point without a place is left out";
    EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{-1, -2, -3.5}));
    EXPECT_EQ(file.spheres.attributes().colour[0], (Vec3f{1, 0, 1}));
    EXPECT_EQ(file.spheres.attributes().colour[1], (Vec3f{0, 0, 1}));
    EXPECT_EQ(numbers_of(file, "normal_2"), (std::vector<double>{0.25, 8}));
    EXPECT_EQ(file.rules[0], "fields: x y z red green blue normal_1 normal_2 __1 __2");
    bool said = false;
    for (const std::string& rule : file.rules) said = said || rule == "points without a place (NaN) are left out: 1";
    EXPECT_TRUE(said);
  }
}

TEST(Pcd, TakesColoursInTheBitsOfAFloat) {
  const std::string text =
      "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3 4.2108e+06\n";
  const SphereFile file = read_text(text, "a");
  // 4210800 is the float 0x4A8080E0: the bytes 128, 128 and 224.
  EXPECT_EQ(file.spheres.attributes().colour[0].y, static_cast<float>(linear_from_srgb(128.0 / 255)));
}

TEST(Pcd, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kText, "1 2 3 16", "1 b 3 16"), "a"), "a:12:3: expected a number for y but found 'b'");
  EXPECT_EQ(error_of(with(kText, "1 2 3 16", "1 inf 3 16"), "a"), "a:12: y is not finite: inf");
  EXPECT_EQ(error_of(with(kText, "POINTS 3", "POINTS 4"), "a"),
            "a:14: the file ends too early: expected 4 points but found 3");
  EXPECT_EQ(
      error_of(with(kText, "POINTS 3", "POINTS 9000000000000000000"), "a").rfind("a:14: the file ends too early", 0),
      0u);
  EXPECT_EQ(error_of(with(kText, "POINTS 3", "POINTS x"), "a").rfind("a:10:8: expected a whole number for POINTS", 0),
            0u);
  EXPECT_EQ(error_of(with(kText, "HEIGHT 1", "WIDTH 1"), "a"), "a:8: 'WIDTH' comes twice");
  EXPECT_NE(error_of(with(kText, "TYPE F F F U F U", "TYPE F F F U F"), "a").find("different numbers of fields"),
            std::string::npos);
  EXPECT_NE(error_of(with(kText, "SIZE 4 4 8", "SIZE 4 3 8"), "a").find("which is no number"), std::string::npos);
  EXPECT_NE(error_of(with(kText, "COUNT 1 1 1 1 2", "COUNT 1 1 1 1 900000"), "a").find("COUNT '900000'"),
            std::string::npos);
  EXPECT_NE(error_of(with(kText, "x y z rgb", "x y w rgb"), "a").find("there is no z in FIELDS"), std::string::npos);
  EXPECT_EQ(error_of(with(kText, "ascii", "zip"), "a").rfind("a:11:6: expected ascii, binary or binary_compressed", 0),
            0u);
  EXPECT_NE(error_of(with(binary(), "POINTS 3", "POINTS 900000000000000"), "a").find("ends too early"),
            std::string::npos);
  EXPECT_NE(error_of(with(packed(), "POINTS 3", "POINTS 2"), "a").find("the packed points have"), std::string::npos);
  std::string damaged = packed();
  damaged[damaged.size() - 2] = static_cast<char>(7 << 5);
  EXPECT_NE(error_of(damaged, "a").find("the packed points are damaged"), std::string::npos);
  EXPECT_NE(error_of(kText, "a", at_frame(1)).find("there is no frame 1"), std::string::npos);
  for (const std::string& text : {kText, binary(), packed()})
    for (std::size_t length = 0; length < text.size(); ++length)
      (void)read_spheres_from_memory(std::string_view(text).substr(0, length), "a.pcd", {});
}

TEST(Lzf, UnpacksLiteralsAndCopies) {
  EXPECT_EQ(unpack_lzf("\x02"s + "abc" + "\x20\x02"s, 6), "abcabc");
  // A long copy: the length goes on in the next byte.
  EXPECT_EQ(unpack_lzf("\0a\xe0\x01\0"s, 11), std::string(11, 'a'));
  for (const std::string& wrong :
       {"\x02"s + "ab", "\x20\x00"s, "\0a\x20\x05"s, "\0a\x20"s, "\0a\xe0"s, "\0a\xe0\x01"s, "\0a"s})
    EXPECT_FALSE(unpack_lzf(wrong, 4).has_value());
  EXPECT_FALSE(unpack_lzf("\0a"s, std::size_t{1} << 40).has_value());
}

TEST(Pcd, TheEndingTellsWhereTheVersionIsMissing) {
  const std::string text =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n";
  const SphereFile file = read_text(text, "a.pcd");
  EXPECT_EQ(file.format, "PCD");
  ASSERT_EQ(file.spheres.size(), 1);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3}));
}

}  // namespace
}  // namespace bihive
