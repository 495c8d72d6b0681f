// Transfer curves, hashes, differences and PNG files.
// ctest: asan-long
#include "bihive/image/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "bihive/base/write_file.h"
#include "bihive/image/image_diff.h"
#include "bihive/image/png.h"
#include "bihive/image/transfer.h"
#include "bihive/math/rng.h"

namespace bihive {
namespace {

Image noise(int width, int height, std::uint64_t seed) {
  Image image{width, height, {}};
  SplitMix64 random(seed);
  for (int i = 0; i < 3 * width * height; ++i) image.rgb.push_back(static_cast<std::uint8_t>(random.next()));
  return image;
}

TEST(Transfer, known_values) {
  // From the standard's formula, by hand: linear 0.5 is 188 of 255, 0.1 is 89, 0.2 is 124.
  EXPECT_EQ(byte_from_radiance(0.5, Transfer::srgb), 188);
  EXPECT_EQ(byte_from_radiance(0.1, Transfer::srgb), 89);
  EXPECT_EQ(byte_from_radiance(0.2, Transfer::srgb), 124);
  EXPECT_EQ(byte_from_radiance(0.1, Transfer::none), 26);
  EXPECT_EQ(byte_from_radiance(0.2, Transfer::none), 51);
}

TEST(Transfer, clamps) {
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    EXPECT_EQ(byte_from_radiance(-1, transfer), 0);
    EXPECT_EQ(byte_from_radiance(7, transfer), 255);
    EXPECT_EQ(byte_from_radiance(std::numeric_limits<double>::infinity(), transfer), 255);
    EXPECT_EQ(byte_from_radiance(std::numeric_limits<double>::quiet_NaN(), transfer), 0);
  }
}

TEST(Transfer, the_table_of_bytes_is_the_curve) {
  SplitMix64 rng(5);
  for (const Transfer transfer : {Transfer::srgb, Transfer::none}) {
    const ByteTable byte_of(transfer);
    const auto expect_same = [&](float radiance) {
      ASSERT_EQ(byte_of(radiance), byte_from_radiance(double(radiance), transfer)) << radiance;
    };
    for (const float radiance : {0.0F, -0.0F, -1.0F, 1.0F, 1e30F, 1e-45F, std::numeric_limits<float>::infinity(),
                                 std::numeric_limits<float>::quiet_NaN(), std::nextafter(1.0F, 0.0F)})
      expect_same(radiance);
    for (int i = 0; i < 100000; ++i) expect_same(rng.next_float());

    // Just below and at the first radiance of each byte.
    for (int byte = 1; byte <= 255; ++byte) {
      const double begins = (byte - 0.5) / 255;
      auto radiance = static_cast<float>(transfer == Transfer::srgb ? linear_from_srgb(begins) : begins);
      for (int step = -3; step <= 3; ++step) {
        float neighbour = radiance;
        for (int k = 0; k < std::abs(step); ++k) neighbour = std::nextafter(neighbour, step < 0 ? 0.0F : 2.0F);
        expect_same(neighbour);
      }
    }
  }
}

TEST(Transfer, the_curve_against_long_double) {
  SplitMix64 random(9);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.next_double();
    const long double curve =
        x <= 0.0031308 ? 12.92L * x : 1.055L * std::pow(static_cast<long double>(x), 1 / 2.4L) - 0.055L;
    ASSERT_LT(std::abs(srgb_from_linear(x) - curve), 1e-14L) << x;
    const long double back = x <= 0.04045 ? x / 12.92L : std::pow((x + 0.055L) / 1.055L, 2.4L);
    ASSERT_LT(std::abs(linear_from_srgb(x) - back), 1e-14L) << x;
  }
}

TEST(Transfer, every_byte_comes_back) {
  for (int byte = 0; byte < 256; ++byte)
    EXPECT_EQ(byte_from_radiance(linear_from_srgb(byte / 255.0), Transfer::srgb), byte);
}

TEST(Hash, tells_pictures_and_shapes_apart) {
  const Image image = noise(6, 4, 1);
  Image turned = image;
  std::swap(turned.width, turned.height);
  Image other = image;
  other.rgb[5] ^= 1;
  EXPECT_EQ(picture_hash(image), picture_hash(noise(6, 4, 1)));
  EXPECT_NE(picture_hash(image), picture_hash(turned));
  EXPECT_NE(picture_hash(image), picture_hash(other));
}

TEST(Difference, counts_pixels_and_brightens) {
  const Image image = noise(5, 5, 2);
  EXPECT_EQ(difference_of(image, image).pixels, 0);
  Image other = image;
  other.rgb[0] = static_cast<std::uint8_t>(image.rgb[0] < 128 ? image.rgb[0] + 2 : image.rgb[0] - 2);
  const ImageDifference difference = difference_of(image, other);
  EXPECT_EQ(difference.pixels, 1);
  EXPECT_EQ(difference.largest, 2);
  EXPECT_EQ(difference.picture.rgb[0], 255);
  EXPECT_FALSE(difference_of(image, noise(4, 5, 2)).same_size);
}

class PngFiles : public ::testing::Test {
 protected:
  const std::string path_ = ::testing::TempDir() + "bihive_image_test.png";
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(PngFiles, come_back_with_their_text) {
  const Image image = noise(37, 21, 3);
  ASSERT_TRUE(write_png(path_, image, {{"Software", "bihive"}, {"Settings", "{\"a\": 1}"}}));
  const Result<PngFile> file = read_png(path_);
  ASSERT_TRUE(file) << file.error().to_string();
  EXPECT_EQ(file->image.width, 37);
  EXPECT_EQ(file->image.height, 21);
  EXPECT_EQ(file->image.rgb, image.rgb);
  ASSERT_EQ(file->text.size(), 2u);
  EXPECT_EQ(file->text[1].first, "Settings");
  EXPECT_EQ(file->text[1].second, "{\"a\": 1}");
}

TEST_F(PngFiles, cut_anywhere_are_errors) {
  const std::string bytes = encode_png(noise(16, 16, 4), {}).value();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    ASSERT_TRUE(write_file(path_, bytes.substr(0, size)));
    EXPECT_FALSE(read_png(path_)) << size;
  }
}

}  // namespace
}  // namespace bihive
