// The pixels of a PNG from a film.
#include "bihive/image/png_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/image/image.h"
#include "bihive/image/image_from_film.h"
#include "bihive/image/png.h"

namespace bihive {
namespace {

Film film_of(std::vector<Vec3f> radiance) {
  Film film(static_cast<int>(radiance.size()), 1);
  film.radiance = std::move(radiance);
  return film;
}

const std::vector<Vec3f> kLight{{0, 0.5f, 1}, {0.1f, 2, -1}, {std::numeric_limits<float>::quiet_NaN(), 0.25f, 0.75f}};

TEST(PngPixels, eight_bits_without_coverage_are_those_of_the_image) {
  for (const Transfer curve : {Transfer::srgb, Transfer::none}) {
    const Film film = film_of(kLight);
    const Image image = image_from_film(film, curve);
    const PngPixels pixels = png_pixels_from_film(film, curve, 8);
    EXPECT_EQ(pixels.channels, 3);
    EXPECT_EQ(pixels.bytes, image.rgb);
    EXPECT_EQ(picture_hash(pixels), picture_hash(image));
  }
}

TEST(PngPixels, opacity_has_no_curve_and_does_not_dim_the_colour) {
  Film film = film_of(kLight);
  film.coverage = {1, 0.5f, 0};
  for (const Transfer curve : {Transfer::srgb, Transfer::none}) {
    const Image image = image_from_film(film_of(kLight), curve);
    const PngPixels pixels = png_pixels_from_film(film, curve, 8);
    ASSERT_EQ(pixels.channels, 4);
    const std::vector<std::uint8_t> opacity{255, 128, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_EQ(pixels.bytes[4 * i + channel], image.rgb[3 * i + channel]);
      EXPECT_EQ(pixels.bytes[4 * i + 3], opacity[i]);
    }
  }
}

TEST(PngPixels, sixteen_bits_are_the_nearest_and_the_higher_byte_comes_first) {
  const PngPixels pixels = png_pixels_from_film(film_of(kLight), Transfer::none, 16);
  ASSERT_EQ(pixels.bytes.size(), 18u);
  const auto number = [&](std::size_t i) { return pixels.bytes[2 * i] * 256 + pixels.bytes[2 * i + 1]; };
  const std::vector<int> expected{0, 32768, 65535, 6554, 65535, 0, 0, 16384, 49151};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(number(i), expected[i]) << i;
  const PngPixels curved = png_pixels_from_film(film_of(kLight), Transfer::srgb, 16);
  // The standard's formula for 0.5.
  EXPECT_EQ(curved.bytes[2] * 256 + curved.bytes[3],
            static_cast<int>(std::floor((1.055 * std::pow(0.5, 1 / 2.4) - 0.055) * 65535 + 0.5)));
}

TEST(PngPixels, the_bytes_of_a_plain_picture_do_not_change) {
  const Film film = film_of(kLight);
  const Image image = image_from_film(film, Transfer::srgb);
  PngPixels plain = png_pixels_from_film(film, Transfer::srgb, 8);
  plain.is_srgb = false;  // as of an image, of which nothing is said
  EXPECT_EQ(*encode_png(plain, {{"a", "b"}}), *encode_png(image, {{"a", "b"}}));
}

// Laid over the page as programs do it, with a rounding to the nearest number.
TEST(MattedPixels, over_their_page_they_are_the_pixels_of_the_film_on_it) {
  Film film;
  film.resize(7, 5, /*with_coverage=*/true);
  for (std::size_t i = 0; i < film.radiance.size(); ++i) {
    const auto k = static_cast<float>(i);
    film.radiance[i] = {k / 20, 0.6F - k / 60, i % 3 == 0 ? 2.0F : 0.0F};
    film.coverage[i] = static_cast<float>(i % 6) / 5;
  }
  for (const Vec3d page : {Vec3d{0, 0, 0}, Vec3d{1, 1, 1}, Vec3d{0.03, 0.4, 0.9}})
    for (const int bits : {8, 16}) {
      const PngPixels matted = matted_pixels_from_film(film, Transfer::srgb, bits, page);
      Film opaque(7, 5);
      for (std::size_t i = 0; i < film.radiance.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
          opaque.radiance[i][channel] =
              static_cast<float>(double(film.coverage[i]) * double(film.radiance[i][channel]) +
                                 (1 - double(film.coverage[i])) * page[channel]);
      const PngPixels wanted = png_pixels_from_film(opaque, Transfer::srgb, bits);
      Film of_page(1, 1);
      of_page.radiance[0] = to_float(page);
      const PngPixels behind = png_pixels_from_film(of_page, Transfer::srgb, bits);
      const auto number = [bits](const PngPixels& pixels, std::size_t at) {
        return bits == 8 ? double(pixels.bytes[at]) : 256.0 * pixels.bytes[2 * at] + pixels.bytes[2 * at + 1];
      };
      const double most = bits == 8 ? 255 : 65535;
      for (std::size_t i = 0; i < film.radiance.size(); ++i) {
        const double opacity = number(matted, 4 * i + 3);
        EXPECT_GE(opacity, std::floor(double(film.coverage[i]) * most));
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const double mixed =
              (opacity * number(matted, 4 * i + channel) + (most - opacity) * number(behind, channel)) / most;
          EXPECT_EQ(std::floor(mixed + 0.5), number(wanted, 3 * i + channel)) << i << " of " << bits;
        }
      }
    }
}

TEST(PngPixels, the_curve_says_whether_they_are_srgb) {
  const Film film(2, 2);
  EXPECT_TRUE(png_pixels_from_film(film, Transfer::srgb, 8).is_srgb);
  EXPECT_TRUE(png_pixels_from_film(film, Transfer::srgb, 16).is_srgb);
  EXPECT_FALSE(png_pixels_from_film(film, Transfer::none, 8).is_srgb);
}

}  // namespace
}  // namespace bihive
